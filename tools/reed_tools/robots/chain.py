"""An arm file's kinematics in one form, however it is written: per joint a fixed transform, then a rotation about z."""

from dataclasses import dataclass

import numpy as np

from reed_tools.robots.joint_frames import mounts, transform_of


OLDER_TOOLS = ("tool_offset_in_last_frame", "tool_offset")  # keys of the tool point that are still read


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


def chain_of(arm: dict) -> Chain:
    """From the [arm] table; a shift along z behind a joint's turn is part of the joint's place, as a turn about z leaves it."""
    found = mounts(arm)
    older = next((arm[key] for key in OLDER_TOOLS if key in arm), [0.0, 0.0, 0.0])
    tool = transform_of(arm["tool"]) if "tool" in arm else (np.eye(3), np.array(older, dtype=float))
    return Chain(np.array([mount.R for mount in found]), np.array([mount.p + mount.d * mount.R[:, 2] for mount in found]), *tool,
                 np.array(arm.get("gravity", [0.0, 0.0, -9.81]), dtype=float))


def turned(chain: Chain, joint: int, q: np.ndarray) -> np.ndarray:
    """Rotations of a joint's frame in the one before, [n, 3, 3]; q: its angle, [n]."""
    c, s, R = np.cos(q)[:, None], np.sin(q)[:, None], chain.rotation[joint]
    return np.stack([c * R[:, 0] + s * R[:, 1], -s * R[:, 0] + c * R[:, 1], np.broadcast_to(R[:, 2], (len(q), 3))], axis=2)


@dataclass(frozen=True)
class Frames:
    """Link frames for many poses in base axes, [dof, n, …]."""

    R: np.ndarray  # [dof, n, 3, 3]
    p: np.ndarray  # [dof, n, 3], m

    def tool(self, chain: Chain) -> np.ndarray:
        """The tool point, [n, 3]."""
        return self.p[-1] + self.R[-1] @ chain.tool_offset


def frames_of(chain: Chain, q: np.ndarray) -> Frames:
    """q: [n, dof], rad."""
    R, p = np.broadcast_to(np.eye(3), (len(q), 3, 3)), np.zeros((len(q), 3))
    rotations, origins = [], []
    for joint in range(chain.dof):
        p = p + R @ chain.offset[joint]
        R = R @ turned(chain, joint, q[:, joint])
        rotations.append(R)
        origins.append(p)
    return Frames(np.array(rotations), np.array(origins))


def jacobians(at: Frames, body: int, offset) -> tuple[np.ndarray, np.ndarray]:
    """J_v, J_w of a point fixed to a link, each [n, 3, dof]. offset: m, axes of that link."""
    dof, count = at.p.shape[:2]
    point = at.p[body] + at.R[body] @ np.asarray(offset)
    J_v, J_w = np.zeros((count, 3, dof)), np.zeros((count, 3, dof))
    for joint in range(body + 1):
        axis = at.R[joint][:, :, 2]
        J_w[:, :, joint] = axis
        J_v[:, :, joint] = np.cross(axis, point - at.p[joint])
    return J_v, J_w


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
