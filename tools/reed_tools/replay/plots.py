"""Commands and estimates of a what-if beside those of the run."""

from pathlib import Path

import numpy as np

from reed_tools.record.tape import Tape
from reed_tools.record.whole_file import replacing
from reed_tools.show.drawing import COLOURS, STYLE, label_left, panels, plt, set_margins

ESTIMATES = {"adaptation.p_hat": "parameter\nestimates", "adaptation.eta_hat": "friction\nestimates", "adaptation.sigma0": "σ₀ [N·m·s/rad]",
             "adaptation.sigma1": "σ₁ [N·m]", "control.k_hat_e": "wall stiffness\nestimate [N/m]", "control.f": "normal force as\nthe law sees it [N]"}


def draw(folder: Path, recorded: Tape, replayed: Tape) -> list[Path]:
    commands = [(f"torque of\njoint {k + 1} [N·m]", "control.tau", k) for k in range(recorded.header.joints)]
    estimates = [(label, name, None) for name, label in ESTIMATES.items() if recorded.rows.dtype.fields.get(name)]
    return [picture(folder / "commands.png", commands, recorded, replayed), picture(folder / "estimates.png", estimates, recorded, replayed)]


def picture(target: Path, rows, recorded: Tape, replayed: Tape) -> Path:
    period_s = 1.0 / float(recorded.header.values["rate_hz"])
    with plt.rc_context(STYLE):
        figure, axes = panels(len(rows), 1.5 * len(rows) + 1.0)
        set_margins(figure, top_in=0.7)
        for axis, (label, name, column) in zip(axes, rows):
            for tape, colour, dash, title in ((recorded, COLOURS[0], "-", "as recorded"), (replayed, COLOURS[1], "--", "what if, open loop")):
                values = tape.rows[name] if column is None else tape.rows[name][:, column:column + 1]
                lines = axis.plot(period_s * np.arange(len(values)), values, color=colour, linestyle=dash)
                lines[0].set_label(title)
            label_left(axis, label)
        figure.legend(*axes[0].get_legend_handles_labels(), loc="upper left", ncols=2,
                      title="open loop: the measurements of the run, not those of an arm that obeys")
        axes[-1].set_xlabel("time since the first cycle [s]")
        with replacing(target) as file:
            figure.savefig(file, format="png")
        plt.close(figure)
    return target
