"""What both versions are shown: config/gate/corpus.toml, and whether its tapes hold all that it promises."""

import tomllib
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.paths import ARMS, ROOT, SCENARIOS
from reed_tools.record.tape import Tape
from reed_tools.robots.joint_frames import dof

FILE = ROOT / "config" / "gate" / "corpus.toml"


@dataclass(frozen=True)
class Entry:
    name: str
    scenario: str
    arm: str | None = None
    entries: tuple[str, ...] = ()

    @property
    def joints(self) -> int | None:
        """As the files here say; None where they do not."""
        try:
            arm = self.arm or read_toml(SCENARIOS / f"{self.scenario}.toml" if "/" not in self.scenario else Path(self.scenario))["arm"]
            if isinstance(arm, str):
                arm = read_toml(ARMS / f"{arm}.toml" if "/" not in arm else Path(arm))
            return dof(arm) or None
        except (OSError, KeyError, TypeError, ValueError):
            return None

    def options(self) -> list[str]:
        """Of a program that reads scenarios."""
        arm = ["--arm", self.arm] if self.arm else []
        return ["--config", self.scenario, *arm, *(word for entry in self.entries for word in ("--set", entry))]


@dataclass(frozen=True)
class Corpus:
    tapes: list[Entry]
    coverage: dict[str, list]
    longest_s: float  # of a scenario

    def entries(self) -> list[tuple[str, Entry]]:
        """All, with their kind."""
        return [*(("tape", entry) for entry in self.tapes), *(("scenario", entry) for entry in scenarios(self.longest_s))]


def read_toml(path: Path) -> dict:
    return tomllib.loads(path.read_text(encoding="utf-8"))


def load(path: Path = FILE) -> Corpus:
    try:
        found = read_toml(path)
        tapes = [Entry(one["name"], located(path, one["scenario"]), one.get("arm") and located(path, one["arm"]), tuple(one.get("set", ())))
                 for one in found["tapes"]]
        return Corpus(tapes, found["coverage"], float(found["scenarios"]["longest_s"]))
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise UsageError(f"{path}: {error}; it lists [[tapes]] with name and scenario, [coverage] and [scenarios]") from None


def located(path: Path, name: str) -> str:
    """A file beside the list, or a name that each version looks up in its own config."""
    return str(path.with_name(name)) if name.endswith(".toml") else name


def scenarios(longest_s: float) -> list[Entry]:
    """Those of config/scenarios, long ones cut."""
    found = []
    for path in sorted(SCENARIOS.glob("*.toml")):
        duration_s = read_toml(path).get("scenario", {}).get("duration_s", longest_s)
        found.append(Entry(path.stem, path.stem, None, (f"scenario.duration_s={longest_s}",) if duration_s > longest_s else ()))
    return found


@dataclass
class Seen:
    """What the tapes hold."""

    modes: set = field(default_factory=set)
    sources: set = field(default_factory=set)
    laws: set = field(default_factory=set)
    joints: set = field(default_factory=set)
    codes: set = field(default_factory=set)  # of events: trips, switches, news

    def add(self, tape: Tape) -> None:
        self.modes |= set(np.unique(tape["control.mode"]).tolist())
        self.sources |= set(np.unique(tape["control.force_source"]).tolist())
        self.laws.add(tape.header.values["law"])
        self.joints.add(tape.header.joints)
        for cycle in np.flatnonzero(tape["num_events"]):
            self.codes |= {code for code, *_ in tape.events(int(cycle))}

    def lacks(self, coverage: dict[str, list]) -> list[str]:
        """In words, what is promised and was not seen."""
        return [f"{kind} {value}" for kind, values in coverage.items() for value in values if value not in getattr(self, kind)]


def lacks(tapes: Iterable[Tape], coverage: dict[str, list]) -> list[str]:
    seen = Seen()
    for tape in tapes:
        seen.add(tape)
    return seen.lacks(coverage)
