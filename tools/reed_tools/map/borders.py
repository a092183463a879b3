"""The table of a map: along each axis up to where the arm is within its limits, up to where it is stable, and what breaks first."""

import numpy as np

from reed_tools.map.grid import Axis
from reed_tools.map.measured import Mapped
from reed_tools.show import tables


def border(good: np.ndarray) -> tuple[int, int] | None:
    """(first, last) of the values that are good in a row from the first good one on; None: none is."""
    found = np.flatnonzero(good)
    if not len(found):
        return None
    bad = np.flatnonzero(~good[found[0]:])
    return int(found[0]), int(found[0] + bad[0] - 1) if len(bad) else len(good) - 1


def show(scenario: str, maps: list[Mapped]) -> None:
    table = tables.grid(scenario, "map", "along", "within its limits", "stable", "first broken", numbers=False)
    for one in maps:
        for k in range(len(one.grid.axes)):
            table.add_row(*row(one, k))
    tables.console().print(table)


def row(one: Mapped, k: int) -> tuple[str, ...]:
    """Along axis k, the other at its first value with which the arm is within its limits anywhere."""
    axis, others = one.grid.axes[k], [other for j, other in enumerate(one.grid.axes) if j != k]
    margin, stable, said = (np.moveaxis(array, k, 0).reshape(len(axis.values), -1) for array in (one.margin, one.stable, one.said))
    place = int(np.argmax((margin >= 0).any(axis=0)))
    within = margin[:, place] >= 0
    span = border(within)
    last = span[1] if span else -1
    held = "".join(f", {other.key} = {other.values[place]:g}" for other in others) if place else ""
    why = str(said[last + 1, place]) if last + 1 < len(axis.values) else "–"
    return one.grid.name, axis.key + held, words(axis, span), words(axis, border(stable[:, place])), why


def words(axis: Axis, span: tuple[int, int] | None) -> str:
    if span is None:
        return "nowhere"
    (first, last), unit = span, "" if axis.unit == "1" else f" {axis.unit}"
    beyond = f", not at {axis.values[last + 1]:g}" if last + 1 < len(axis.values) else ", the largest value"
    lower = f"from {axis.values[first]:g} " if first else ""
    return f"{lower}up to {axis.values[last]:g}{unit}{beyond}"
