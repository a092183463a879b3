"""The table of a map: along each axis up to where the arm is within its limits, up to where it is stable, and what breaks first."""

import numpy as np

from reed_tools.map.grid import Axis
from reed_tools.map.measured import Mapped
from reed_tools.show import tables


def border(values: tuple[float, ...], good: np.ndarray) -> tuple[float | None, float | None]:
    """(last value up to which all are good, first that is not): the border is between them."""
    bad = np.flatnonzero(~good)
    first = int(bad[0]) if len(bad) else len(values)
    return values[first - 1] if first else None, values[first] if first < len(values) else None


def show(scenario: str, maps: list[Mapped]) -> None:
    table = tables.grid(scenario, "map", "along", "within its limits", "stable", "first broken", numbers=False)
    for one in maps:
        for row in rows(one):
            table.add_row(*row)
    tables.console().print(table)


def rows(one: Mapped) -> list[tuple[str, ...]]:
    """One for each axis, the other at its first value."""
    found = []
    for k, axis in enumerate(one.grid.axes):
        along = tuple(slice(None) if j == k else 0 for j in range(len(one.grid.axes)))
        within = one.margin[along] >= 0
        broken = np.flatnonzero(~within)
        found.append((one.grid.name, axis.key, span(axis, *border(axis.values, within)), span(axis, *border(axis.values, one.stable[along])),
                      one.said[along][broken[0]] if len(broken) else "–"))
    return found


def span(axis: Axis, last: float | None, first: float | None) -> str:
    unit = "" if axis.unit == "1" else f" {axis.unit}"
    if last is None:
        return f"not even at {first:g}{unit}"
    return f"up to {last:g}{unit}" + (f", not at {first:g}" if first is not None else ", the largest value")
