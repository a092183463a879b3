"""The verdict's figures by name, for [[checks]] of a scenario. Every check holds when value <= limit;
a figure that could not be computed (None) fails."""

from dataclasses import dataclass

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.figures import metrics
from reed_tools.record.signals import ACTIVE, FAULT, SOURCES, Signals
from reed_tools.record.telemetry_log import Recording

IMPACT_S = 0.3           # how long after first contact an impact may last
SETTLED = 0.01           # share of its box by which an estimate may still move and counts as settled
CONTACT_N = 0.01         # true normal force that counts as contact


@dataclass
class RunData:
    recording: Recording
    signals: Signals | None
    rate_hz: float
    torque_limits: list[float]
    boxes: list[tuple[float, float]]
    sigma_limits: tuple[float, float] = (1.0, 1.0)
    duration_s: float = 0.0

    def last_second(self) -> dict:
        return metrics.figures(self.signals, metrics.last_second(self.signals, self.rate_hz))


def tangential_joint_rms_mrad_last_second(run: RunData):
    """rms of planned minus motor angle without the part along D, over joints and the last second"""
    return run.last_second()["tangential_joint_rms_mrad"]


def tangential_joint_peak_mrad_last_second(run: RunData):
    """largest of the same"""
    rows = metrics.last_second(run.signals, run.rate_hz)
    return 1e3 * metrics.peak(run.signals.tangential_joint[rows])


def joint_rms_mrad_last_second(run: RunData):
    """rms of planned minus motor angle over joints and the last second"""
    return run.last_second()["joint_rms_mrad"]


def joint_peak_mrad_last_second(run: RunData):
    """largest of the same"""
    return run.last_second()["joint_peak_mrad"]


def joint_rms_mrad(run: RunData):
    """rms of planned minus motor angle over joints and the whole run"""
    return 1e3 * metrics.rms(run.signals.joint_error)


def joint_peak_mrad(run: RunData):
    """largest of the same"""
    return 1e3 * metrics.peak(run.signals.joint_error)


def tip_rms_mm_last_second(run: RunData):
    """rms distance of the true bent tip from the planned tip over the last second"""
    return run.last_second()["tip_rms_mm"]


def tangential_tip_rms_mm_last_second(run: RunData):
    """the same within the plane of the wall"""
    return run.last_second()["tangential_tip_rms_mm"]


def tip_rms_mm(run: RunData):
    """rms distance of the true bent tip from the planned tip over the whole run"""
    return 1e3 * metrics.rms_of_norm(run.signals.tip_error)


def force_rms_N_last_second(run: RunData):
    """rms of desired minus true normal force over the last second"""
    return run.last_second()["force_rms_N"]


def force_rms_percent_last_second(run: RunData):
    """the same in percent of the largest desired force of that second"""
    rows = metrics.last_second(run.signals, run.rate_hz)
    error = metrics.force_error(run.signals, rows)
    return None if error is None else 100.0 * metrics.rms(error) / float(run.signals.force_desired[rows].max())


def force_peak_N_last_second(run: RunData):
    """largest difference of desired and true normal force in the last second"""
    return run.last_second()["force_peak_N"]


def impact_peak_N(run: RunData):
    """largest true normal force from first contact until 0.3 s after it"""
    touching = np.flatnonzero(run.signals.force_true > CONTACT_N)
    if not len(touching):
        return None
    start = run.signals.t[touching[0]]
    rows = (run.signals.t >= start) & (run.signals.t <= start + IMPACT_S)
    return float(run.signals.force_true[rows].max())


def contact_force_max_N(run: RunData):
    """largest true normal force of the run"""
    return float(run.signals.force_true.max())


def contact_force_max_percent_of_desired(run: RunData):
    """the same in percent of the largest desired force"""
    desired = float(run.signals.force_desired.max())
    return 100.0 * contact_force_max_N(run) / desired if desired > 0 else None


def contact_lost_ms(run: RunData):
    """time without contact while a force is desired, from 0.3 s after first contact on"""
    touching = np.flatnonzero(run.signals.force_true > CONTACT_N)
    if not len(touching):
        return None
    settled = run.signals.t > run.signals.t[touching[0]] + IMPACT_S
    lost = settled & (run.signals.force_desired > 0) & (run.signals.force_true <= CONTACT_N)
    return 1e3 * float(lost.sum()) / run.rate_hz


def torque_peak_percent(run: RunData):
    """largest commanded torque in percent of the joint's limit"""
    return 100.0 * float(np.max(np.abs(run.signals.torque) / np.array(run.torque_limits)))


def torque_step_at_switch_percent(run: RunData):
    """largest change of a commanded torque in the cycle in which the law in charge changed, in percent of the joint's limit"""
    switched = np.flatnonzero(np.diff(run.signals.source) != 0)
    if not len(switched):
        return 0.0
    steps = np.abs(np.diff(run.signals.torque, axis=0))[switched] / np.array(run.torque_limits)
    return 100.0 * float(steps.max())


def source_switch_cycles(run: RunData):
    """most cycles without a sound wrench frame when the law in charge changed away from the measured force"""
    source, measured = run.signals.source, run.recording.tables["REED_MEASURED"]
    known = SOURCES.index("known")
    left = run.signals.cycle[1:][(source[:-1] == known) & (source[1:] != known)]
    ages = measured["wrench_age"][np.isin(measured["cycle"], left)]
    return int(ages.max()) if len(ages) else None


