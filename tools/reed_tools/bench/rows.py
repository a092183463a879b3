"""One comparison of tools/reed bench, and how it is shown: ratio and aim first."""

import math
from dataclasses import dataclass, field

from rich.text import Text

from reed_tools.show.tables import console, grid, mark


@dataclass
class Row:
    what: str
    ours: float
    theirs: float | None   # the other side's figure; None: nothing is compared
    unit: str
    aim: float | None = None    # of the ratio, or of the figure itself where nothing is compared
    other: str = ""             # who the other side is
    less_is_better: bool = True

    @property
    def ratio(self) -> float | None:
        if self.theirs is None:
            return None
        if self.theirs == 0:
            return 1.0 if self.ours == 0 else math.inf
        return self.ours / self.theirs

    @property
    def ok(self) -> bool | None:
        """None: there is no aim, or the other side is missing although the aim is a ratio."""
        figure = self.ratio if self.other else self.ours
        if self.aim is None or figure is None:
            return None
        return figure <= self.aim if self.less_is_better else figure >= self.aim

    def as_json(self) -> dict:
        return {"what": self.what, "ratio": self.ratio if self.ratio != math.inf else None, "aim": self.aim, "ok": self.ok,
                "reed": self.ours, "other": self.other or None, "other_side": self.theirs, "unit": self.unit}


@dataclass
class Found:
    """What one measurement brought."""

    rows: list[Row] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    details: dict = field(default_factory=dict)   # for bench.json and the plot

    def add(self, other: "Found") -> None:
        self.rows += other.rows
        self.notes += other.notes
        self.details |= other.details


def figure(value: float | None) -> str:
    if value is None:
        return "–"
    return f"{value:.0f}" if abs(value) >= 1000 or value == int(value) else f"{value:.3g}"


def show(rows: list[Row]) -> None:
    table = grid("side by side", "ratio", "aim", "", "what", "Reed", "other side")
    table.columns[3].justify = "left"
    for column in (0, 1, 2, 4, 5):
        table.columns[column].no_wrap = True
    apart = "\n  " if console().is_terminal else " "
    for row in rows:
        aim = f"{'≤' if row.less_is_better else '≥'} {row.aim:g}" if row.aim is not None else ""
        if row.aim is not None and not row.other:
            aim += f" {row.unit}"
        verdict = "" if row.ok is None else mark(row.ok, bad="no")
        what = Text.assemble(row.what, (f"{apart}beside {row.other}", "dim")) if row.other else row.what
        table.add_row(f"{row.ratio:.2f}" if row.ratio is not None else "–", aim, verdict, what, f"{figure(row.ours)} {row.unit}",
                      f"{figure(row.theirs)} {row.unit}" if row.theirs is not None else "–")
    console().print(table)
