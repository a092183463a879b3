"""Recorded signals as a picture."""

from pathlib import Path
from typing import TYPE_CHECKING

from reed_tools.notebook.recorded import Run

if TYPE_CHECKING:
    from reed_tools.show.drawing import plt

PANEL_IN, REST_IN = 1.7, 0.9


def plot(runs: Run | list[Run], *names: str, file: str | Path | None = None) -> "plt.Figure":
    """A panel per name over a common time, the runs on common axes (the first solid); written to `file` where one is given."""
    from reed_tools.show.drawing import COLOURS, STYLE, label_left, legend_right, panels, plt  # matplotlib

    shown = runs if isinstance(runs, list) else [runs]
    with plt.rc_context(STYLE):
        figure, axes = panels(len(names), PANEL_IN * len(names) + REST_IN)
        for axis, name in zip(axes, names):
            for run, dash in zip(shown, ("-", "--", "-.", ":")):
                for k, column in enumerate(run.columns(name)):
                    whose = f" {run.folder.name}" if len(shown) > 1 else ""
                    axis.plot(run.time(name), run[column], color=COLOURS[k % len(COLOURS)], linestyle=dash, label=f"{column.rpartition('.')[2]}{whose}")
            label_left(axis, f"{name} [{shown[0].unit(name) or '1'}]")
        legend_right(figure, *axes)
        axes[-1].set_xlabel("time since the arm became active [s]")
        if file is not None:
            figure.savefig(file)
    return figure
