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
    def seed(self) -> str:
        """Of the draw's run; "" where the scenario's own counts."""
        return next((entry.partition("=")[2] for entry in reversed(self.overrides) if entry.startswith("scenario.seed=")), "")

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


def valid(record: Record) -> bool:
    """Whether every field is of its kind: the file may have been written by hand, or been damaged."""
    texts = (record.definition, record.build, record.status, record.message, record.digest)
    lists = (record.overrides, record.checks, record.stability)
    return (type(record.index) is int and all(isinstance(text, str) for text in texts) and all(isinstance(entry, list) for entry in lists)
            and all(isinstance(entry, str) and "=" in entry for entry in record.overrides)
            and all(valid_check(check) for check in (*record.checks, *record.stability)))


def valid_check(check) -> bool:
    return (isinstance(check, dict) and isinstance(check.get("name"), str) and type(check.get("limit")) in (int, float)
            and type(check.get("value")) in (int, float, type(None)) and isinstance(check.get("ok"), bool))


def append(folder: Path, record: Record) -> None:
    with open(folder / FILE, "a") as file:
        file.write(json.dumps(asdict(record), allow_nan=False) + "\n")


def read(folder: Path, definition: str) -> list[Record]:
    """Finished draws by index. A last line that was being written when the machine stopped is dropped from the file;
    draws in which a program died are run again."""
    path = folder / FILE
    content = path.read_bytes() if path.exists() else b""
    complete = content[:content.rfind(b"\n") + 1]
    if complete != content:
        path.write_bytes(complete)
    found = {}
    for position, line in enumerate(complete.split(b"\n")[:-1], 1):
        try:
            record = Record(**json.loads(line))
        except (ValueError, TypeError, RecursionError):
            record = None
        if record is None or not valid(record):
            raise UsageError(f"{path}:{position}: not a draw's record")
        if record.definition != definition:
            raise UsageError(f"{path}:{position}: a draw of another campaign than {folder / 'campaign.toml'} with its seed and --set")
        if record.status != "died":
            found[record.index] = record
    return [found[index] for index in sorted(found)]
