"""The curves of several runs on common axes."""

from pathlib import Path

import numpy as np

from reed_tools.record.signals import Signals
from reed_tools.record.whole_file import replacing
from reed_tools.show.drawing import COLOURS, STYLE, label_left, panels, plt, set_margins

DASHES = ("-", "--", "-.", ":")
PANELS = {
    "tangential joint error,\nrms of joints [mrad]": lambda s: 1e3 * np.sqrt(np.mean(s.tangential_joint**2, axis=1)),
    "tip error [mm]": lambda s: 1e3 * np.linalg.norm(s.tip_error, axis=1),
    "true normal\nforce [N]": lambda s: s.force_true,
}


def draw(target: Path, runs: list[tuple[str, Signals]]) -> Path:
    shown = {label: value for label, value in PANELS.items() if "force" not in label or any(s.has_wall for _, s in runs)}
    with plt.rc_context(STYLE):
        figure, axes = panels(len(shown), 2.0 * len(shown) + 1.0)
        set_margins(figure, top_in=0.3 + 0.2 * len(runs))
        for axis, (label, value) in zip(axes, shown.items()):
            for k, (name, signals) in enumerate(runs):
                axis.plot(signals.t, value(signals), color=COLOURS[k % len(COLOURS)], linestyle=DASHES[k % len(DASHES)], label=name)
            label_left(axis, label)
        figure.legend(*axes[0].get_legend_handles_labels(), loc="upper left", ncols=1)
        axes[-1].set_xlabel("time since the arm became active [s]")
        with replacing(target) as file:
            figure.savefig(file, format="png")
        plt.close(figure)
    return target
