"""The arm as `reed_inspect --modes` describes it: at rest, bent by its weight, and in its first modes."""

import math
from pathlib import Path

import numpy as np

from reed_tools.show.drawing import STYLE, plt

SAG_DRAWN, MODE_DRAWN = 0.12, 0.15   # of the arm's size: what the largest displacement is drawn as
COLUMNS = 2                          # of modes


def round_scale(scale: float) -> float:
    """The next lower 1, 2 or 5 times a power of ten."""
    decade = 10.0 ** math.floor(math.log10(scale))
    return max(step for step in (1.0, 2.0, 5.0) if step * decade <= scale * (1 + 1e-12)) * decade


class View:
    """The same cube around all lines in every panel, so that lengths compare."""

    def __init__(self, lines: list[np.ndarray]):
        points = np.vstack(lines)
        self.low, self.high = points.min(axis=0), points.max(axis=0)
        self.size = float((self.high - self.low).max())
        middle = (self.low + self.high) / 2
        self.low, self.high = middle - 0.62 * self.size, middle + 0.62 * self.size

    def prepare(self, axis, title: str, labels: bool) -> None:
        axis.set(xlim=(self.low[0], self.high[0]), ylim=(self.low[1], self.high[1]), zlim=(self.low[2], self.high[2]))
        axis.set_box_aspect((1, 1, 1), zoom=1.0 if labels else 1.15)
        axis.view_init(elev=18, azim=-60)
        axis.set_title(title, loc="left", y=0.96)
        axis.locator_params(nbins=5)
        axis.tick_params(labelsize=7 if labels else 6, pad=0)
        if labels:
            axis.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")


def draw(shapes: dict, target: Path) -> None:
    """One picture: left the arm under its weight with its nodes, right its modes about that rest."""
    rest, bent = np.array(shapes["undeformed_m"]), np.array(shapes["deformed_m"])
    nodes, bent_nodes = np.array(shapes["nodes_m"]), np.array(shapes["nodes_deformed_m"])
    modes = [np.array(mode) for mode in shapes["mode_shapes"]]
    view = View([rest])
    rows = max(1, math.ceil(len(modes) / COLUMNS))
    with plt.rc_context(STYLE):
        figure = plt.figure(figsize=(10.0, max(4.6, 2.6 * rows + 0.6)), layout="constrained")
        grid = figure.add_gridspec(rows, 2 + COLUMNS, width_ratios=[1.2, 1.2] + [1.0] * COLUMNS)
        axis = figure.add_subplot(grid[:, :2], projection="3d")
        view.prepare(axis, f"Arm {shapes['arm']}, motors locked", labels=True)
        largest = float(np.linalg.norm(bent - rest, axis=1).max())
        scale = round_scale(SAG_DRAWN * view.size / largest) if largest > 0 else 1.0
        axis.plot(*rest.T, color="0.55", linewidth=2.5, label="undeformed")
        axis.plot(*(rest + scale * (bent - rest)).T, color="#D55E00",
                  label=f"under its weight, displacement × {scale:g}\n(largest {1e3 * largest:.3g} mm)")
        axis.plot(*nodes.T, "o", color="black", markersize=4, label="nodes: joints, ends of members, tool point")
        axis.plot(*(nodes + scale * (bent_nodes - nodes)).T, "o", color="#D55E00", markersize=4, markerfacecolor="none")
        axis.legend(loc="upper left", bbox_to_anchor=(0.0, 0.0))
        drawn = MODE_DRAWN * view.size
        for k, mode in enumerate(modes):
            panel = figure.add_subplot(grid[k // COLUMNS, 2 + k % COLUMNS], projection="3d")
            view.prepare(panel, f"mode {k + 1}: {shapes['freq_hz'][k]:.1f} Hz", labels=False)
            panel.plot(*rest.T, color="0.55", linewidth=1.5)
            panel.plot(*(rest + drawn * mode).T, color="#0072B2")
            panel.plot(*(rest - drawn * mode).T, color="#0072B2", linestyle=":")
        if modes:
            figure.text(0.99, 0.01, f"modes: axes as on the left; solid and dotted are the two extremes,\nlargest displacement drawn as {1e3 * drawn:.0f} mm",
                        fontsize=8, horizontalalignment="right")
        figure.savefig(target)
        plt.close(figure)
