"""map.png: one panel per map, the margin as colour, the borders of limits and of stability as lines."""

from pathlib import Path

import numpy as np

from reed_tools.show.drawing import STYLE, plt

LIMITS_COLOUR, STABILITY_COLOUR = "black", "#D55E00"
LABELS = {"s": ("ms", 1e3), "1": ("%", 100.0), "Hz": ("Hz", 1.0)}


def draw(scenario: str, maps: list, target: Path) -> None:
    columns = min(2, len(maps))
    rows = -(-len(maps) // columns)
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(rows, columns, figsize=(5.2 * columns + 0.8, 4.2 * rows), layout="constrained", squeeze=False)
        for axis in axes.flat[len(maps):]:
            axis.set_axis_off()
        shown = None
        for axis, one in zip(axes.flat, maps):
            shown = panel(axis, one) or shown
        if shown is not None:
            figure.colorbar(shown, ax=axes, label="margin to the limits", shrink=0.8)
        figure.suptitle(f"{scenario}\nborder of the limits: black, of stability: orange\ngrey: not stable, hatched: refused at start", fontsize="medium")
        figure.savefig(target)
        plt.close(figure)


def panel(axis, one):
    axis.set_title(one.grid.name, loc="left")
    x = one.grid.axes[0]
    axis.set_xlabel(label(x))
    if len(one.grid.axes) == 1:
        axis.plot(scaled(x), one.margin, "o-", markersize=3)
        axis.axhline(0.0, color=LIMITS_COLOUR, linewidth=0.8)
        edge = np.flatnonzero(one.stable[1:] != one.stable[:-1])
        for k in edge:
            axis.axvline(np.mean(scaled(x)[k:k + 2]), color=STABILITY_COLOUR, linewidth=1.2)
        axis.set_ylabel("margin to the limits")
        return None
    y = one.grid.axes[1]
    axis.set_ylabel(label(y))
    columns, rows = range(len(x.values) + 1), range(len(y.values) + 1)  # cells of equal size, named in their middle
    shown = axis.pcolormesh(columns, rows, np.clip(one.margin.T, -1.0, 1.0), cmap="RdYlGn", vmin=-1.0, vmax=1.0)
    axis.set_facecolor("0.8")
    for i, j in zip(*np.nonzero(one.refused)):
        axis.add_patch(plt.Rectangle((i, j), 1, 1, fill=False, hatch="///", linewidth=0))
    edges(axis, one.margin >= 0, LIMITS_COLOUR, 2.4)
    edges(axis, one.stable, STABILITY_COLOUR, 1.6)
    axis.set_xticks([k + 0.5 for k in columns[:-1]], [f"{value:.4g}" for value in scaled(x)])
    axis.set_yticks([k + 0.5 for k in rows[:-1]], [f"{value:.4g}" for value in scaled(y)])
    return shown


def edges(axis, good: np.ndarray, colour: str, width: float) -> None:
    """Between a cell that is good and its neighbour that is not."""
    for i, j in zip(*np.nonzero(good[1:, :] != good[:-1, :])):
        axis.plot([i + 1, i + 1], [j, j + 1], color=colour, linewidth=width)
    for i, j in zip(*np.nonzero(good[:, 1:] != good[:, :-1])):
        axis.plot([i, i + 1], [j + 1, j + 1], color=colour, linewidth=width)


def scaled(axis) -> np.ndarray:
    return np.array(axis.values) * LABELS.get(axis.unit, ("", 1.0))[1]


def label(axis) -> str:
    unit = LABELS.get(axis.unit, (axis.unit, 1.0))[0]
    return axis.key + (f" [{unit}]" if unit else "")
