"""The chain from a URDF's base to its tip in the inner form: a fixed transform, then a rotation about z, per joint; links that
do not move against each other are one body."""

from dataclasses import dataclass, field

import numpy as np

from reed_tools.arms.urdf import Joint, Robot
from reed_tools.errors import UsageError
from reed_tools.robots.chain import turn_of_z
from reed_tools.robots.pseudo_inertia import body_of, matrix_of, placed
from reed_tools.text import did_you_mean

MOST_JOINTS = 8
WIDEST_rad = 6.3


@dataclass
class SerialJoint:
    name: str
    frame: str
    rotation: np.ndarray
    offset: np.ndarray
    body: np.ndarray  # ten parameters of everything that moves with it, in its frame
    lower: float
    upper: float
    effort: float
    speed: float
    damping: float | None
    friction: float | None


@dataclass
class Serial:
    name: str
    base: str
    tip: str
    joints: list[SerialJoint]
    tool_rotation: np.ndarray
    tool_offset: np.ndarray
    held: list[str] = field(default_factory=list)  # moving joints beside the chain, at 0


def serial_of(robot: Robot, base: str | None, tip: str | None, limits: dict[str, list[float]]) -> Serial:
    path = path_of(robot, base, tip)
    base = path[0].parent if path else base
    moving = [joint for joint in path if joint.moves]
    refuse_kinds(robot, moving)
    for name in limits:
        if name not in [joint.name for joint in moving]:
            raise UsageError(f"--limit {name}: no joint of the chain; allowed: {', '.join(joint.name for joint in moving)}{did_you_mean(name, [joint.name for joint in moving])}")
    found = Serial(robot.name, base, path[-1].child, [], np.eye(3), np.zeros(3))
    R, p = np.eye(3), np.zeros(3)  # of the link that the walk has reached, in the frame of the last moving joint
    for joint in path:
        R, p = R @ joint.rotation, p + R @ joint.offset
        if joint.moves:
            turn = turn_of_z(joint.axis)
            frame = (R @ turn, p)
            P = body_below(robot, joint.child, turn.T, np.zeros(3), {other.child for other in path if other.moves}, found.held)
            found.joints.append(SerialJoint(joint.name, joint.child, *frame, body_of(P), *limits_of(robot, joint, limits.get(joint.name, [])),
                                            joint.dynamics.get("damping"), joint.dynamics.get("friction")))
            R, p = turn.T, np.zeros(3)
            if not P[3, 3] > 0:
                raise UsageError(f"{robot.where}: link {joint.child} and what is fixed to it have no mass (0 kg, moments 0, 0, 0 kg·m²); allowed: above 0")
    found.tool_rotation, found.tool_offset = R, p
    return found


def path_of(robot: Robot, base: str | None, tip: str | None) -> list[Joint]:
    for option, link in (("--base", base), ("--tip", tip)):
        if link is not None and link not in robot.links:
            raise UsageError(f"{option} {link}: {robot.where} has no such link{did_you_mean(link, robot.links)}")
    start = base or robot.root()
    if tip is None:
        tips = leaves(robot, start)
        if len(tips) != 1:
            raise UsageError(f"{robot.where}: {len(tips) or 'no'} tip{'s' if len(tips) != 1 else ''} ({', '.join(tips[:8])}{' …' if len(tips) > 8 else ''}); --tip LINK chooses one")
        tip = tips[0]
    path, link = [], tip
    while link != start:
        if link not in robot.joints:
            raise UsageError(f"{robot.where}: link {tip} is not behind link {start}; allowed: --tip LINK behind --base LINK")
        path.insert(0, robot.joints[link])
        link = path[0].parent
    return path


def leaves(robot: Robot, link: str) -> list[str]:
    found, waiting = [], [link]
    while waiting:
        here = waiting.pop()
        children = [joint.child for joint in robot.children(here)]
        waiting += reversed(children)
        if not children and here != link:
            found.append(here)
    return found


def refuse_kinds(robot: Robot, moving: list[Joint]) -> None:
    for joint in moving:
        if joint.mimic:
            raise UsageError(f"{robot.where}: joint {joint.name} mimics another; allowed between base and tip: joints that move on their own")
        if joint.kind not in ("revolute", "continuous"):
            raise UsageError(f"{robot.where}: joint {joint.name} is {joint.kind}; allowed between base and tip: revolute, continuous, fixed")
    if not moving:
        raise UsageError(f"{robot.where}: no joint moves between base and tip")
    if len(moving) > MOST_JOINTS:
        raise UsageError(f"{robot.where}: {len(moving)} joints between base and tip; allowed: 1 ... {MOST_JOINTS}; --base LINK and --tip LINK choose a shorter chain")


def limits_of(robot: Robot, joint: Joint, given: list[float]) -> tuple[float, float, float, float]:
    """Lower, upper, effort, speed: from the file, or asked for by name."""
    keys = ("lower", "upper", "effort", "velocity")
    limit = {key: value for key, value in joint.limit.items() if joint.kind == "revolute" or key in keys[2:]}
    limit |= dict(zip(keys, given))
    if joint.kind == "revolute" and not given:
        limit = {"lower": 0.0, "upper": 0.0} | limit  # URDF's defaults; refused below if both are left
    missing = [key for key in keys if key not in limit]
    ask = f"--limit {joint.name}=LOWER,UPPER,EFFORT,SPEED gives them (rad, rad, N·m, rad/s; the last two only where the file has none)"
    if missing:
        why = "is continuous" if joint.kind == "continuous" else "has no limits"
        raise UsageError(f"{robot.where}: joint {joint.name} {why}: {', '.join(missing)} missing; {ask}")
    if not (limit["lower"] < limit["upper"] and limit["effort"] > 0 and limit["velocity"] > 0):
        raise UsageError(f"{robot.where}: joint {joint.name}: limits {limit['lower']:g} ... {limit['upper']:g} rad, {limit['effort']:g} N·m, "
                         f"{limit['velocity']:g} rad/s; allowed: lower below upper, the others above 0; {ask}")
    if max(abs(limit["lower"]), abs(limit["upper"])) > WIDEST_rad:
        raise UsageError(f"{robot.where}: joint {joint.name}: limits {limit['lower']:g} ... {limit['upper']:g}; allowed: within ±{WIDEST_rad:g} rad "
                         f"(radians, not degrees); {ask}")
    return limit["lower"], limit["upper"], limit["effort"], limit["velocity"]


def body_below(robot: Robot, link: str, R: np.ndarray, p: np.ndarray, others: set[str], held: list[str]) -> np.ndarray:
    """Pseudo-inertia of a link and everything that hangs on it without a moving joint of the chain, seen from R, p."""
    if robot.links[link].problem:
        raise UsageError(robot.links[link].problem)
    P = placed(matrix_of(robot.links[link].body), R, p) if robot.links[link].body is not None else np.zeros((4, 4))
    for joint in robot.children(link):
        if joint.child not in others:
            if joint.moves:
                held.append(joint.name)
            P = P + body_below(robot, joint.child, R @ joint.rotation, p + R @ joint.offset, others, held)
    return P
