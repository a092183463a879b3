"""Inverse dynamics of rigid links, linear in ten inertial parameters per link: tau = Y(q, q', q'') pi, for many states at
once. Per link [m, m c (3), I (6)]: kg, kg·m, kg·m² about the frame's origin, axes of the link frame, Pinocchio's order."""

import numpy as np

from reed_tools.robots.chain import Chain, turned

NAMES = ("m", "mx", "my", "mz", "Ixx", "Ixy", "Iyy", "Ixz", "Iyz", "Izz")
UNITS = ("kg", "kg·m", "kg·m", "kg·m", *["kg·m²"] * 6)
PER_LINK = len(NAMES)
CELLS = ((0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2))  # of I, in that order


def skew(v: np.ndarray) -> np.ndarray:
    """[n, 3] → [n, 3, 3]: the matrix of v ×."""
    x, y, z, zero = v[:, 0], v[:, 1], v[:, 2], np.zeros(len(v))
    return np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=1).reshape(-1, 3, 3)


def times_inertia(v: np.ndarray) -> np.ndarray:
    """I v = L(v) [Ixx Ixy Iyy Ixz Iyz Izz], [n, 3, 6]."""
    out = np.zeros((len(v), 3, len(CELLS)))
    for column, (i, j) in enumerate(CELLS):
        out[:, i, column] = v[:, j]
        out[:, j, column] = v[:, i]
    return out


def of_link(omega: np.ndarray, alpha: np.ndarray, a: np.ndarray) -> np.ndarray:
    """Force and moment (about the origin) that a link needs, per unit of its parameters, [n, 6, 10]. a: without gravity's pull."""
    W = np.zeros((len(a), 6, PER_LINK))
    W[:, :3, 0] = a
    W[:, :3, 1:4] = skew(alpha) + skew(omega) @ skew(omega)
    W[:, 3:, 1:4] = -skew(a)
    W[:, 3:, 4:] = times_inertia(alpha) + skew(omega) @ times_inertia(omega)
    return W


def inverse_dynamics(chain: Chain, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray) -> np.ndarray:
    """Y, [n, dof, 10 dof]."""
    count, dof = q.shape
    Y = np.zeros((count, dof, PER_LINK * dof))
    omega, alpha, a = np.zeros((count, 3)), np.zeros((count, 3)), np.broadcast_to(-chain.gravity, (count, 3))
    steps = []
    for link in range(dof):
        R, p = turned(chain, link, q[:, link]), chain.offset[link]
        back = np.swapaxes(R, 1, 2)
        a = np.einsum("nij,nj->ni", back, a + np.cross(alpha, p) + np.cross(omega, np.cross(omega, p)))
        omega, alpha = np.einsum("nij,nj->ni", back, omega), np.einsum("nij,nj->ni", back, alpha)
        spin = np.zeros((count, 3))
        spin[:, 2] = qd[:, link]
        alpha = alpha + np.cross(omega, spin)
        alpha[:, 2] += qdd[:, link]
        omega = omega + spin
        steps.append((R, p))
        columns = slice(PER_LINK * link, PER_LINK * (link + 1))
        W = of_link(omega, alpha, a)
        for joint in range(link, -1, -1):
            Y[:, joint, columns] = W[:, 5]
            R_joint, p_joint = steps[joint]
            W = np.concatenate([R_joint @ W[:, :3], R_joint @ W[:, 3:]], axis=1)
            W[:, 3:] += np.cross(p_joint, W[:, :3], axisb=1, axisc=1)
    return Y
