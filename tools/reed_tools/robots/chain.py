"""An arm file's kinematics in one form, however it is written: per joint a fixed transform, then a rotation about z."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Chain:
    rotation: np.ndarray       # [dof, 3, 3], of each joint's frame at angle 0 in the frame before
    offset: np.ndarray         # [dof, 3], m, of its origin there
    tool_rotation: np.ndarray  # of the tool in the last frame
    tool_offset: np.ndarray    # m
    gravity: np.ndarray        # m/s², in the frame that positions are given in

    @property
    def dof(self) -> int:
        return len(self.offset)


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


def chain_of(arm: dict) -> Chain:
    """From the [arm] table: `joint` tables, or Craig rows `dh` [alpha, a, d, offset], T = Rx(alpha) Tx(a) Rz(theta + offset) Tz(d)."""
    if "joint" in arm:
        steps = [transform_of(joint) for joint in arm["joint"]]
    else:
        steps = [(rotation_x(alpha) @ rotation_rpy([0.0, 0.0, sum(offset)]), np.array([a, -d * np.sin(alpha), d * np.cos(alpha)]))
                 for alpha, a, d, *offset in arm["dh"]]
    if "base" in arm:
        R, p = transform_of(arm["base"])
        steps[0] = (R @ steps[0][0], p + R @ steps[0][1])
    tool = transform_of(arm["tool"]) if "tool" in arm else (np.eye(3), np.array(arm.get("tool_offset", [0.0, 0.0, 0.0]), dtype=float))
    return Chain(np.array([R for R, _ in steps]), np.array([p for _, p in steps]), *tool,
                 np.array(arm.get("gravity", [0.0, 0.0, -9.81]), dtype=float))


def turned(chain: Chain, joint: int, q: np.ndarray) -> np.ndarray:
    """Rotations of a joint's frame in the one before, [n, 3, 3]; q: its angle, [n]."""
    c, s, R = np.cos(q)[:, None], np.sin(q)[:, None], chain.rotation[joint]
    return np.stack([c * R[:, 0] + s * R[:, 1], -s * R[:, 0] + c * R[:, 1], np.broadcast_to(R[:, 2], (len(q), 3))], axis=2)


def turn_of_z(axis: np.ndarray) -> np.ndarray:
    """A rotation whose z axis is `axis`, exact for the axes of a frame; the identity for z itself."""
    z = axis / np.linalg.norm(axis)
    across = np.eye(3)[int(np.argmin(np.abs(z)))] if z[2] != 1.0 else np.eye(3)[0]
    x = across - (across @ z) * z
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def rpy_of(R: np.ndarray) -> np.ndarray:
    """Roll, pitch, yaw of a rotation, as exact near pitch ±90° as elsewhere: roll is what is left without yaw and pitch."""
    yaw = np.arctan2(R[1, 0], R[0, 0]) if np.hypot(R[0, 0], R[1, 0]) > 1e-15 else 0.0
    c, s = np.cos(yaw), np.sin(yaw)
    pitch = np.arctan2(-R[2, 0], c * R[0, 0] + s * R[1, 0])
    roll = np.arctan2(s * R[0, 2] - c * R[1, 2], c * R[1, 1] - s * R[0, 1])
    return np.array([roll, pitch, yaw]) + 0.0
