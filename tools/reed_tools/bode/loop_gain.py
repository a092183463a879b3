"""From torques to a loop gain. The loop is open between drive and arm: x = u + w, u the controller's torque, w the excitation, x what the
arm gets. L = -u/x there, whatever else is closed. Read off u/w it would be the closed loop's, and so would its margins."""

import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class LoopGain:
    frequency_hz: np.ndarray
    L: np.ndarray           # complex
    coherence: np.ndarray   # 1: the same in every period


@dataclass(frozen=True)
class Margins:
    gain: float | None      # the gain may grow by this factor; None: the phase never is -180 degrees in the measured band
    phase_deg: float | None # None: the gain never is 1
    delay_s: float | None
    crossover_hz: float | None


def estimate(u: np.ndarray, w: np.ndarray, rate_hz: float, frequencies_hz: list[float], periods: int) -> LoopGain:
    """u, w: [periods · n], n samples of a whole number of periods of every line."""
    n = len(u) // periods
    at = np.round(np.array(frequencies_hz) * n / rate_hz).astype(int)
    U, X = (np.fft.rfft(signal.reshape(periods, n), axis=1)[:, at] for signal in (u, u + w))
    power = np.sum(np.abs(U) ** 2, axis=0) * np.sum(np.abs(X) ** 2, axis=0)
    coherence = np.abs(np.sum(U * X.conj(), axis=0)) ** 2 / np.maximum(power, 1e-300)
    return LoopGain(np.array(frequencies_hz), -U.sum(axis=0) / X.sum(axis=0), coherence)


def margins(loop: LoopGain) -> Margins:
    """Between two lines gain and phase are straight over the logarithm of the frequency. The least of all crossings counts."""
    size, phase = np.log(np.abs(loop.L)), np.unwrap(np.angle(loop.L))
    phase -= 2 * math.pi * round((phase[0] + math.pi / 2) / (2 * math.pi))  # begins between 90 and -270 degrees
    axis = np.log(loop.frequency_hz)
    phases = [(math.pi + at_phase, math.exp(at)) for at, at_phase in crossings(axis, size, phase)]
    gains = [math.exp(-at_size) for _, at_size in crossings(axis, phase + math.pi, size) if at_size < 0]
    if not phases:
        return Margins(min(gains, default=None), None, None, None)
    least, f = min(phases, key=lambda found: abs(found[0]))
    delay = min(margin / (2 * math.pi * at) for margin, at in phases)
    return Margins(min(gains, default=None), math.degrees(least), delay, f)


def crossings(axis: np.ndarray, zero: np.ndarray, other: np.ndarray):
    """Where `zero` is 0: (axis, other)."""
    for k in np.flatnonzero(np.sign(zero[1:]) != np.sign(zero[:-1])):
        share = zero[k] / (zero[k] - zero[k + 1])
        yield axis[k] + share * (axis[k + 1] - axis[k]), other[k] + share * (other[k + 1] - other[k])
