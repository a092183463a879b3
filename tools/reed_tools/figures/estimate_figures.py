"""What the controller learns: whether its estimates stay in their boxes and come to rest."""

import numpy as np

from reed_tools.figures.run_data import NoFigure, RunData

RESTING = 0.01           # share of its box by which an estimate may still move and counts as being at rest


def parameters_outside_box(run: RunData):
    """number of parameters whose estimate ever left its box"""
    low, high = (np.array(side) for side in zip(*run.boxes))
    tolerance = 1e-9 * (high - low)
    outside = (run.signals.p_hat < low - tolerance) | (run.signals.p_hat > high + tolerance)
    return int(outside.any(axis=0).sum())


def in_rooms(values: np.ndarray, rooms: np.ndarray) -> np.ndarray:
    """Each column as a share of its room; one without room stays where it is."""
    return np.divide(values, rooms, out=np.zeros_like(values), where=rooms > 0.0)


def estimate_thirds(of: RunData) -> np.ndarray:
    """Means of every estimate over the three thirds of the run, p as a share of its box, sigma of its bound."""
    low, high = (np.array(side) for side in zip(*of.boxes))
    estimates = np.hstack([in_rooms(of.signals.p_hat, high - low), in_rooms(of.signals.sigma, np.array(of.sigma_limits))])
    third = len(estimates) // 3
    if third == 0:
        raise NoFigure("fewer than three cycles of an active arm were recorded")
    return np.array([estimates[k * third:(k + 1) * third].mean(axis=0) for k in range(3)])


def estimate_drift_percent(run: RunData):
    """largest change of an estimate's mean from the middle to the last third of the run, p in percent of its box, sigma of its bound"""
    _, middle, last = estimate_thirds(run)
    return 100.0 * float(np.max(np.abs(last - middle)))


def estimate_drift_ratio(run: RunData):
    """the same change over that from the first to the middle third, where it is more than 1 %: 1 drifts steadily, less converges"""
    first, middle, last = estimate_thirds(run)
    moving = np.abs(last - middle) > RESTING
    if not np.any(moving):
        return 0.0
    before = np.abs(middle - first)[moving]
    if np.any(before == 0.0):
        raise NoFigure("an estimate began to move in the last third of the run")
    return float(np.max(np.abs(last - middle)[moving] / before))


FIGURES = (parameters_outside_box, estimate_drift_percent, estimate_drift_ratio)
