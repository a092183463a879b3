"""The joints of an arm table, as `[[joint]]` or as Denavit-Hartenberg rows: a fixed transform, a turn about z, a shift along z."""

from dataclasses import dataclass

import numpy as np


@dataclass
class Mount:
    """A joint in the frame of the link before it, at angle 0; for the first one in the world frame."""

    R: np.ndarray  # columns: its axes
    p: np.ndarray  # m
    d: float       # m, from there along its z to the frame of the link that it moves: of a row
    frame: str     # name of that frame


def rotation_x(angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def rotation_rpy(rpy) -> np.ndarray:
    """Rz(yaw) Ry(pitch) Rx(roll), as URDF has it."""
    cp, sp, cy, sy = np.cos(rpy[1]), np.sin(rpy[1]), np.cos(rpy[2]), np.sin(rpy[2])
    pitch = np.array([[cp, 0.0, sp], [0.0, 1.0, 0.0], [-sp, 0.0, cp]])
    yaw = np.array([[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]])
    return yaw @ pitch @ rotation_x(rpy[0])


def transform_of(table: dict) -> tuple[np.ndarray, np.ndarray]:
    return rotation_rpy(table.get("rpy_rad", [0.0, 0.0, 0.0])), np.array(table.get("xyz_m", [0.0, 0.0, 0.0]), dtype=float)


def dof(arm: dict) -> int:
    return len(arm.get("dh") or arm.get("joint") or [])


def mounts(arm: dict) -> list[Mount]:
    found = [Mount(R, p, d, frame or f"link_{number + 1}") for number, (R, p, d, frame) in enumerate(fixed_transforms(arm))]
    R, p = transform_of(arm.get("base", {}))
    found[0].R, found[0].p = R @ found[0].R, p + R @ found[0].p
    return found


def fixed_transforms(arm: dict) -> list[tuple]:
    """R, p, shift along z, frame name."""
    if "joint" in arm:
        return [(*transform_of(joint), 0.0, joint.get("frame", "")) for joint in arm["joint"]]
    return [(rotation_rpy([alpha, 0.0, 0.0]) @ rotation_rpy([0.0, 0.0, sum(offset)]), np.array([a, 0.0, 0.0]), d, "")
            for alpha, a, d, *offset in arm["dh"]]


def quaternion_of(R: np.ndarray) -> tuple:
    """w x y z of a rotation, the largest component positive."""
    squared = np.array([1 + R[0, 0] + R[1, 1] + R[2, 2], 1 + R[0, 0] - R[1, 1] - R[2, 2],
                        1 - R[0, 0] + R[1, 1] - R[2, 2], 1 - R[0, 0] - R[1, 1] + R[2, 2]]) / 4
    products = np.array([[0.0, R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]],
                         [R[2, 1] - R[1, 2], 0.0, R[0, 1] + R[1, 0], R[0, 2] + R[2, 0]],
                         [R[0, 2] - R[2, 0], R[0, 1] + R[1, 0], 0.0, R[1, 2] + R[2, 1]],
                         [R[1, 0] - R[0, 1], R[0, 2] + R[2, 0], R[1, 2] + R[2, 1], 0.0]]) / 4
    largest = int(np.argmax(squared))
    products[largest, largest] = squared[largest]
    return tuple(products[largest] / np.sqrt(squared[largest]))
