"""safety/accepted.toml: dangerous cells that stay so, each by name and with its reason."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.faults.cell import Row
from reed_tools.paths import ROOT

FILE = ROOT / "safety" / "accepted.toml"


@dataclass(frozen=True)
class Accepted:
    fault: str
    phases: tuple[str, ...]  # none: all
    reason: str

    def covers(self, row: Row) -> bool:
        return row.fault == self.fault and (not self.phases or row.phase in self.phases)


def load(path: Path = FILE) -> list[Accepted]:
    if not path.exists():
        return []
    try:
        entries = tomllib.loads(path.read_text(encoding="utf-8")).get("accepted", [])
        found = [Accepted(entry["fault"], tuple(entry.get("phases", ())), entry["reason"].strip()) for entry in entries]
    except (OSError, tomllib.TOMLDecodeError, UnicodeDecodeError, KeyError, TypeError, AttributeError) as error:
        raise UsageError(f"{path}: expected [[accepted]] with fault, phases and reason: {error}") from None
    if nameless := next((one for one in found if not one.reason), None):
        raise UsageError(f"{path}: accepted {nameless.fault}: reason: missing; why it may stay dangerous")
    return found


def reason_for(row: Row, accepted: list[Accepted]) -> str | None:
    return next((one.reason for one in accepted if one.covers(row)), None)
