"""One entry of the corpus with both versions: the base's tape through the new controller, and the closed loop of both."""

import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from reed_tools.errors import ReedError, RunError
from reed_tools.gate.corpus import Entry
from reed_tools.record.tape import Tape, read
from reed_tools.replay import differences
from reed_tools.replay.differences import Difference
from reed_tools.replay.player import Changes, replay

STOPPED = 1  # status of a run whose arm ended in a fault


class Refused(Exception):
    """This version does not take the entry."""


@dataclass
class Result:
    name: str
    kind: str  # "tape": open loop; "scenario": closed loop
    changed: list[Difference] = field(default_factory=list)
    recorded: Tape | None = None


def record(programs: Path, entry: Entry, target: Path) -> Tape:
    command = [str(programs / "reed_one_process"), *entry.options(), "--enable", "--no-lcm", "--quiet", "--tape", str(target)]
    done = subprocess.run(command, capture_output=True, text=True, errors="replace")
    if done.returncode == 2:
        raise Refused((done.stderr.strip().splitlines() or ["status 2"])[-1])
    if done.returncode not in (0, STOPPED):
        raise RunError(f"{entry.name}: {programs.parents[2].name}: {done.stderr.strip()[-300:] or f'status {done.returncode}'}")
    return read(target)


def open_loop(base: Path, head: Path, entry: Entry, scratch: Path) -> Result:
    """BASE records, HEAD replays. What BASE itself does not find again is no change."""
    try:
        recorded = record(base, entry, scratch / "base.tape")
    except Refused as refused:
        raise RunError(f"tape {entry.name}: the base refuses it: {refused}") from None
    result = Result(entry.name, "tape", recorded=recorded)
    try:
        result.changed = differences.every(recorded, replay(recorded, Changes(), scratch, head / "reed_replay"))
    except ReedError as error:
        result.changed = [Difference("configuration", 0, "accepted", str(error))]
    if result.changed and differences.every(recorded, replay(recorded, Changes(), scratch, base / "reed_replay")):
        raise RunError(f"tape {entry.name}: the base does not replay its own tape to the bit; the gate can say nothing")
    return result


def closed_loop(base: Path, head: Path, entry: Entry, scratch: Path) -> Result:
    result, tapes = Result(entry.name, "scenario"), []
    for name, programs in (("base", base), ("head", head)):
        try:
            tapes.append(record(programs, entry, scratch / f"{name}.tape"))
        except Refused as refused:
            tapes.append(str(refused))
    if all(isinstance(tape, Tape) for tape in tapes):
        result.changed = differences.every(*tapes)
    elif tapes[0] != tapes[1]:
        said = [tape if isinstance(tape, str) else "accepted" for tape in tapes]
        result.changed = [Difference("configuration", 0, *said)]
    return result
