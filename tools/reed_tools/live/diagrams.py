"""The curves' diagrams on the page."""

import numpy as np
import viser
from viser import uplot

from reed_tools.live.curves import Plot

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#999999")
HEIGHT_px = 190
MOST_POINTS = 900  # of one curve: more than the diagram has columns


class Diagrams:
    def __init__(self, server: viser.ViserServer, plots: list[Plot]):
        self.plots = plots
        self.handles = [server.gui.add_uplot(data=self.empty(plot), series=self.series(plot), title=plot.title, height=HEIGHT_px,
                                             scales={"x": uplot.Scale(time=False)}, legend=uplot.Legend(show=True)) for plot in plots]

    @staticmethod
    def empty(plot: Plot) -> tuple[np.ndarray, ...]:
        return tuple(np.array([0.0]) for _ in range(1 + len(plot.names) + len(plot.limits)))

    @staticmethod
    def series(plot: Plot) -> tuple[uplot.Series, ...]:
        curves = [uplot.Series(label=name, stroke=COLOURS[k % len(COLOURS)], width=1.5) for k, name in enumerate(plot.names)]
        limits = [uplot.Series(label=f"{limit:g}", stroke=COLOURS[k % len(COLOURS)], width=1, dash=(4, 6)) for limit, k in plot.limits]
        return (uplot.Series(label="t [s]"), *curves, *limits)

    def draw(self, rows: np.ndarray | None) -> None:
        """rows: time, then the curves of all plots one beside the other (curves.rows)."""
        if rows is None or rows.shape[1] != 1 + sum(len(plot.names) for plot in self.plots):
            return
        rows = rows[::-(-len(rows) // MOST_POINTS)]
        column = 1
        for plot, handle in zip(self.plots, self.handles):
            curves = [np.ascontiguousarray(rows[:, column + k]) for k in range(len(plot.names))]
            limits = [np.full(len(rows), limit) for limit, _ in plot.limits]
            handle.data = (np.ascontiguousarray(rows[:, 0]), *curves, *limits)
            column += len(plot.names)

    def show(self, visible: bool) -> None:
        """Never removed: a page that is slower than this program applies the updates that it has collected after the removals that
        came with them."""
        for handle in self.handles:
            handle.visible = visible
