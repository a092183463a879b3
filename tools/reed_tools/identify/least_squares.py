"""Weighted least squares over the rows of all joints. A joint's weight is the reciprocal of its residual's long-run variance:
neighbouring residuals are alike where the model is not the whole truth, and count for less."""

import dataclasses
from dataclasses import dataclass

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.identify.base import Base
from reed_tools.identify.filtering import Rows, rows_of
from reed_tools.identify.samples import Stretch
from reed_tools.robots.nominal import NominalArm

BENDING_UNSURE, JOINTS_UNSURE = 1.0, 0.1  # share of what the joints' springs change that is not sure: with links that bend, as much again
ROUNDS = 4            # of weights
READ_ROUNDS = 2       # of the friction that the springs feel
LARGEST_LAG = 30      # rows over which residuals are taken to be alike
LARGEST_CONDITION = 300.0
LEAST_PER_COLUMN = 3  # rows


@dataclass(frozen=True)
class Fit:
    estimate: np.ndarray    # of the base parameters
    information: np.ndarray  # inverse of their covariance
    condition: float        # of the weighted regressor, columns scaled to one length
    residual: np.ndarray    # percent of the torque's rms, per joint

    @property
    def sigma(self) -> np.ndarray:
        return np.sqrt(np.diag(np.linalg.inv(self.information)))


def together(parts: list[Rows]) -> Rows:
    return Rows(*(np.concatenate([getattr(part, name) for part in parts]) for name in Rows.__dataclass_fields__))


def read_rows(runs: list[Stretch], arm: NominalArm, friction: np.ndarray, cutoff_hz: float, where: str) -> Rows:
    parts = [part for run in runs if (part := rows_of(run, arm, friction, cutoff_hz)) is not None]
    if not parts:
        longest = max((len(run.angle) * run.period_s for run in runs), default=0.0)
        raise UsageError(f"{where}: too short to identify from: {longest:.2g} s of free motion in a row, a cutoff of {cutoff_hz:g} Hz needs "
                         f"{5 / cutoff_hz:.2g} s and more; the condition number is infinite")
    return together(parts)


def solve(runs: list[Stretch], arm: NominalArm, base: Base, cutoff_hz: float, where: str = "run") -> Fit:
    """With what the springs of joints and links leave unsure in the covariance."""
    fit = weighted_fit(runs, arm, base, cutoff_hz, where)
    rigid = weighted_fit(runs, dataclasses.replace(arm, stiffness=np.full(arm.dof, np.inf)), base, cutoff_hz, where)
    unsure = (BENDING_UNSURE if arm.bends else JOINTS_UNSURE) * (rigid.estimate - fit.estimate)
    return dataclasses.replace(fit, information=np.linalg.inv(np.linalg.inv(fit.information) + np.diag(unsure**2)))


def weighted_fit(runs: list[Stretch], arm: NominalArm, base: Base, cutoff_hz: float, where: str) -> Fit:
    friction = np.stack([arm.viscous @ arm.p, arm.coulomb])
    weight = np.ones(arm.dof)
    bends = np.isfinite(arm.stiffness).any()
    for number in range(ROUNDS):
        if number == 0 or (bends and number < READ_ROUNDS):  # friction enters the rows by what the springs carry
            rows = read_rows(runs, arm, friction, cutoff_hz, where)
        W, z = weighted(rows, base, weight)
        condition = condition_of(W)
        if not condition < LARGEST_CONDITION or len(W) < LEAST_PER_COLUMN * W.shape[1]:
            raise UsageError(f"{where}: too short or too still to identify from: condition number {condition:.3g} of {len(W)} rows for "
                             f"{W.shape[1]} parameters; allowed: below {LARGEST_CONDITION:g} and {LEAST_PER_COLUMN} rows each "
                             "(`tools/reed identify --excite ARM` makes a motion)")
        estimate = np.linalg.lstsq(W, z, rcond=None)[0]
        rest = residual(rows, base, estimate)
        weight = np.array([1 / np.sqrt(long_run_variance(rest[rows.used[:, joint], joint], len(z) / len(estimate))) for joint in range(arm.dof)])
        friction = np.maximum(estimate[-2 * arm.dof:].reshape(2, arm.dof), 0.0)
    return Fit(estimate, W.T @ W, condition, percent(rows, base, estimate))


def weighted(rows: Rows, base: Base, weight: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    per_joint = [(rows.Y[rows.used[:, joint], joint][:, base.columns] * weight[joint], rows.torque[rows.used[:, joint], joint] * weight[joint])
                 for joint in range(rows.torque.shape[1])]
    return np.concatenate([W for W, _ in per_joint]), np.concatenate([z for _, z in per_joint])


def condition_of(W: np.ndarray) -> float:
    size = np.linalg.norm(W, axis=0)
    return float(np.linalg.cond(W / size)) if size.all() and len(W) >= W.shape[1] else float("inf")


def residual(rows: Rows, base: Base, estimate: np.ndarray) -> np.ndarray:
    return rows.torque - rows.Y[:, :, base.columns] @ estimate


def percent(rows: Rows, base: Base, estimate: np.ndarray) -> np.ndarray:
    """Per joint the residual's rms over the torque's."""
    square = lambda x: np.sum(np.where(rows.used, x, 0.0) ** 2, axis=0)
    return 100 * np.sqrt(square(residual(rows, base, estimate)) / np.maximum(square(rows.torque), 1e-12))


def long_run_variance(x: np.ndarray, rows_per_parameter: float) -> float:
    """Variance times the sum of autocorrelations, with falling weights (Bartlett): what the mean of many rows has, times their number."""
    lags = min(LARGEST_LAG, len(x) // 4)
    covariance = np.array([x[:len(x) - lag] @ x[lag:] / len(x) for lag in range(lags + 1)])
    total = covariance[0] + 2 * np.sum((1 - np.arange(1, lags + 1) / (lags + 1)) * covariance[1:])
    lost = 1 - 1 / max(rows_per_parameter, 1.1)  # degrees of freedom
    return max(total, covariance[0]) / lost + 1e-16
