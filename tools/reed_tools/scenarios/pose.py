"""A start pose from which an arm can move: away from singularities, from its joint limits and from its torque limits."""

from dataclasses import dataclass

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.robots.chain import Chain, frames_of, jacobians
from reed_tools.robots.nominal import NominalArm
from reed_tools.scenarios import gains

DRAWS, CANDIDATES, SEED = 3000, 200, 1
LEAST_ROOM = 0.15     # share of a joint's range that is left on either side
HELD = 0.5            # share of the torque limits for weight
PRESSED = 0.75        # and for weight and force together
CLEAR_m = 0.03        # height of other frames above the wall, near the tool point
LEAST_GAIN = 0.05     # smallest singular value of the tool point's Jacobian, times 1 / reach
COUPLED = 0.1         # below it, less coupling is no gain
FREQUENCY_HZ = 0.5    # of the slide
SPEED = 0.3           # share of the speed limits that it may take
SLIDE_WEAKEST = 0.3   # it has a share of the directions in which the arm moves with that share of its best
BEYOND = 1.5          # times its amplitude is within limits, too
PATH = 9              # samples of its path
SHORTEST = 0.4        # of the amplitude asked for: a slide that joints' speeds make shorter is none
NEWTON, DAMPING, LONGEST_STEP_rad = 60, 1e-3, 0.2
USED = 0.02           # a direction counts if the arm reaches that share of its largest speed there


@dataclass(frozen=True)
class Pose:
    q: np.ndarray
    tip: np.ndarray     # m
    slide: list[float]  # m, amplitude of the tool point's slide


