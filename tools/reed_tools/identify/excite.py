"""A motion that tells an arm's parameters apart: one period of a Fourier series per joint, chosen so that the regressor's condition
number is low. It begins and ends at rest, and keeps a share of the nominal arm's limits of angle, speed and torque. It knows
nothing of what stands around the arm.

  q(t) = m + sum_k s_k sin(k w t) + c_k cos(k w t),   sum k s_k = 0 (speed at the start), sum k^2 c_k = 0 (acceleration)"""

from dataclasses import dataclass

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.identify.base import Base, base_of
from reed_tools.identify.filtering import diagonal
from reed_tools.identify.least_squares import LARGEST_CONDITION, condition_of
from reed_tools.robots.nominal import NominalArm
from reed_tools.robots.regressor import inverse_dynamics
from reed_tools.scenarios import gains
from reed_tools.scenarios.new import plant

HARMONICS = 6
RANGE, SPEED, TORQUE = 0.75, 0.6, 0.7  # shares of the limits
WIDEST_rad = 1.6       # from the middle of a joint's range
SHORTEST_s, LONGEST_s = 20.0, 60.0  # of the period
FEW, MANY = 80, 240    # samples of a period: for its amplitude, and for the regressor
STARTS, TRIALS = 40, 260
SHRINK, LEAST_SIZE = 0.85, 0.2  # of the amplitude where torques are too large


@dataclass
class Motion:
    mean: np.ndarray    # rad
    sine: np.ndarray    # rad, [HARMONICS, dof]
    cosine: np.ndarray
    period_s: float
    condition: float = float("inf")

    @property
    def start(self) -> np.ndarray:
        return self.mean + self.cosine.sum(axis=0)


def scenario(arm: NominalArm, arm_file: str, seed: int) -> tuple[str, Motion]:
    motion = motion_of(arm, seed)
    if not motion.condition < LARGEST_CONDITION:
        raise UsageError(f"{arm.name}: no motion within its limits tells its parameters apart: condition number {motion.condition:.3g}, "
                         f"allowed: below {LARGEST_CONDITION:g}")
    return scenario_text(arm, arm_file, motion, seed), motion


def motion_of(arm: NominalArm, seed: int) -> Motion:
    """The best of many, then better ones close by."""
    base, rng = base_of(arm), np.random.default_rng(seed)
    middle, half = (arm.position_min + arm.position_max) / 2, (arm.position_max - arm.position_min) / 2
    half = np.minimum(RANGE * half, WIDEST_rad)
    period_s = float(np.clip(np.ceil(np.max(20.0 * half / (SPEED * arm.speed_limit))), SHORTEST_s, LONGEST_s))

    def judged(mean: np.ndarray, sine: np.ndarray, cosine: np.ndarray) -> Motion:
        return within_limits(arm, base, Motion(np.clip(mean, -0.5 * half, 0.5 * half), *at_rest(sine, cosine), period_s), middle, half)

    drawn = lambda: (0.3 * half * rng.uniform(-1, 1, arm.dof), *rng.normal(size=(2, HARMONICS, arm.dof)))
    found = [(parts, judged(*parts)) for parts in (drawn() for _ in range(STARTS))]
    parts, best = min(found, key=lambda pair: pair[1].condition)
    for trial in range(TRIALS):
        joint = trial % arm.dof
        tried = tuple(part.copy() for part in parts)
        tried[0][joint] += 0.15 * half[joint] * rng.normal()
        for part in tried[1:]:
            part[:, joint] += 0.4 * rng.normal(size=HARMONICS)
        motion = judged(*tried)
        if motion.condition < best.condition:
            parts, best = tried, motion
    return best


def at_rest(sine: np.ndarray, cosine: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Without the parts that would start at a speed or with an acceleration. Higher harmonics are smaller by their number."""
    k = np.arange(1, HARMONICS + 1)
    return (without(k, sine / k[:, None]), without(k * k, cosine / k[:, None]))


def without(row: np.ndarray, x: np.ndarray) -> np.ndarray:
    return x - np.outer(row, row @ x) / (row @ row)


def within_limits(arm: NominalArm, base: Base, shape: Motion, middle: np.ndarray, half: np.ndarray) -> Motion:
    """The shape as large as angles, speeds and torques allow, and its condition number; `shape.mean` is from the middle."""
    flat = Motion(0 * middle, shape.sine, shape.cosine, shape.period_s)
    q, qd, _ = sampled(flat, FEW)
    size = np.minimum((half - np.abs(shape.mean)) / np.abs(q).max(axis=0), SPEED * arm.speed_limit / np.abs(qd).max(axis=0))
    share = 1.0
    while share > LEAST_SIZE:
        motion = Motion(middle + share * shape.mean, share * size * shape.sine, share * size * shape.cosine, shape.period_s)
        q, qd, qdd = sampled(motion, FEW)
        torque = inverse_dynamics(arm.chain, q, qd, qdd) @ arm.inertial + arm.rotor_inertia * qdd
        if (np.abs(torque) < TORQUE * arm.torque_limit).all():
            motion.condition = condition(arm, base, motion)
            return motion
        share *= SHRINK
    return motion


def condition(arm: NominalArm, base: Base, motion: Motion) -> float:
    q, qd, qdd = sampled(motion, MANY)
    Y = np.concatenate([inverse_dynamics(arm.chain, q, qd, qdd), diagonal(qd), diagonal(np.sign(qd))], axis=2)
    W = Y[:, :, base.columns] / np.minimum(arm.torque_limit, 1e6)[:, None]
    return condition_of(W.reshape(-1, W.shape[2]))


def sampled(motion: Motion, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Angles, speeds and accelerations over a period."""
    w = 2 * np.pi / motion.period_s * np.arange(1, HARMONICS + 1)
    turn = np.outer((np.arange(count) + 0.5) * motion.period_s / count, w)
    S, C = np.sin(turn), np.cos(turn)
    return (motion.mean + S @ motion.sine + C @ motion.cosine, (C * w) @ motion.sine - (S * w) @ motion.cosine,
            -(S * w * w) @ motion.sine - (C * w * w) @ motion.cosine)


def scenario_text(arm: NominalArm, arm_file: str, motion: Motion, seed: int) -> str:
    """That runs at once."""
    def text(chosen: gains.Gains) -> str:
        return f"""# A motion that tells the parameters of {arm.name} apart, for `tools/reed identify`.
# Condition number of the regressor: {motion.condition:.1f}. The surroundings of the arm are not known here: clear them.
arm = "{arm_file}"

[scenario]
name = "excite_{arm.name}"
description = "A Fourier series of {HARMONICS} harmonics per joint, condition number {motion.condition:.1f}."
duration_s = {motion.period_s + 0.5:g}
seed = {seed}

[reference]
start_rad = {in_line(motion.start)}
[[reference.legs]]
kind = "fourier"
duration_s = {motion.period_s:g}
frequency_hz = {1 / motion.period_s:.9g}
sine_rad = [{rows(motion.sine)}]
cosine_rad = [{rows(motion.cosine)}]
{plant(arm)}
[limits]
unexplained_torque_share = 0.3   # the arm's parameters are not known yet: the law leaves an error
stuck_rad = 0.1

{chosen.lines()}
[[checks]]
name = "faults"
limit = 0
"""

    return gains.accepted(gains.by_rule(arm, motion.start), text)


def rows(values: np.ndarray) -> str:
    return "".join(f"\n  {in_line(row)}," for row in values) + "\n"


def in_line(values: np.ndarray) -> str:
    return f"[{', '.join(f'{value:.7f}' for value in values)}]"