def parameters_outside_box(run: RunData):
    """number of parameters whose estimate ever left its box"""
    low, high = (np.array(side) for side in zip(*run.boxes))
    tolerance = 1e-9 * (high - low)
    outside = (run.signals.p_hat < low - tolerance) | (run.signals.p_hat > high + tolerance)
    return int(outside.any(axis=0).sum())


def estimate_thirds(of: RunData) -> np.ndarray:
    """Means of every estimate over the three thirds of the run, p as a share of its box, sigma of its bound."""
    low, high = (np.array(side) for side in zip(*of.boxes))
    room = np.hstack([high - low, of.sigma_limits])
    estimates = np.hstack([of.signals.p_hat, of.signals.sigma])
    estimates = np.divide(estimates, room, out=np.zeros_like(estimates), where=room > 0.0)  # what has no room does not drift
    third = len(estimates) // 3
    return np.array([estimates[k * third:(k + 1) * third].mean(axis=0) for k in range(3)])


def estimate_drift_percent(run: RunData):
    """largest change of an estimate's mean from the middle to the last third of the run, p in percent of its box, sigma of its bound"""
    _, middle, last = estimate_thirds(run)
    return 100.0 * float(np.max(np.abs(last - middle)))


def estimate_drift_ratio(run: RunData):
    """the same change over that from the first to the middle third, where it is more than 1 %: 1 drifts steadily, less settles"""
    first, middle, last = estimate_thirds(run)
    moving = np.abs(last - middle) > SETTLED
    return float(np.max(np.abs(last - middle)[moving] / np.abs(middle - first)[moving])) if np.any(moving) else 0.0


def faults(run: RunData):
    """number of times the controller entered fault"""
    mode = run.recording.tables["REED_CONTROL"]["mode"]
    return int(np.sum(np.diff((mode == FAULT).astype(int), prepend=0) == 1))


def missing_s(run: RunData):
    """seconds of the scenario's duration that the arm was not active: a run that was cut short"""
    active = np.flatnonzero(run.recording.tables["REED_CONTROL"]["mode"] == ACTIVE)
    cycle = run.recording.tables["REED_CONTROL"]["cycle"]
    flown = int(cycle[active[-1]] - cycle[active[0]] + 1)
    missing = round(run.duration_s * run.rate_hz) - flown
    return missing / run.rate_hz if missing > 1 else 0.0


def missed_cycles(run: RunData):
    """grid points that the loop slept through"""
    return int(run.recording.tables["REED_TIMING"]["missed"][-1])


def missed_cycles_in_row(run: RunData):
    """most of them without a cycle between"""
    return metrics.longest_miss(run.recording)


def overruns(run: RunData):
    """cycles that ended after their own period"""
    return int(run.recording.tables["REED_TIMING"]["overruns"][-1])


def heap_allocations(run: RunData):
    """calls of the malloc family on the loop's thread inside the real-time scope"""
    return run.recording.finished_run.heap_allocations


def page_faults(run: RunData):
    """page faults on the loop's thread inside the real-time scope"""
    return run.recording.finished_run.page_faults


def telemetry_dropped(run: RunData):
    """snapshots that found the telemetry ring full"""
    return run.recording.finished_run.telemetry_dropped


def frames_lost(run: RunData):
    """frames that the E2E counters prove were sent but not seen"""
    return run.recording.singles["REED_BUS"][-1].lost


def crc_errors(run: RunData):
    """frames with a wrong CRC"""
    return run.recording.singles["REED_BUS"][-1].crc_errors


FIGURES = {function.__name__: function for function in (
    tangential_joint_rms_mrad_last_second, tangential_joint_peak_mrad_last_second, joint_rms_mrad_last_second,
    joint_peak_mrad_last_second, joint_rms_mrad, joint_peak_mrad, tip_rms_mm_last_second,
    tangential_tip_rms_mm_last_second, tip_rms_mm, force_rms_N_last_second, force_rms_percent_last_second,
    force_peak_N_last_second, impact_peak_N, contact_force_max_N, contact_force_max_percent_of_desired, contact_lost_ms,
    torque_peak_percent, torque_step_at_switch_percent, source_switch_cycles, parameters_outside_box,
    estimate_drift_percent, estimate_drift_ratio, faults, missing_s, missed_cycles, missed_cycles_in_row, overruns, heap_allocations, page_faults, telemetry_dropped, frames_lost, crc_errors)}

ALWAYS = ("faults", "missing_s")  # must be 0: a run that ended in a fault or early never passes, whatever the scenario asks


def require_known(entries: list[dict], where: str) -> None:
    for entry in entries:
        if entry["name"] not in FIGURES:
            raise UsageError(f"{where}: checks.name = \"{entry['name']}\" is not a figure; allowed: {', '.join(FIGURES)}")


def value_of(name: str, run: RunData):
    """None where the run did not get far enough for the figure."""
    try:
        value = FIGURES[name](run)
    except (AttributeError, IndexError, ValueError):
        return None
    return value if value is not None and np.isfinite(value) else None


def evaluate(entries: list[dict], run: RunData) -> list[dict]:
    asked = {entry["name"] for entry in entries}
    result = []
    for entry in [*entries, *({"name": name, "limit": 0} for name in ALWAYS if name not in asked)]:
        value = value_of(entry["name"], run)
        result.append({"name": entry["name"], "limit": entry["limit"], "value": value,
                       "ok": value is not None and value <= entry["limit"]})
    return result
