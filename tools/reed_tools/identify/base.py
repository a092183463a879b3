"""Base parameters: the combinations of inertial parameters that torques depend on at all."""

from dataclasses import dataclass

import numpy as np

from reed_tools.robots.chain import Chain
from reed_tools.robots.nominal import NominalArm
from reed_tools.robots.regressor import NAMES, PER_LINK, UNITS, inverse_dynamics

STATES, SEED = 120, 5
INDEPENDENT = 1e-8   # share of a column that those before it do not explain
LEAST_SHARE = 1e-10  # smaller coefficients of a combination are rounding


@dataclass(frozen=True)
class Base:
    names: list[str]
    units: list[str]
    columns: np.ndarray  # which of all columns carry the combinations
    B: np.ndarray        # [base, all]: combination = B times all parameters (10 per link, viscous, Coulomb)
    texts: list[str]     # each combination in words


def base_of(arm: NominalArm) -> Base:
    kept, regrouped = inertial_base(arm.chain)
    dof, count = arm.dof, PER_LINK * arm.dof
    names = [f"{NAMES[k % PER_LINK]}{k // PER_LINK + 1}" for k in range(count)]
    B = np.zeros((len(kept) + 2 * dof, count + 2 * dof))
    B[:len(kept), :count] = regrouped
    B[len(kept):, count:] = np.eye(2 * dof)
    friction = [f"Fv{joint + 1}" for joint in range(dof)] + [f"Fc{joint + 1}" for joint in range(dof)]
    texts = [" ".join(f"{share:+.4g} {names[k]}" for k, share in enumerate(row) if share) for row in regrouped]
    return Base([names[k] for k in kept] + friction, [UNITS[k % PER_LINK] for k in kept] + ["N·m·s/rad"] * dof + ["N·m"] * dof,
                np.array([*kept, *range(count, count + 2 * dof)]), B, [*(text.removeprefix("+1 ").strip() for text in texts), *friction])


def inertial_base(chain: Chain) -> tuple[list[int], np.ndarray]:
    """Columns of the regressor that are independent of those before them, and how the others regroup into them."""
    rng = np.random.default_rng(SEED)
    Y = inverse_dynamics(chain, *(rng.uniform(-size, size, (STATES, chain.dof)) for size in (np.pi, 3.0, 10.0)))
    Y = Y.reshape(-1, Y.shape[2])
    size = np.linalg.norm(Y, axis=0)
    kept, basis = [], np.zeros((len(Y), 0))
    for k in np.flatnonzero(size > INDEPENDENT * size.max()):
        rest = Y[:, k] / size[k]
        for _ in range(2):  # twice is enough for orthogonality
            rest = rest - basis @ (basis.T @ rest)
        if np.linalg.norm(rest) > INDEPENDENT:
            kept.append(int(k))
            basis = np.column_stack([basis, rest / np.linalg.norm(rest)])
    regrouped = np.linalg.lstsq(Y[:, kept], Y, rcond=None)[0]
    return kept, np.where(np.abs(regrouped) < LEAST_SHARE, 0.0, regrouped)
