"""A motion that tells an arm's parameters apart: moves between poses, chosen so that the regressor's condition number is low.
Every move keeps a share of the nominal arm's limits of angle, speed and torque. It knows nothing of what stands around the arm."""

from dataclasses import dataclass

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.identify.base import Base, base_of
from reed_tools.identify.least_squares import LARGEST_CONDITION, condition_of
from reed_tools.robots.nominal import NominalArm
from reed_tools.robots.regressor import inverse_dynamics
from reed_tools.scenarios import gains
from reed_tools.scenarios.new import plant

POSES = 18
RANGE, SPEED, TORQUE = 0.75, 0.6, 0.6  # shares of the limits
WIDEST_rad = 1.6       # from the middle of a joint's range
SHORTEST_s, LONGEST_s = 0.7, 6.0
PER_MOVE = 14          # samples
TRIALS = 260
PEAK_SPEED = 1.875     # of a minimum-jerk move, times its length over its time


@dataclass
class Motion:
    poses: np.ndarray       # rad, [POSES, dof]
    durations: np.ndarray   # s, of the moves between them
    condition: float


def scenario(arm: NominalArm, arm_file: str, seed: int) -> tuple[str, Motion]:
    motion = motion_of(arm, seed)
    if not motion.condition < LARGEST_CONDITION:
        raise UsageError(f"{arm.name}: no motion within its limits tells its parameters apart: condition number {motion.condition:.3g}, "
                         f"allowed: below {LARGEST_CONDITION:g}")
    return scenario_text(arm, arm_file, motion, seed), motion


def motion_of(arm: NominalArm, seed: int) -> Motion:
    base, rng = base_of(arm), np.random.default_rng(seed)
    middle, half = (arm.position_min + arm.position_max) / 2, (arm.position_max - arm.position_min) / 2
    half = np.minimum(RANGE * half, WIDEST_rad)

    def draw() -> np.ndarray:
        for _ in range(1000):
            pose = middle + half * rng.uniform(-1, 1, arm.dof)
            if (np.abs(gains.gravity_torque(arm, pose[None])[0]) < TORQUE * arm.torque_limit).all():
                return pose
        raise UsageError(f"{arm.name}: in no pose of a thousand does the arm hold its weight with {100 * TORQUE:g} % of its torque limits")

    best = judged(arm, base, np.array([draw() for _ in range(POSES)]))
    for trial in range(TRIALS):
        poses = best.poses.copy()
        poses[trial % POSES] = draw()
        tried = judged(arm, base, poses)
        if tried.condition < best.condition:
            best = tried
    return best


def judged(arm: NominalArm, base: Base, poses: np.ndarray) -> Motion:
    """Moves as quick as the limits allow, and their condition number."""
    lengths = np.abs(np.diff(poses, axis=0))
    durations = np.maximum((PEAK_SPEED * lengths / (SPEED * arm.speed_limit)).max(axis=1), SHORTEST_s)
    while True:
        q, qd, qdd = sampled(poses, durations)
        Y = inverse_dynamics(arm.chain, q, qd, qdd)
        torque = Y @ arm.inertial + arm.rotor_inertia * qdd
        over = (np.abs(torque) > 1.2 * TORQUE * arm.torque_limit).any(axis=1).reshape(len(durations), PER_MOVE).any(axis=1)
        if not over.any() or (durations[over] > LONGEST_s).all():
            break
        durations[over & (durations <= LONGEST_s)] *= 1.2
    friction = [part[:, :, None] * np.eye(arm.dof) for part in (qd, np.sign(qd))]
    W = np.concatenate([Y, *friction], axis=2)[:, :, base.columns] / np.minimum(arm.torque_limit, 1e6)[:, None]
    return Motion(poses, np.ceil(20 * durations) / 20, condition_of(W.reshape(-1, W.shape[2])))


def sampled(poses: np.ndarray, durations: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Minimum-jerk moves, PER_MOVE samples each."""
    x = (np.arange(PER_MOVE) + 0.5)[None, :, None] / PER_MOVE
    start, by, T = poses[:-1, None], np.diff(poses, axis=0)[:, None], durations[:, None, None]
    q = start + by * x**3 * (10 - 15 * x + 6 * x * x)
    qd = by * 30 * x * x * (1 - x) ** 2 / T
    qdd = by * 60 * x * (1 - 3 * x + 2 * x * x) / T**2
    return tuple(part.reshape(-1, poses.shape[1]) for part in (q, qd, qdd))


def scenario_text(arm: NominalArm, arm_file: str, motion: Motion, seed: int) -> str:
    """That runs at once."""
    legs = "".join(f'[[reference.legs]]\nkind = "joint"\nduration_s = {duration:g}\nto_rad = {in_line(pose)}\n'
                   for pose, duration in zip(motion.poses[1:], motion.durations))

    def text(chosen: gains.Gains) -> str:
        return f"""# Moves that tell the parameters of {arm.name} apart, for `tools/reed identify`.
# Condition number of the regressor: {motion.condition:.1f}. The surroundings of the arm are not known here: clear them.
arm = "{arm_file}"

[scenario]
name = "excite_{arm.name}"
description = "Moves between {len(motion.poses)} poses, condition number {motion.condition:.1f}."
duration_s = {motion.durations.sum() + 0.5:g}
seed = {seed}

[reference]
start_rad = {in_line(motion.poses[0])}
{legs}{plant(arm)}
{chosen.lines()}
[[checks]]
name = "faults"
limit = 0
"""

    return gains.accepted(gains.by_rule(arm, motion.poses[0]), text)


def in_line(values: np.ndarray) -> str:
    return f"[{', '.join(f'{value:.4f}' for value in values)}]"
