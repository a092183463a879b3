"""Figures of an experiment beside the page's pictures: windows, the three phases of the force, comparison of laws."""

from dataclasses import dataclass

import numpy as np

from reed_tools.figures import metrics
from reed_tools.figures.run_data import CONTACT_N
from reed_tools.record.signals import Signals

BAND = 0.05          # of the final desired force: inside it the force is stable
STABLE_S = 0.3       # and must stay there for at least this long


@dataclass
class Phases:
    """Fig. 9: rising until the largest force before it is stable, decreasing until it stays within 5 % of what is finally desired,
    then stable. A force that comes from below without overshoot has no decreasing phase: peak and stable coincide."""

    contact_s: float
    peak_s: float
    peak_N: float
    stable_s: float | None
    stable_rms_N: float | None


def phases(signals: Signals) -> Phases | None:
    """None when the arm never touched."""
    t, f, f_d = signals.t, signals.force_true, signals.force_desired
    touching = np.flatnonzero(f > CONTACT_N)
    if not len(touching):
        return None
    start, final = int(touching[0]), float(f_d[-1])
    outside = np.flatnonzero(np.abs(final - f) > BAND * final)
    first = max(start, int(outside[-1]) + 1 if len(outside) else 0)
    peak = start + int(np.argmax(f[start:first + 1]))
    stable = final > 0 and first < len(t) and t[-1] - t[first] >= STABLE_S
    return Phases(float(t[start]), float(t[peak]), float(f[peak]), float(t[first]) if stable else None,
                  metrics.rms((f_d - f)[first:]) if stable else None)


def joint_by_second(signals: Signals, rate_hz: float, tangential: bool) -> list[float | None]:
    """mrad rms in 0-1, 1-2, 2-3 s; None where the arm had stopped by then."""
    error = signals.tangential_joint if tangential else signals.joint_error
    return [1e3 * metrics.rms(error[rows]) if rows is not None else None for rows in seconds(signals, rate_hz)]


def force_by_second(signals: Signals, rate_hz: float) -> list[float | None]:
    """N rms of desired minus true force where one is desired."""
    errors = [metrics.force_error(signals, rows) if rows is not None else None for rows in seconds(signals, rate_hz)]
    return [None if error is None else metrics.rms(error) for error in errors]


def seconds(signals: Signals, rate_hz: float) -> list[np.ndarray | None]:
    """Rows of each second; a second that the arm did not finish counts as not reached."""
    end = float(signals.t[-1]) + 1.5 / rate_hz
    return [metrics.in_window(signals, k, k + 1.0, rate_hz) if end >= k + 1.0 else None for k in range(3)]


def times(value: float | None, best: float | None) -> str:
    """How many times worse than the law `separated`; below 1: better."""
    if value is None:
        return "stopped"
    if best is None or best <= 0.0:
        return "–"
    return f"{value / best:.3g}×"
