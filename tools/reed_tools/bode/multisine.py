"""The excitation that the plant adds to a joint's torque (plant_sim/drive/torque_excitation.h), the same sum here."""

import math

import numpy as np

BASE_HZ = 1.0          # every line is a multiple: one second holds whole periods of all
LOWEST_HZ, HIGHEST_SHARE = 1.0, 0.4   # of the rate
LINES = 40
CREST = 1.8            # largest value over rms of such a sum, about


def frequencies(rate_hz: float) -> list[float]:
    """Odd multiples of BASE_HZ, about evenly spaced on a logarithmic axis: what friction and saturation make of a line falls on even
    ones first."""
    wanted = np.geomspace(LOWEST_HZ, HIGHEST_SHARE * rate_hz, LINES)
    return [BASE_HZ * odd for odd in sorted({2 * round((f / BASE_HZ - 1) / 2) + 1 for f in wanted})]


def sum_at(t_s: np.ndarray, amplitude: float, frequencies_hz: list[float]) -> np.ndarray:
    K = len(frequencies_hz)
    return amplitude * sum(np.cos(2 * math.pi * f * t_s - math.pi * k * (k - 1) / K) for k, f in enumerate(frequencies_hz, 1))


def amplitude_of(peak: float, lines: int) -> float:
    return peak / (CREST * math.sqrt(lines / 2))
