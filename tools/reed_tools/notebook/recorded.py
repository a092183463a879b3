"""A run folder as arrays by name, with units."""

import json
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.export.columns import suffixes
from reed_tools.figures import metrics
from reed_tools.record import configuration, run_folder
from reed_tools.record.message_layout import Field, fields
from reed_tools.record.telemetry_log import TABLES, Recording, name_of
from reed_tools.record.telemetry_log import load as load_log
from reed_tools.text import did_you_mean

NOT_DRAWN = ("utime", "cycle", "dof", "num")


class Run:
    """What one run left. `run["control.tau"]` is [cycles, joints], `run["control.tau_j1"]` one column of it, `run["control.f_d"]`
    a number per cycle; `time`, `unit` and `meaning` belong to the same names, and `names` lists them."""

    def __init__(self, folder: Path):
        self.folder = folder

    @cached_property
    def recording(self) -> Recording:
        return load_log(*run_folder.logs(self.folder))

    @cached_property
    def config(self) -> dict[str, Any]:
        """effective.toml: everything that the run used."""
        return configuration.load(self.folder / run_folder.CONFIGURATION)

    @cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json: the figures and the verdict."""
        return json.loads((self.folder / run_folder.SUMMARY).read_text(encoding="utf-8"))

    @property
    def passed(self) -> bool:
        return self.summary["verdict"] == "pass"

    @property
    def figures(self) -> dict[str, float | None]:
        """The scenario's checks by name."""
        return {check["name"]: check["value"] for check in self.summary["checks"]}

    @cached_property
    def fields(self) -> dict[str, tuple[str, Field]]:
        """(channel, declaration) of every signal, by channel and field: "control.tau"."""
        return {name_of(channel, field.name): (channel, field) for channel, kind in TABLES.items()
                for field in fields(kind) if field.name not in NOT_DRAWN and self.recording.has(channel)}

    def names(self, containing: str = "") -> list[str]:
        return [name for name in self.fields if containing in name]

    def __getitem__(self, name: str) -> np.ndarray:
        whole, column = self.place(name)
        channel, field = self.fields[whole]
        values = self.recording.tables[channel][field.name]
        return values if column is None else values[:, column]

    def columns(self, name: str) -> list[str]:
        """Names of the columns of an array: control.tau_j1 …; of a number per cycle the name alone."""
        channel, field = self.fields[self.place(name)[0]]
        values = self.recording.tables[channel][field.name]
        if values.ndim == 1:
            return [name]
        return [f"{name}_{suffix}" for suffix in suffixes(field, values.shape[1], self.config["arm"]["param_names"] if channel == "REED_ADAPTATION" else [])]

    def time(self, name: str) -> np.ndarray:
        """s since the arm became active, one per row of the signal; before that it is negative."""
        cycle = self.recording.tables[self.fields[self.place(name)[0]][0]]["cycle"]
        return (cycle - metrics.zero_cycle(self.recording)) / self.config["timing"]["rate_hz"]

    def unit(self, name: str) -> str:
        return self.fields[self.place(name)[0]][1].unit

    def meaning(self, name: str) -> str:
        """What lcmtypes says of it."""
        return self.fields[self.place(name)[0]][1].comment

    def place(self, name: str) -> tuple[str, int | None]:
        """Signal, and which of its columns is meant, None for all."""
        if name in self.fields:
            return name, None
        whole = max((known for known in self.fields if name.startswith(f"{known}_")), key=len, default=None)
        if whole is not None and name in (columns := self.columns(whole)):
            return whole, columns.index(name)
        raise UsageError(f"{self.folder}: there is no signal {name}{did_you_mean(name, self.fields)}; names() lists those there are")

    def __repr__(self) -> str:
        return f"<Run {self.summary['scenario']} on {self.summary['arm']}: {self.summary['verdict']}, {self.folder}>"


def load(folder: str | Path) -> Run:
    """A folder that tools/reed run wrote. Its records are those of its run, or it is refused."""
    path = Path(folder)
    if not (path / run_folder.CONFIGURATION).is_file() or not run_folder.logs(path) or not (path / run_folder.SUMMARY).is_file():
        raise UsageError(f"{path} is not a run folder: it needs {run_folder.CONFIGURATION}, {run_folder.TELEMETRY} and {run_folder.SUMMARY}; "
                         "`tools/reed report` makes the last")
    run_folder.require_unchanged(path)
    return Run(path)
