"""How every picture looks: colours, type, margins. Drawn to files only: no window, no display.

Nothing else imports Matplotlib: here it starts with our own matplotlibrc, backend and cache folder, whatever the caller's
environment, home and current folder hold."""

import atexit
import os
import shutil
import tempfile
from pathlib import Path

from reed_tools.paths import ROOT

os.environ["MPLBACKEND"] = "Agg"


def cache_folder() -> str:
    """Of the list of fonts, kept from one start to the next; elsewhere where this checkout cannot be written."""
    kept = ROOT / "build" / "matplotlib"
    try:
        kept.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=kept).close()
        return str(kept)
    except OSError:
        folder = tempfile.mkdtemp(prefix="reed-matplotlib-")
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
        return folder


os.environ["MPLCONFIGDIR"] = cache_folder()
came_from = os.open(".", os.O_PATH)
os.chdir(Path(__file__).parent)  # a matplotlibrc in the current folder comes before every other
try:
    import matplotlib
    import matplotlib.pyplot as plt
    from matplotlib import ticker  # noqa: F401
finally:
    os.fchdir(came_from)
    os.close(came_from)

# Okabe-Ito: distinguishable in print and by every reader; line styles repeat the distinction.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#999999")
STYLE = {"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False, "axes.spines.right": False,
         "lines.linewidth": 1.1, "legend.frameon": False, "legend.fontsize": 8, "figure.dpi": 110, "savefig.dpi": 160,
         "axes.prop_cycle": matplotlib.cycler(color=COLOURS)}
WIDTH_IN = 7.4
LABEL_IN = 0.29   # right edge of the axes' labels


def panels(count: int, height_in: float):
    figure, axes = plt.subplots(count, 1, sharex=True, figsize=(WIDTH_IN, height_in), squeeze=False)
    set_margins(figure)
    return figure, axes[:, 0]


def set_margins(figure, right_in: float = 0.15, top_in: float = 0.3, **spaces) -> None:
    """Fixed margins: the same axes in every picture, and no search for a layout."""
    width, height = figure.get_size_inches()
    figure.subplots_adjust(left=0.72 / width, right=1 - right_in / width, bottom=0.48 / height, top=1 - top_in / height,
                           **{"hspace": 0.14, **spaces})


def legend_right(figure, *axes) -> None:
    set_margins(figure, right_in=1.35)
    for axis in axes:
        axis.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def label_left(axis, text: str) -> None:
    """At the same place in every panel and picture, however long the numbers beside it are."""
    axis.set_ylabel(text)
    across = matplotlib.transforms.blended_transform_factory(axis.figure.transFigure, axis.transAxes)
    axis.yaxis.set_label_coords(LABEL_IN / axis.figure.get_size_inches()[0], 0.5, transform=across)


BIN_S = 0.01


def plot_with_band(axis, t, values, color, label=None) -> None:
    """A signal that chatters: its mean over 10 ms as a line, its range as a shade, so that no curve hides the others."""
    if len(t) < 2:
        return
    rows = max(1, round(BIN_S / max(float(t[1] - t[0]), 1e-9)))
    count = len(t) // rows
    blocks, times = values[:count * rows].reshape(count, rows), t[:count * rows].reshape(count, rows).mean(axis=1)
    axis.fill_between(times, blocks.min(axis=1), blocks.max(axis=1), color=color, alpha=0.22, linewidth=0)
    axis.plot(times, blocks.mean(axis=1), color=color, linewidth=0.9, label=label)
