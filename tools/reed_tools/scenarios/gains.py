"""Gains of an arm by rule: K_d follows the inertia that a joint moves, Lambda is one for all, and each joint's K_d comes down until
the configuration's own rules (margins, chatter, encoder) hold."""

import re
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.robots.nominal import NominalArm
from reed_tools.robots.regressor import inverse_dynamics
from reed_tools.run import scenario

BANDWIDTH_1ps = 60.0  # K_d = that times the inertia that a joint moves
PER_ROTOR_1ps = 114.0  # and no more than this times the rotor's: half of what the chatter rule allows at 1 kHz
LAMBDA_1ps = 15.0
LOWER, ROUNDS = 0.8, 60


@dataclass
class Gains:
    K_d: np.ndarray  # N·m·s/rad
    Lambda: float    # 1/s

    def lines(self) -> str:
        return f"[control]\nK_d = [{', '.join(f'{value:.3g}' for value in self.K_d)}]\nLambda = {self.Lambda:g}\n"


def gravity_torque(arm: NominalArm, q: np.ndarray) -> np.ndarray:
    """Of the nominal arm at rest, [n, dof]."""
    return inverse_dynamics(arm.chain, q, 0 * q, 0 * q) @ arm.inertial


def inertia(arm: NominalArm, q: np.ndarray) -> np.ndarray:
    """M + J_m of the nominal arm, [n, dof, dof]."""
    rest = 0 * q
    weight = inverse_dynamics(arm.chain, q, rest, rest) @ arm.inertial
    columns = [inverse_dynamics(arm.chain, q, rest, rest + unit) @ arm.inertial - weight for unit in np.eye(arm.dof)]
    return np.stack(columns, axis=2) + np.diag(arm.rotor_inertia)


def by_rule(arm: NominalArm, q: np.ndarray) -> Gains:
    return Gains(np.minimum(BANDWIDTH_1ps * np.diag(inertia(arm, q[None])[0]), PER_ROTOR_1ps * np.maximum(arm.rotor_inertia, 1e-3)), LAMBDA_1ps)


def accepted(gains: Gains, text_of) -> str:
    """The scenario text_of(gains) with gains that the configuration accepts."""
    for _ in range(ROUNDS):
        text = text_of(gains)
        problem = refusal(text)
        if problem is None:
            return text
        joint = re.search(r"control\.K_d.*?joint (\d+)", problem)
        if not joint:
            raise UsageError(problem)
        gains.K_d[int(joint[1]) - 1] *= LOWER
    raise UsageError(f"no K_d is small enough for this arm: {problem}")


def refusal(text: str) -> str | None:
    """What the configuration's reader says of a scenario."""
    with tempfile.TemporaryDirectory() as scratch:
        path = Path(scratch, "scenario.toml")
        path.write_text(text, encoding="utf-8")
        try:
            scenario.checked(str(path), None, [], Path(scratch, "effective.toml"))
        except UsageError as error:
            return str(error).replace(str(path), "scenario")
    return None
