"""What an identification reads of a run: motor angles and drive torques on an even grid, of an arm that moves freely.
Never the plant's truth: a run folder's own half of the configuration is the controller's."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.record import run_folder
from reed_tools.record.signals import ACTIVE
from reed_tools.record.telemetry_log import Recording, load
from reed_tools.robots import nominal

FREE_N = 1.0      # a larger normal force is contact
LONGEST_HOLE = 3  # cycles without a measurement that are bridged
ENABLED = "Enabled"  # drive_state of the DBC
CONTROLLER_HALF = "controller.toml"


@dataclass
class Stretch:
    """Cycles in a row. A joint frame's torque is the one that the drive applied until then: half a period older than the angle."""

    period_s: float
    angle: np.ndarray   # rad, motor side, [n, dof]
    torque: np.ndarray  # N·m, at the same instants, [n, dof]


def stretches(cycle: np.ndarray, angle: np.ndarray, torque: np.ndarray, period_s: float) -> list[Stretch]:
    """Cut where more than a few cycles are missing; fewer are bridged by straight lines."""
    found = []
    for part in np.split(np.arange(len(cycle)), np.flatnonzero(np.diff(cycle) > LONGEST_HOLE + 1) + 1):
        if len(part) < 2:
            continue
        grid = np.arange(cycle[part[0]], cycle[part[-1]] + 1)
        even = [np.stack([np.interp(grid, cycle[part], values[part, joint]) for joint in range(values.shape[1])], axis=1)
                for values in (angle, torque)]
        found.append(Stretch(period_s, even[0][:-1], (even[1][:-1] + even[1][1:]) / 2))
    return found


def of_run(folder: Path) -> list[Stretch]:
    run_folder.require_unchanged(folder)
    return of_recording(load(*run_folder.logs(folder)), table_of(folder, "timing")["rate_hz"], bool(table_of(folder, "wall").get("present")))


def of_recording(recording: Recording, rate_hz: float, has_wall: bool) -> list[Stretch]:
    measured, control = recording.tables["REED_MEASURED"], recording.tables["REED_CONTROL"]
    free = control["mode"] == ACTIVE
    if has_wall:
        free &= (control["f_d"] == 0) & (np.abs(control["f"]) < FREE_N)
    rows = np.isin(measured["cycle"], control["cycle"][free]) & (measured["age"] == 0).all(axis=1)
    return stretches(measured["cycle"][rows], measured["position"][rows], measured["torque"][rows], 1 / rate_hz)


def table_of(folder: Path, section: str) -> dict:
    path = next((folder / name for name in (CONTROLLER_HALF, run_folder.CONFIGURATION) if (folder / name).is_file()), None)
    if path is None:
        raise UsageError(f"{folder}: is no run folder, it has no {run_folder.CONFIGURATION}")
    return nominal.read(path)[section]


def arm_of_run(folder: Path) -> dict:
    """The [arm] table as the controller knows it."""
    return table_of(folder, "arm")


def following(last: int, now: int) -> int:
    """The number that a SYNC's 32 bits stand for: the nearest one to the last, so that it goes on where the bits start over."""
    return last + (now - last + 2**31) % 2**32 - 2**31


def of_candump(path: Path, dof: int) -> list[Stretch]:
    """From frames alone: a cycle is what follows a SYNC, its time step the one that most SYNCs keep."""
    from reed_tools.export import decode  # python-can and cantools: not before they are needed

    cycle, times, rows, now = [], [], [], None
    for frame in decode.recorded(str(path)):
        said = decode.decode(frame)
        if not said["crc"]:
            continue
        if said["message"] == "SYNC":
            now = said["signals"]["cycle"]
            cycle.append(following(cycle[-1], now) if cycle else now)
            times.append(said["t_s"])
            rows.append({})
        elif now is not None and said["message"].startswith("JOINT_STATE_") and said["signals"]["cycle_low4"] == now % 16:
            rows[-1][int(said["message"][-1]) - 1] = said["signals"]
    whole = [number for number, row in enumerate(rows)
             if set(row) == set(range(dof)) and all(joint["drive_state"] == ENABLED for joint in row.values())]
    joints = {len(row) for row in rows}
    if rows and max(joints) != dof:
        raise UsageError(f"{path}: {max(joints)} joints answer on this bus, the arm has {dof}")
    if len(whole) < 2:
        raise UsageError(f"{path}: no cycle in which all {dof} joints are enabled")
    pick = lambda name: np.array([[rows[number][joint][name] for joint in range(dof)] for number in whole])
    period_s = float(np.median(np.diff(times) / np.diff(cycle)))
    return stretches(np.array(cycle)[whole], pick("position"), pick("torque"), period_s)
