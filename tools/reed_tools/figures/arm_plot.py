"""The arm in print: poses from the run's start to its end, from the side and from above."""

import numpy as np

from reed_tools.figures import animation
from reed_tools.record.signals import Signals
from reed_tools.record.telemetry_log import Recording
from reed_tools.robots import arm_lines
from reed_tools.show.drawing import WIDTH_IN, plt, set_margins

POSES = 5
SIDES = (("from the side", 0, 2, "x [m]", "z [m]"), ("from above", 0, 1, "x [m]", "y [m]"))


def draw(recording: Recording, signals: Signals, effective: dict):
    """None without a record of the arm's shape."""
    found = animation.frames_of(recording, signals, effective)
    if found is None:
        return None
    t, frames = found
    shown = np.unique(np.linspace(0, len(t) - 1, POSES).round().astype(int))
    figure, axes = plt.subplots(1, 2, figsize=(WIDTH_IN, 3.4))
    set_margins(figure, top_in=0.5, wspace=0.25)
    for axis, (title, across, up, x_label, y_label) in zip(axes, SIDES):
        if (wall := animation.wall_of(effective)) is not None:
            axis.fill(wall[:, across], wall[:, up], facecolor=(*rgb(arm_lines.WALL_RGB), 0.35), edgecolor=rgb(arm_lines.WALL_RGB), label="wall")
        for k in shown:
            last = k == shown[-1]
            axis.plot(frames.desired[k, :, across], frames.desired[k, :, up], color="0.6", linewidth=1.0, linestyle=":", label="desired" if last else None)
            axis.plot(frames.bent[k, :, across], frames.bent[k, :, up], color=rgb(arm_lines.ARM_RGB), linewidth=2.2 if last else 1.0,
                      alpha=1.0 if last else 0.45, label=f"arm, last at {t[k]:.2f} s" if last else None)
        axis.plot(frames.bent[:, -1, across], frames.bent[:, -1, up], color=rgb(arm_lines.TRACE_RGB), linewidth=0.9, label="path of the tip")
        axis.set(xlabel=x_label, ylabel=y_label)
        axis.set_aspect("equal", adjustable="datalim")
        axis.set_title(title, loc="left", fontsize=8)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="upper right", ncols=4)
    figure.suptitle("The arm, true shape", x=0.01, ha="left", fontsize=10)
    return figure


def rgb(colour: tuple[int, int, int]) -> tuple[float, ...]:
    return tuple(part / 255 for part in colour)
