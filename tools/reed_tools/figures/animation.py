"""What the page's moving arm is made from: the arm's frames since it became active, thinned to what a page can carry."""

import numpy as np

from reed_tools.figures import metrics
from reed_tools.record.signals import Signals
from reed_tools.record.telemetry_log import Recording
from reed_tools.robots import arm_frames, arm_lines, joint_frames
from reed_tools.show.interactive import floats

MOST_FRAMES = 900


def frames_of(recording: Recording, signals: Signals | None, effective: dict) -> tuple[np.ndarray, arm_frames.ArmFrames] | None:
    """(t in s since the arm became active, frames); None without a record of the arm's shape."""
    arm = effective["arm"]
    if signals is None or signals.dof != joint_frames.dof(arm) or (frames := arm_frames.of(recording, arm)) is None:
        return None
    kept = np.flatnonzero((frames.cycle >= signals.cycle[0]) & (frames.cycle <= signals.cycle[-1]))
    kept = kept[::1 + len(kept) // MOST_FRAMES]
    if not len(kept):
        return None
    t = (frames.cycle[kept] - metrics.zero_cycle(recording)) / effective["timing"]["rate_hz"]
    return t, arm_frames.ArmFrames(*(getattr(frames, name)[kept] for name in ("cycle", "utime", "bent", "rigid", "desired", "force")))


def wall_of(effective: dict) -> np.ndarray | None:
    plate = arm_lines.wall_plate(effective) if "wall" in effective else None
    return None if plate is None else arm_lines.corners(plate)


def data(recording: Recording, signals: Signals | None, effective: dict) -> dict | None:
    """For show/page/arm.js."""
    found = frames_of(recording, signals, effective)
    if found is None:
        return None
    t, frames = found
    wall = wall_of(effective)
    return {"t": floats(t), "rigid": floats(frames.rigid), "bend": floats(frames.bent - frames.rigid), "desired": floats(frames.desired),
            "force": floats(frames.force), "wall": None if wall is None else wall.round(6).tolist(),
            "force_mPN": arm_lines.FORCE_mPN, "least_force_N": arm_lines.LEAST_FORCE_N,
            "rgb": {"arm": arm_lines.ARM_RGB, "desired": arm_lines.GHOST_RGB, "wall": arm_lines.WALL_RGB, "force": arm_lines.FORCE_RGB,
                    "trace": arm_lines.TRACE_RGB}}
