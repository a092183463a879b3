"""The arm at the times of REED_SHAPE: as it bends, without bending, as desired, and the force on its tip. Base frame, m."""

from dataclasses import dataclass

import numpy as np

from reed_tools.record.telemetry_log import Recording
from reed_tools.robots.arm_lines import centre_line

CHANNELS = ("REED_SHAPE", "REED_CONTROL", "REED_PLANT")


@dataclass
class ArmFrames:
    """One row per message of REED_SHAPE."""

    cycle: np.ndarray
    utime: np.ndarray    # us
    bent: np.ndarray     # [n, points, 3]
    rigid: np.ndarray    # the same points without bending
    desired: np.ndarray  # [n, points of a rigid arm, 3]
    force: np.ndarray    # N, on the robot, [n, 3]


def rows_at(table: dict, cycles: np.ndarray) -> np.ndarray:
    """For each cycle the row of the newest message up to it; the first one where there is none before."""
    return np.clip(np.searchsorted(table["cycle"], cycles, side="right") - 1, 0, None)


def of(recording: Recording, arm: dict) -> ArmFrames | None:
    """None where a channel was not recorded."""
    if not all(recording.has(name) for name in CHANNELS):
        return None
    shape, control, plant = (recording.tables[name] for name in CHANNELS)
    cycle = shape["cycle"].astype(np.int64)
    return ArmFrames(cycle, shape["utime"].astype(np.int64), points(shape, ""), points(shape, "rigid_"),
                     centre_line(arm, control["theta_d"][rows_at(control, cycle)]), plant["contact_force"][rows_at(plant, cycle)])


def points(shape: dict, which: str) -> np.ndarray:
    return np.stack([shape[f"{which}{axis}"] for axis in "xyz"], axis=-1).astype(float)
