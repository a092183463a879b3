"""The arm, the wall and a force as lines, plates and arrows: what every picture in space is made from. World frame, m."""

from dataclasses import dataclass

import numpy as np

from reed_tools.robots.chain import chain_of, transform_of
from reed_tools.robots.joint_frames import mounts, quaternion_of
from reed_tools.robots.rigid_arm import poses

FORCE_mPN = 0.01      # length of a force's arrow
LEAST_FORCE_N = 0.05  # below it there is no arrow
PLATE_m = (0.4, 0.4, 0.002)
ARM_RGB, GHOST_RGB, WALL_RGB, FORCE_RGB, TRACE_RGB = (214, 94, 0), (150, 150, 150), (86, 180, 233), (200, 0, 40), (0, 114, 178)


def centre_line(arm: dict, q: np.ndarray) -> np.ndarray:
    """Rigid arms for many poses, [n, points, 3]: from each link to the next joint, then along its axis or its members, at last
    the tool point."""
    at = poses(arm, q)
    R, p = np.broadcast_to(np.eye(3), (len(q), 3, 3)), np.zeros((len(q), 3))
    points = [p + transform_of(arm.get("base", {}))[1]]
    for joint, mount in enumerate(mounts(arm)):
        points.append(p + R @ mount.p)
        R, p = at.R[joint], at.p[joint]
        points += [p + R @ end for end in member_ends(arm, joint)] or [p]
    return np.stack([*points, p + R @ chain_of(arm).tool_offset], axis=1)


def member_ends(arm: dict, joint: int) -> list[np.ndarray]:
    """Of the members of the link that this joint moves, base to tip, in the link's frame."""
    return [np.array(member.get(end, [0.0, 0.0, 0.0]), dtype=float) for member in arm.get("member", []) if member["link"] == joint + 1
            for end in ("from_m", "to_m")]


def joint_transforms(arm: dict, q: np.ndarray) -> list[tuple[str, tuple, tuple]]:
    """(name, position, quaternion w x y z) of every link frame in the one before, of the first one in the world."""
    found = []
    for mount, theta in zip(mounts(arm), q):
        c, s = np.cos(theta), np.sin(theta)
        R = mount.R @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        found.append((mount.frame, tuple(mount.p + mount.d * R[:, 2]), quaternion_of(R)))
    return found


@dataclass
class Plate:
    centre: np.ndarray
    q: tuple  # w x y z: z axis along the wall's normal
    size: tuple = PLATE_m


def wall_plate(effective: dict) -> Plate | None:
    """The true wall, seen from the robot: its surface is the plate's upper face."""
    wall = effective["wall"]
    if not wall.get("present", False):
        return None
    normal = np.array(wall["normal"], dtype=float)
    normal /= np.linalg.norm(normal)
    surface = np.array(wall["point_m"], dtype=float) + wall["offset_m"] * normal
    return Plate(surface - PLATE_m[2] / 2 * normal, turn_to(normal, (0.0, 0.0, 1.0)))


def drawn(rigid: np.ndarray, bent: np.ndarray, scale: float) -> np.ndarray:
    """Points of an arm whose bending is exaggerated; 1 is the true shape."""
    return rigid + scale * (bent - rigid)


def arrow(tip: np.ndarray, force: np.ndarray) -> np.ndarray | None:
    """From where to where a force on the tip is drawn; None for one too small to be seen."""
    return np.array([tip, tip + FORCE_mPN * force]) if np.linalg.norm(force) >= LEAST_FORCE_N else None


def corners(plate: Plate) -> np.ndarray:
    """Of the plate's upper face, [4, 3], one behind the other."""
    w, x, y, z = plate.q
    R = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                  [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                  [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    half = np.array(plate.size) / 2
    return plate.centre + np.array([(i, j, 1) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]) * half @ R.T


def aim(direction) -> tuple:
    """Quaternion w x y z that turns x into this direction: where arrows point."""
    return turn_to(np.asarray(direction, dtype=float), (1.0, 0.0, 0.0))


def turn_to(direction: np.ndarray, axis: tuple) -> tuple:
    """The shortest turn of `axis` into `direction`."""
    to, start = direction / np.linalg.norm(direction), np.array(axis)
    w = 1.0 + start @ to
    if w < 1e-9:  # opposite: half a turn about any axis across
        across = np.cross(start, np.eye(3)[np.argmin(np.abs(start))])
        return (0.0, *(across / np.linalg.norm(across)))
    q = np.array([w, *np.cross(start, to)])
    return tuple(q / np.linalg.norm(q))
