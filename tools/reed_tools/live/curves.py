"""Curves at about 60 samples per second: what the eye follows, at a thirtieth of the data. Peaks of timing are kept."""

from dataclasses import dataclass

import numpy as np

from reed_tools.live.batch import CLOCK, Batch

SAMPLES_hz = 60
LONGEST_s = 60.0
MISSING = np.inf  # no message of that channel came in this batch


@dataclass
class Plot:
    """One diagram: its title with unit, its curves, and dashed lines as (value, number of the curve that it limits)."""

    title: str
    names: list[str]
    limits: list[tuple[float, int]]


def plots(dof: int, effective: dict | None, parameters: list[str]) -> list[Plot]:
    joints = [f"joint {k + 1}" for k in range(dof)]
    arm = (effective or {}).get("arm", {})
    torque = [(sign * limit, k) for k, limit in enumerate(arm.get("torque_limit", [])) for sign in (1.0, -1.0)]
    period_us = [(1e6 / effective["timing"]["rate_hz"], 1)] if effective else []
    return [Plot("joint error [mrad]", joints, []), Plot("force [N]", ["desired", "measured", "true"], []),
            Plot("torque and its limits [N·m]", joints, torque), Plot("p_hat [units of the arm]", parameters, []),
            Plot("sigma_hat [N·m·s/rad, N·m]", ["sigma0", "sigma1"], []),
            Plot("time, largest of 1/60 s, and the period [µs]", ["wake-up", "whole cycle"], period_us)]


def rows(batch: Batch, rate_hz: float, parameters: int) -> np.ndarray | None:
    """[samples, 1 + all curves]: utime, then the curves of all plots in their order. None: nothing to draw."""
    if CLOCK not in batch.tables:
        return None
    control = batch.tables[CLOCK]
    at = np.flatnonzero(control["cycle"] % max(1, round(rate_hz / SAMPLES_hz)) == 0)
    if not len(at):
        return None
    cycles = control["cycle"][at]

    def other(channel: str, name: str, width: int) -> np.ndarray:
        """By cycle, the newest up to each sample."""
        found = np.full((len(cycles), width), MISSING)
        if (table := batch.tables.get(channel)) is not None:
            row = np.searchsorted(table["cycle"], cycles, side="right") - 1
            found[row >= 0] = table[name][row[row >= 0]].reshape(-1, width)
        return found

    force = np.stack([control["f_d"][at], control["f"][at]], axis=1)
    return np.hstack([control["utime"][at, None], 1e3 * control["e"][at], force, other("REED_PLANT", "normal_force", 1), control["tau"][at],
                      other("REED_ADAPTATION", "p_hat", parameters), other("REED_ADAPTATION", "sigma0", 1),
                      other("REED_ADAPTATION", "sigma1", 1), largest(batch, cycles)])


def largest(batch: Batch, cycles: np.ndarray) -> np.ndarray:
    """µs: wake-up and whole cycle, the largest since the sample before."""
    found = np.full((len(cycles), 2), MISSING)
    if (table := batch.tables.get("REED_TIMING")) is not None:
        ends = np.searchsorted(table["cycle"], cycles, side="right")
        start = 0
        for k, end in enumerate(ends):
            if end > start:
                found[k] = table["wake_ns"][start:end].max() / 1e3, table["cycle_ns"][start:end].max() / 1e3
                start = end
    return found


class History:
    """The rows of one run, the last minute of them."""

    def __init__(self, longest_s: float = LONGEST_s):
        self.longest_us = longest_s * 1e6
        self.rows: np.ndarray | None = None
        self.first_utime = None

    def add(self, more: np.ndarray | None) -> None:
        if more is None:
            return
        if self.rows is None or self.rows.shape[1] != more.shape[1]:
            self.rows, self.first_utime = np.empty((0, more.shape[1])), more[0, 0]
        before = self.rows[-1] if len(self.rows) else np.full(more.shape[1], np.nan)
        for row in more if np.isinf(more).any() else []:
            row[row == MISSING] = before[row == MISSING]
            before = row
        self.rows = np.vstack([self.rows, more])
        self.rows = self.rows[np.searchsorted(self.rows[:, 0], self.rows[-1, 0] - self.longest_us):]

    def window(self, length_s: float, until_utime: float | None = None) -> np.ndarray | None:
        """The rows of the last length_s up to a time, the first column in s since the run's start."""
        if self.rows is None:
            return None
        last = len(self.rows) if until_utime is None else int(np.searchsorted(self.rows[:, 0], until_utime, side="right"))
        end = self.rows[max(last - 1, 0), 0]
        found = self.rows[np.searchsorted(self.rows[:, 0], end - length_s * 1e6):max(last, 1)].copy()
        found[:, 0] = (found[:, 0] - self.first_utime) / 1e6
        return found
