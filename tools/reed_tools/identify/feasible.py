"""Parameters that bodies can have. A body's pseudo-inertia is positive definite and linear in the ten parameters; friction is
positive. So the possible parameters are a convex set, and those nearest to an estimate, by its own covariance, are found with a
logarithmic barrier."""

import numpy as np

from reed_tools.robots.pseudo_inertia import body_of, matrix_of
from reed_tools.robots.regressor import PER_LINK

LEAST_MASS_kg, LEAST_RADIUS_m, LEAST_FRICTION = 0.02, 0.02, 1e-3  # of the start
LAST_BARRIER, FALL = 1e-6, 0.1
STEPS, DECREMENT = 60, 1e-6  # of Newton, per barrier
WIDE = 30.0        # prior deviation of what torques do not show, times the arm's size


UNIT = np.array([matrix_of(unit) for unit in np.eye(PER_LINK)])  # ∂P/∂parameter


def nearby_possible(body: np.ndarray) -> np.ndarray:
    """A start: the same body with a little mass around its centre."""
    P = matrix_of(body)
    P[3, 3] = max(P[3, 3], LEAST_MASS_kg)
    centre = P[:3, 3] / P[3, 3]
    spread, turn = np.linalg.eigh(P[:3, :3] - P[3, 3] * np.outer(centre, centre))
    P[:3, :3] = turn @ np.diag(np.maximum(spread, P[3, 3] * LEAST_RADIUS_m**2)) @ turn.T + P[3, 3] * np.outer(centre, centre)
    return body_of(P)


def barrier(x: np.ndarray, links: int) -> float:
    """−Σ log det P − Σ log friction; infinite outside."""
    eigen = np.linalg.eigvalsh([matrix_of(body) for body in x[:PER_LINK * links].reshape(-1, PER_LINK)])
    rest = x[PER_LINK * links:]
    return float(-np.log(eigen).sum() - np.log(rest).sum()) if eigen.min() > 0 and rest.min(initial=1.0) > 0 else float("inf")


def slopes(x: np.ndarray, links: int) -> tuple[np.ndarray, np.ndarray]:
    """Its gradient and Hessian."""
    gradient, hessian = np.zeros(len(x)), np.zeros((len(x), len(x)))
    rest = np.arange(PER_LINK * links, len(x))
    gradient[rest], hessian[rest, rest] = -1 / x[rest], 1 / x[rest] ** 2
    for link in range(links):
        own = slice(PER_LINK * link, PER_LINK * (link + 1))
        by = np.linalg.solve(matrix_of(x[own]), UNIT)  # P⁻¹ ∂P
        gradient[own] = -np.trace(by, axis1=1, axis2=2)
        hessian[own, own] = np.einsum("kij,lji->kl", by, by)
    return gradient, hessian


def nearest(B: np.ndarray, estimate: np.ndarray, information: np.ndarray, inertial: np.ndarray, friction: np.ndarray) -> tuple[np.ndarray, float]:
    """All parameters of possible bodies and friction, and the squared distance of B times them from the estimate, in standard
    deviations. inertial, friction: where to start, and what is kept of what the estimate does not say."""
    links = len(inertial) // PER_LINK
    x = np.concatenate([*(nearby_possible(body) for body in inertial.reshape(-1, PER_LINK)), np.maximum(friction, LEAST_FRICTION)])
    prior = np.concatenate([np.full(len(inertial), 1 / (WIDE * max(inertial[::PER_LINK].sum(), 1.0)) ** 2), np.zeros(len(friction))])
    H, g = B.T @ information @ B + np.diag(prior), B.T @ information @ estimate + prior * x
    rest = B @ x - estimate
    share = max(float(rest @ information @ rest) / len(x), LAST_BARRIER)
    while share >= LAST_BARRIER:
        x = centred(H, g, share, x, links)
        share *= FALL
    rest = B @ x - estimate
    return x, float(rest @ information @ rest)


def centred(H: np.ndarray, g: np.ndarray, share: float, x: np.ndarray, links: int) -> np.ndarray:
    """Minimum of ½ xᵀHx − gᵀx + share · barrier, by Newton's method with a line search."""
    for _ in range(STEPS):
        wall_gradient, wall_hessian = slopes(x, links)
        gradient, hessian = H @ x - g + share * wall_gradient, H + share * wall_hessian
        scale = 1 / np.sqrt(np.diag(hessian))
        step = -scale * np.linalg.solve(scale[:, None] * hessian * scale, scale * gradient)
        decrement = -gradient @ step
        if not decrement > DECREMENT * share:
            break
        size, here = 1.0, barrier(x, links)
        # The change of the square is computed from its terms: the values themselves are large.
        while not size * (gradient - share * wall_gradient) @ step + size**2 / 2 * step @ H @ step \
                + share * (barrier(x + size * step, links) - here) < -1e-4 * size * decrement:
            size /= 2
            if size < 1e-12:
                return x
        x = x + size * step
    return x
