"""The uncertain parameters p of an arm file, and Coulomb friction, from the base parameters and their covariance."""

from dataclasses import dataclass

import numpy as np

from reed_tools.identify.base import Base
from reed_tools.identify.least_squares import Fit
from reed_tools.robots.nominal import NominalArm


@dataclass(frozen=True)
class Structural:
    p: np.ndarray
    sigma: np.ndarray
    coulomb: np.ndarray  # N·m


def structural(arm: NominalArm, base: Base, fit: Fit) -> Structural:
    """Least squares within the box of p. What the runs say nothing about stays at its nominal value; viscous friction that p
    does not carry is free."""
    dof, count = arm.dof, len(arm.p)
    S = np.vstack([arm.shapes, arm.viscous, np.zeros((dof, count))])
    free = np.vstack([np.zeros((len(arm.known), 2 * dof)), np.eye(2 * dof)])
    carried = np.flatnonzero(arm.viscous.any(axis=1))
    free = np.delete(free, carried, axis=1)
    A = base.B @ np.hstack([S, free])
    b = fit.estimate - base.B @ np.concatenate([arm.known, np.zeros(2 * dof)])
    prior = np.zeros(A.shape[1])
    prior[:count] = 1 / np.maximum(arm.p_hi - arm.p_lo, 1e-9) ** 2
    centre = np.concatenate([arm.p, np.zeros(A.shape[1] - count)])
    H = A.T @ fit.information @ A + np.diag(prior)
    g = A.T @ fit.information @ b + prior * centre
    low = np.concatenate([arm.p_lo, np.zeros(A.shape[1] - count)])
    high = np.concatenate([arm.p_hi, np.full(A.shape[1] - count, np.inf)])
    x = within(H, g, low, high)
    return Structural(x[:count], np.sqrt(np.diag(np.linalg.inv(H)))[:count], x[-dof:])


def within(H: np.ndarray, g: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Minimum of ½ xᵀHx − gᵀx in a box, coordinate by coordinate: H is positive definite, so it is the only one."""
    x = np.clip(np.linalg.solve(H, g), low, high)
    for _ in range(10000):
        before = x.copy()
        for k in range(len(x)):
            x[k] = np.clip(x[k] + (g[k] - H[k] @ x) / H[k, k], low[k], high[k])
        if np.max(np.abs(x - before) * np.sqrt(np.diag(H))) < 1e-9:
            break
    return x