def origins(chain: Chain, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Origins of the links' frames and of the tool, [n, dof + 1, 3], and the tool point's Jacobians, [n, 3, dof]."""
    at = frames_of(chain, q)
    return np.concatenate([at.p, at.tool(chain)[None]]).swapaxes(0, 1), jacobians(at, chain.dof - 1, chain.tool_offset)[0]


def reach_of(chain: Chain) -> float:
    return float(np.linalg.norm([*chain.offset[1:], chain.tool_offset], axis=1).sum())


def find(arm: NominalArm, normal: np.ndarray, force_N: float, amplitude_m: float) -> Pose:
    """The best of many, with a slide from there. normal: of a wall that is to be pressed with force_N; without a force anything in space will do."""
    room = arm.position_max - arm.position_min
    q = np.random.default_rng(SEED).uniform(arm.position_min + LEAST_ROOM * room, arm.position_max - LEAST_ROOM * room, (DRAWS, arm.dof))
    points, J = origins(arm.chain, q)
    reach = reach_of(arm.chain)
    singular = np.linalg.svd(J, compute_uv=False)
    rank = int((np.median(singular, axis=0) > USED * np.median(singular[:, 0])).sum())
    gain = singular[:, rank - 1] / reach
    weight = np.abs(gains.gravity_torque(arm, q))
    held = weight / arm.torque_limit
    scores = [gain / LEAST_GAIN, HELD / np.maximum(held.max(axis=1), 1e-9),
              (np.minimum(q - arm.position_min, arm.position_max - q) / room).min(axis=1) / LEAST_ROOM]
    if force_N > 0:
        along = np.einsum("i,nij->nj", normal, J)
        pressed = (weight + force_N * np.abs(along)) / arm.torque_limit
        scores += [PRESSED / np.maximum(pressed.max(axis=1), 1e-9), clearance(points, normal, reach),
                   np.linalg.norm(along, axis=1) / (2 * LEAST_GAIN * reach)]
    score = np.min(np.minimum(scores, 4.0), axis=0)
    first = np.argsort(-score)[:CANDIDATES]
    first = first[score[first] >= 1.0]
    if force_N > 0 and len(first):
        first = first[np.argsort((COUPLED + coupling(arm, q[first], J[first], normal)) / score[first])]
    for best in first:
        if amplitude := slide(arm, q[best], J[best], rank, amplitude_m, normal if force_N > 0 else None):
            return Pose(q[best], points[best, -1], amplitude)
    raise UsageError(f"{arm.name}: in none of {DRAWS} poses is it clear of singularities and limits"
                     + (f" while it presses {force_N:g} N" if force_N else "") + "; allowed: less force, or an arm with wider limits")


def coupling(arm: NominalArm, q: np.ndarray, J: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """How much a force along the wall moves the tip towards it, as a share of what the same force across does: friction
    of the wall disturbs the force by that."""
    mobility = J @ np.linalg.solve(gains.inertia(arm, q), np.swapaxes(J, 1, 2))
    across = mobility @ normal
    own = across @ normal
    return np.linalg.norm(across - own[:, None] * normal, axis=1) / own


def slide(arm: NominalArm, q: np.ndarray, J: np.ndarray, rank: int, amplitude_m: float, normal: np.ndarray | None) -> list[float] | None:
    """A displacement along which the arm moves well, shorter where joints would be fast; None if it leads to a limit or a
    singularity. It has a share of every base axis that the arm can follow."""
    along = np.eye(3) if normal is None else np.eye(3) - np.outer(normal, normal)
    U, size, _ = np.linalg.svd(along @ J)
    used = U[:, :len(size)][:, size > SLIDE_WEAKEST * size[0]]
    direction = used @ (used.T @ (along @ np.ones(3)))
    if np.abs(direction).max() < 0.1:
        direction = used[:, 0]
    direction = direction / np.abs(direction).max()
    steps = BEYOND * np.linspace(-1.0, 1.0, PATH)
    there = path(arm.chain, q, np.outer(steps, amplitude_m * direction))
    if there is None:
        return None
    room = arm.position_max - arm.position_min
    if (np.minimum(there - arm.position_min, arm.position_max - there) < 0.5 * LEAST_ROOM * room).any():
        return None
    if np.linalg.svd(origins(arm.chain, there)[1], compute_uv=False)[:, rank - 1].min() < LEAST_GAIN * reach_of(arm.chain):
        return None
    speed = 2 * np.pi * FREQUENCY_HZ * (np.abs(np.diff(there, axis=0)) / np.diff(steps)[:, None]).max(axis=0)
    share = min(1.0, float(np.min(SPEED * arm.speed_limit / np.maximum(speed, 1e-9))))
    return (np.round(amplitude_m * share * direction, 4) + 0.0).tolist() if share > SHORTEST else None


def path(chain: Chain, q: np.ndarray, by: np.ndarray) -> np.ndarray | None:
    """Angles at each displacement of the tool point, from the middle one outwards; None where one is not reached."""
    middle = len(by) // 2
    found: list[np.ndarray | None] = [None] * len(by)
    found[middle] = q
    for step in (1, -1):
        for k in range(middle + step, len(by) if step > 0 else -1, step):
            found[k] = follow(chain, q, by[k], found[k - step])
            if found[k] is None:
                return None
    return np.array(found)


def follow(chain: Chain, q_start: np.ndarray, by: np.ndarray, near: np.ndarray) -> np.ndarray | None:
    """Angles near `near` with the tool point of q_start displaced and its orientation kept as far as the joints allow, as the path
    planner finds them: position first, orientation in what is left. None where it does not get there."""
    R_start, start, _, _ = tip_frame(chain, q_start)
    q = near
    for _ in range(NEWTON):
        R, tip, J, J_w = tip_frame(chain, q)
        rest = start + by - tip
        back = np.linalg.pinv(J, rcond=1e-6)
        step = back @ rest
        left = J_w @ (np.eye(len(q)) - back @ J)
        turn = 0.5 * np.cross(R.T, R_start.T).sum(axis=0) - J_w @ step
        step = step + left.T @ np.linalg.solve(left @ left.T + DAMPING**2 * np.eye(3), turn)
        q = q + step * min(1.0, LONGEST_STEP_rad / np.abs(step).max(initial=1e-12))
        if np.linalg.norm(rest) < 1e-8 and np.abs(step).max() < 1e-6:
            return q
    return None


def tip_frame(chain: Chain, q: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """The tool point's rotation and place, J_v and J_w."""
    at = frames_of(chain, q[None])
    J_v, J_w = jacobians(at, chain.dof - 1, chain.tool_offset)
    return at.R[-1, 0], at.tool(chain)[0], J_v[0], J_w[0]


def clearance(points: np.ndarray, normal: np.ndarray, reach: float) -> np.ndarray:
    """How far links near the tool point are in front of the wall through it; frames further away are beside the wall."""
    to_tip = points[:, 1:-1] - points[:, -1:]
    height = to_tip @ normal
    beside = np.linalg.norm(to_tip - height[:, :, None] * normal, axis=2) > 0.35 * reach
    coincident = np.linalg.norm(to_tip, axis=2) < 1e-6  # a tool point at the last joint
    return np.where(beside | coincident, np.inf, height / CLEAR_m).min(axis=1, initial=np.inf)
