"""The runs of a grid, and what is known after them: margin and stability of each point."""

import functools
import itertools
import math
from dataclasses import dataclass

import numpy as np

from reed_tools.campaign.definition import LIMITS, Campaign, Drawn
from reed_tools.engine import options as engine_options
from reed_tools.engine import progress
from reed_tools.engine.engine import Engine
from reed_tools.errors import RunError, UsageError
from reed_tools.map.grid import Grid
from reed_tools.run import in_memory
from reed_tools.worst import judged

RIPPLE = "torque_ripple_percent_last_second"
RIPPLE_GROWS, RIPPLE_FLOOR_PERCENT = 3.0, 3.0  # beyond both times the nominal run's and this: the loop swings


@dataclass(frozen=True)
class Mapped:
    """One grid after its runs. `margin`: 1 minus the ratio of the worst figure to its limit; NaN where the arm is not stable or a
    limit of 0 is broken."""

    grid: Grid
    margin: np.ndarray
    stable: np.ndarray
    refused: np.ndarray  # the configuration itself
    said: np.ndarray     # what decides

    def as_json(self) -> dict:
        number = np.vectorize(lambda value: None if np.isnan(value) else float(value), otypes=[object])
        return {"name": self.grid.name, "axes": [{"key": axis.key, "unit": axis.unit, "values": list(axis.values)} for axis in self.grid.axes],
                "margin": number(self.margin).tolist(), "stable": self.stable.tolist(), "refused": self.refused.tolist(), "deciding": self.said.tolist()}


class PointTally(progress.Tally):
    def __init__(self, total: int):
        super().__init__(total)
        self.stable = 0

    def add(self, result: judged.Judged) -> None:
        super().add(result)
        self.stable += result.record.stable

    def text(self) -> str:
        return f"{self.stable} stable"


def campaign(scenario: str, keys: list[str], stable: list[dict], fixed: list[str]) -> Campaign:
    """Of the engine's kind: what varies is named, so that figures read it."""
    return Campaign("map", "", scenario, 1, 1, LIMITS, stable, tuple(fixed), tuple(Drawn(key, "uniform", [0.0, 1.0]) for key in keys), "")


def one_run(scenario: str, entries: list[str]) -> judged.Judged:
    keys = [entry.partition("=")[0] for entry in entries]
    return judged.run(campaign(scenario, keys, [{"name": RIPPLE, "limit": math.inf}], []), in_memory.build(), (0, entries), [])


def refuse_bad_key(scenario: str, fixed: list[str], one: Grid) -> None:
    """One that nobody knows, or whose first value no arm would start with."""
    first = one_run(scenario, [*fixed, *one.entries((0,) * len(one.axes))])
    if first.record.status == judged.REFUSED:
        raise UsageError(first.record.message)


def nominal_run(scenario: str, fixed: list[str]) -> judged.Judged:
    """Without anything on its way. What is wrong with the scenario is said here."""
    found = one_run(scenario, fixed)
    if found.record.status == judged.REFUSED:
        raise UsageError(found.record.message)
    if found.record.status != "finished":
        raise UsageError(f"{scenario} ends in a fault by itself: {found.record.message}")
    return found


def measure(arguments, grids: list[Grid], fixed: list[str], nominal: judged.Judged) -> list[Mapped]:
    still = next(check["value"] for check in nominal.record.stability if check["name"] == RIPPLE)
    stable = [{"name": RIPPLE, "limit": max(RIPPLE_GROWS * (still or 0.0), RIPPLE_FLOOR_PERCENT)}]
    todo = [((number, place), [*fixed, *one.entries(place)]) for number, one in enumerate(grids) for place in np.ndindex(one.shape)]
    print(f"map of {arguments.scenario}: {len(todo)} runs, {engine_options.place(arguments)}", flush=True)
    campaigns = [campaign(arguments.scenario, [*(axis.key for axis in one.axes), *(entry.partition("=")[0] for entry in one.fixed)], stable, fixed)
                 for one in grids]
    found = {}
    with (Engine(min(engine_options.jobs(arguments), len(todo)), arguments.scheduler) as engine,
          progress.shown("map", PointTally(len(todo))) as on_result):
        for item, result in engine.map(functools.partial(point, campaigns, in_memory.build()), todo):
            if result.record.status == "died":
                raise RunError(f"a program died: {result.record.message}; {result.line(arguments.scenario)}")
            found[item[0]] = result
            on_result(result)
        if engine.interrupted:
            raise KeyboardInterrupt
    return [mapped(number, one, found) for number, one in enumerate(grids)]


def point(campaigns: list[Campaign], build: str, item, interrupted: list):
    """In a worker."""
    (number, _), entries = item
    return judged.run(campaigns[number], build, (0, entries), interrupted)


def mapped(number: int, one: Grid, found: dict) -> Mapped:
    margin, stable = np.full(one.shape, np.nan), np.zeros(one.shape, dtype=bool)
    refused, said = np.zeros(one.shape, dtype=bool), np.empty(one.shape, dtype=object)
    for place in itertools.product(*map(range, one.shape)):
        result = found[number, place]
        refused[place], stable[place] = result.record.status == judged.REFUSED, result.record.stable
        said[place] = result.text()
        if np.isfinite(result.ratio):
            margin[place] = 1.0 - result.ratio
    return Mapped(one, margin, stable, refused, said)
