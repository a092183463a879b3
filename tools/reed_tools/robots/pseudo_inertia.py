"""A body's pseudo-inertia [[S, h], [hᵀ, m]], S = ½ tr(I) 1 − I = ∫ r rᵀ dm, from its ten parameters and back. It is positive
definite exactly if some mass distribution has it, and moves with its frame as T P Tᵀ."""

import numpy as np

from reed_tools.robots.regressor import CELLS


def matrix_of(body: np.ndarray) -> np.ndarray:
    inertia = np.zeros((3, 3))
    for value, (i, j) in zip(body[4:], CELLS):
        inertia[i, j] = inertia[j, i] = value
    P = np.zeros((4, 4))
    P[:3, :3] = 0.5 * np.trace(inertia) * np.eye(3) - inertia
    P[:3, 3] = P[3, :3] = body[1:4]
    P[3, 3] = body[0]
    return P


def body_of(P: np.ndarray) -> np.ndarray:
    inertia = np.trace(P[:3, :3]) * np.eye(3) - P[:3, :3]
    return np.array([P[3, 3], *P[:3, 3], *(inertia[cell] for cell in CELLS)])


def placed(P: np.ndarray, R: np.ndarray, p: np.ndarray) -> np.ndarray:
    """The same body seen from the frame in which its own lies at R, p."""
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, p
    return T @ P @ T.T


def possible(body: np.ndarray) -> bool:
    return bool(np.linalg.eigvalsh(matrix_of(body))[0] > 0)


def body_parts(body: np.ndarray) -> dict:
    """As an arm file writes a body."""
    P = matrix_of(body)
    centre = P[:3, 3] / P[3, 3]
    spread = P[:3, :3] - P[3, 3] * np.outer(centre, centre)
    return {"mass": float(P[3, 3]), "com": centre.tolist(), "inertia_about_com": (np.trace(spread) * np.eye(3) - spread).tolist()}
