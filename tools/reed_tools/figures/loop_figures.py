"""Whether the run was whole, and how its loop, records and bus fared."""

import numpy as np

from reed_tools.figures import metrics
from reed_tools.figures.run_data import NoFigure, RunData
from reed_tools.record.signals import FAULT


def faults(run: RunData):
    """number of times the controller entered fault"""
    mode = run.recording.tables["REED_CONTROL"]["mode"]
    if not len(mode):
        raise NoFigure("the controller recorded nothing")
    return int(np.sum(np.diff((mode == FAULT).astype(int), prepend=0) == 1))


def missing_s(run: RunData):
    """seconds of the scenario's duration without an active arm that both programs recorded: cut short, or records lost"""
    return (not_active(run) + unrecorded(run)) / run.rate_hz


def not_active(run: RunData) -> int:
    """Cycles by which the run was cut short; a run may end one early."""
    missing = round(run.duration_s * run.rate_hz) - run.active_cycles()
    return missing if missing > 1 else 0


def unrecorded(run: RunData) -> int:
    """Cycles of the active arm that one of the programs did not record."""
    return run.active_cycles() - run.complete_cycles()


def why_missing(run: RunData) -> str:
    parts = []
    if not_active(run):
        parts.append(f"the arm was active for {run.active_cycles() / run.rate_hz:g} of {run.duration_s:g} s")
    if lost := unrecorded(run):
        parts.append(f"{lost} cycle{'s lack' if lost > 1 else ' lacks'} a record: {records_short(run)}")
    return "; ".join(parts)


def records_short(run: RunData) -> str:
    """Whose records they are."""
    tables = run.recording.tables
    counts = {"controller": len(tables["REED_CONTROL"]["cycle"]), "plant": len(tables["REED_PLANT"]["cycle"])}
    return f"the {min(counts, key=counts.get)}'s log has fewer cycles"


def missed_cycles(run: RunData):
    """grid points that the loop slept through"""
    return run.last("REED_TIMING", "missed")


def missed_cycles_in_row(run: RunData):
    """most of them without a cycle between"""
    return metrics.longest_miss(run.recording)


def overruns(run: RunData):
    """cycles that ended after their own period"""
    return run.last("REED_TIMING", "overruns")


def heap_allocations(run: RunData):
    """calls of the malloc family on the loop's thread inside the real-time scope"""
    return run.end_of_run().heap_allocations


def page_faults(run: RunData):
    """page faults on the loop's thread inside the real-time scope"""
    return run.end_of_run().page_faults


def telemetry_dropped(run: RunData):
    """snapshots that found the telemetry ring full"""
    return run.end_of_run().telemetry_dropped


def truth_dropped(run: RunData):
    """cycles of the controller's record for which the plant recorded no truth"""
    tables = run.recording.tables
    return int(np.setdiff1d(tables["REED_CONTROL"]["cycle"], tables["REED_PLANT"]["cycle"]).size)


def frames_lost(run: RunData):
    """frames that the E2E counters prove were sent but not seen"""
    return run.bus().lost


def crc_errors(run: RunData):
    """frames with a wrong CRC"""
    return run.bus().crc_errors


FIGURES = (faults, missing_s, missed_cycles, missed_cycles_in_row, overruns, heap_allocations, page_faults, telemetry_dropped,
           truth_dropped, frames_lost, crc_errors)
