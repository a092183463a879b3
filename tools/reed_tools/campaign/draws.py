"""What is known about a draw once it has run, and the file that keeps it: draws.jsonl, one line per finished draw."""

import json
import math
import shlex
from dataclasses import asdict, dataclass, field
from pathlib import Path

from reed_tools.errors import UsageError

FILE = "draws.jsonl"


@dataclass
class Record:
    index: int
    definition: str             # of the campaign: records of another one are refused
    build: str                  # of the programs that ran it
    overrides: list[str]
    status: str                 # "finished", "fault" (the controller stopped the arm) or "died" (a program did)
    message: str = ""
    checks: list[dict] = field(default_factory=list)     # of the scenario, as in summary.json
    stability: list[dict] = field(default_factory=list)  # what the campaign calls stable, likewise
    digest: str = ""

    @property
    def stable(self) -> bool:
        """Ran to its end without a fault, every figure is a number, and what the campaign calls stable holds."""
        return (self.status == "finished" and all(check["value"] is not None for check in self.checks)
                and all(check["ok"] for check in self.stability))

    @property
    def within(self) -> bool:
        return self.stable and all(check["ok"] for check in self.checks)

    @property
    def ratio(self) -> float:
        """Of the worst figure to its limit; infinite where a draw is not stable or a limit of 0 is broken."""
        return max((ratio_of(check) for check in self.checks), default=math.inf) if self.stable else math.inf

    @property
    def deciding(self) -> dict | None:
        """The figure that is worst; of a draw that is not stable the one that says so."""
        broken = [check for check in self.stability if not check["ok"]]
        return max(broken or self.checks, key=ratio_of, default=None)


def ratio_of(check: dict) -> float:
    value, limit = check["value"], check["limit"]
    if value is None:
        return math.inf
    if limit > 0:
        return value / limit
    return 0.0 if value <= limit else math.inf


def worst_first(records: list[Record]) -> list[Record]:
    return sorted(records, key=lambda record: (-record.ratio, record.index))


def command(scenario: str, record: Record) -> str:
    """The command line that repeats a draw, bit by bit."""
    words = ["tools/reed", "run", scenario, "--clock", "lockstep"]
    for entry in record.overrides:
        key, value = entry.split("=", 1)
        words += ["--seed", value] if key == "scenario.seed" else ["--set", entry]
    return shlex.join(words)


def append(folder: Path, record: Record) -> None:
    with open(folder / FILE, "a") as file:
        file.write(json.dumps(asdict(record), allow_nan=False) + "\n")


def read(folder: Path, definition: str) -> list[Record]:
    """Finished draws by index. A last line that was being written when the machine stopped is dropped from the file;
    draws in which a program died are run again."""
    path = folder / FILE
    text = path.read_text() if path.exists() else ""
    complete = text[:text.rfind("\n") + 1]
    if complete != text:
        path.write_text(complete)
    found = {}
    for position, line in enumerate(complete.splitlines(), 1):
        try:
            record = Record(**json.loads(line))
        except (ValueError, TypeError):
            raise UsageError(f"{path}:{position}: not a draw's record") from None
        if record.definition != definition:
            raise UsageError(f"{path}:{position}: a draw of another campaign than {folder / 'campaign.toml'} with its seed and --set")
        if record.status != "died":
            found[record.index] = record
    return [found[index] for index in sorted(found)]
