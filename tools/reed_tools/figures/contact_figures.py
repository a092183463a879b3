"""How the arm presses, what torque it takes, and how one law hands over to another."""

import numpy as np

from reed_tools.figures import metrics
from reed_tools.figures.run_data import CONTACT_N, NoFigure, RunData
from reed_tools.record.signals import SOURCES

IMPACT_S = 0.3           # how long after first contact an impact may last
RIPPLE_HZ = 25.0         # what is faster is no motion that was asked for


def force_error_last_second(run: RunData) -> np.ndarray:
    error = metrics.force_error(run.signals, run.last_second())
    if error is None:
        if not run.signals.has_wall:
            raise NoFigure("there is no wall")
        run.first_contact()  # a force is desired from contact on
        raise NoFigure("no force was desired in the last second")
    return error


def largest_desired(run: RunData, rows=slice(None)) -> float:
    desired = float(run.signals.force_desired[rows].max())
    if desired <= 0.0:
        raise NoFigure("no force was desired")
    return desired


def force_rms_N_last_second(run: RunData):
    """rms of desired minus true normal force over the last second"""
    return metrics.rms(force_error_last_second(run))


def force_rms_percent_last_second(run: RunData):
    """the same in percent of the largest desired force of that second"""
    return 100.0 * metrics.rms(force_error_last_second(run)) / largest_desired(run, run.last_second())


def force_peak_N_last_second(run: RunData):
    """largest difference of desired and true normal force in the last second"""
    return metrics.peak(force_error_last_second(run))


def impact_peak_N(run: RunData):
    """largest true normal force from first contact until 0.3 s after it"""
    start = run.signals.t[run.first_contact()]
    rows = (run.signals.t >= start) & (run.signals.t <= start + IMPACT_S)
    return float(run.signals.force_true[rows].max())


def contact_force_max_N(run: RunData):
    """largest true normal force of the run"""
    return float(run.signals.force_true.max())


def contact_force_max_percent_of_desired(run: RunData):
    """the same in percent of the largest desired force"""
    return 100.0 * contact_force_max_N(run) / largest_desired(run)


def contact_lost_ms(run: RunData):
    """time without contact while a force is desired, from 0.3 s after first contact on"""
    settled = run.signals.t > run.signals.t[run.first_contact()] + IMPACT_S
    lost = settled & (run.signals.force_desired > 0) & (run.signals.force_true <= CONTACT_N)
    return 1e3 * float(lost.sum()) / run.rate_hz


def torque_peak_percent(run: RunData):
    """largest commanded torque in percent of the joint's limit"""
    return 100.0 * float(np.max(np.abs(run.signals.torque) / np.array(run.torque_limits)))


def torque_ripple_percent_last_second(run: RunData):
    """rms of the commanded torque's part above 25 Hz over the last second, of the joint where it is largest, in percent of its limit"""
    torque = run.signals.torque[run.last_second()]
    width = max(3, round(run.rate_hz / RIPPLE_HZ))
    if len(torque) <= width:
        raise NoFigure("the run is too short for a ripple")
    slow = np.stack([np.convolve(joint, np.full(width, 1.0 / width), mode="valid") for joint in torque.T], axis=1)
    fast = torque[width // 2:width // 2 + len(slow)] - slow
    return 100.0 * float(np.max(np.sqrt(np.mean(fast ** 2, axis=0)) / np.array(run.torque_limits)))


def torque_step_at_switch_percent(run: RunData):
    """largest change of a commanded torque in the cycle in which the active law changed, in percent of the joint's limit"""
    switched = np.flatnonzero(np.diff(run.signals.source) != 0)
    if not len(switched):
        return 0.0
    steps = np.abs(np.diff(run.signals.torque, axis=0))[switched] / np.array(run.torque_limits)
    return 100.0 * float(steps.max())


def source_switch_cycles(run: RunData):
    """most cycles without a valid wrench frame when the active law changed away from the measured force"""
    source, measured = run.signals.source, run.recording.tables["REED_MEASURED"]
    known = SOURCES.index("known")
    left = run.signals.cycle[1:][(source[:-1] == known) & (source[1:] != known)]
    ages = measured["wrench_age"][np.isin(measured["cycle"], left)]
    if not len(ages):
        raise NoFigure("the active law never changed away from the measured force")
    return int(ages.max())


FIGURES = (force_rms_N_last_second, force_rms_percent_last_second, force_peak_N_last_second, impact_peak_N, contact_force_max_N,
           contact_force_max_percent_of_desired, contact_lost_ms, torque_peak_percent, torque_ripple_percent_last_second,
           torque_step_at_switch_percent, source_switch_cycles)
