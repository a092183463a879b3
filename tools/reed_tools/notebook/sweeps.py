"""Many runs that differ in given numbers: in memory, figures only, none of them kept."""

import itertools
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from reed_tools.errors import RunError, UsageError
from reed_tools.figures import checks, summary
from reed_tools.notebook.runs import cli_value
from reed_tools.record import signals
from reed_tools.run import hil, in_memory, scenario


@dataclass(frozen=True)
class Point:
    """One run of a sweep: what was set, the scenario's figures, and whether all of them held."""

    values: dict[str, Any]
    figures: dict[str, float | None]
    passed: bool
    digest: str


def sweep(name: str | Path, values: Mapping[str, Sequence[Any]], set: Mapping[str, Any] | None = None) -> list[Point]:
    """Every combination of the values, the last key fastest: sweep("press_known", {"wall.stiffness_Npm": [5e3, 1e4, 2e4]}).
    `set`: the same in every run."""
    if not values or not all(values.values()):
        raise UsageError("sweep: expected one key or more, each with one value or more")
    return [point(str(name), dict(zip(values, chosen)), set or {}) for chosen in itertools.product(*values.values())]


def point(name: str, values: dict[str, Any], set: Mapping[str, Any]) -> Point:
    entries = [f"{key}={cli_value(value)}" for key, value in {**set, **values}.items()]
    with tempfile.TemporaryDirectory(prefix="reed-sweep-") as scratch:
        folder = Path(scratch)
        effective = scenario.write_effective(name, None, entries, folder / "effective.toml")
        ended = in_memory.run(effective, folder / "effective.toml", folder)
        if ended.outcome.interrupted:
            raise KeyboardInterrupt
        if ended.status == hil.REFUSED:
            raise UsageError(f"{values}: {ended.said}")
        if ended.died:
            raise RunError(f"{values}: {ended.died}")
        recording = ended.recording()
        found = checks.evaluate(effective["checks"], summary.run_data(effective, recording, signals.join(recording)))
        return Point(values, {check["name"]: check["value"] for check in found}, all(check["ok"] for check in found), recording.digest("lockstep"))
