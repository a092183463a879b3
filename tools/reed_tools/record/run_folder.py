"""What a run folder keeps of its run, and whether that is still what the run left there."""

import hashlib
import json
import os
from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.record import telemetry_log
from reed_tools.record.merge import merge
from reed_tools.record.whole_file import write_text

CONFIGURATION = "effective.toml"
TELEMETRY = "telemetry.lcmlog"
HALVES = ("controller.toml", "plant.toml")   # what each program reads of it
ORIGIN = "run.json"                          # command, versions, machine
PARTS = ("firmware.lcmlog", "plant.lcmlog")  # until they are merged
SUMMARY = "summary.json"
SUMS = "SHA256SUMS"                          # in the form that `sha256sum -c` reads
TAPE = "tape.reed"                           # record/tape.py
RECORDS = (CONFIGURATION, *HALVES, ORIGIN, TELEMETRY, "bus.candump", TAPE)
FILES = (*RECORDS, *PARTS, SUMS, "bus.log", "firmware.txt", "plant.txt", "one_process.txt")


def logs(folder: Path) -> list[Path]:
    """The merged log, or what there is of the programs' own."""
    merged = folder / TELEMETRY
    return [merged] if merged.is_file() else [folder / part for part in PARTS if (folder / part).is_file()]


def complete(folder: Path) -> str | None:
    """Merges and seals what the two programs left. One line if that found no room: then their own logs stay."""
    parts = [folder / part for part in PARTS if (folder / part).is_file()]
    try:
        if not parts:
            return None
        if (folder / TELEMETRY).is_file():  # renamed, but stopped before the parts were deleted
            telemetry_log.require_whole(folder / TELEMETRY)
            for part in parts:
                part.unlink()
        else:
            merge(parts, folder / TELEMETRY)
        seal(folder)
    except OSError as error:
        return f"{error.filename}: {(error.strerror or str(error)).lower()}; the records are kept as they are"
    return None


def origin(folder: Path) -> dict:
    """What ORIGIN says; a folder of an earlier version, or of no single run, says nothing."""
    path = folder / ORIGIN
    try:
        found = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    except ValueError as error:
        raise UsageError(f"{path}: {error}") from None
    if not isinstance(found, dict):
        raise UsageError(f"{path}: expected an object")
    return {key: found.get(key) for key in ("command", "versions", "machine")}


def as_json(folder: Path) -> str:
    """summary.json on one line, with the folder that it is of."""
    return json.dumps({"folder": str(folder), **json.loads((folder / SUMMARY).read_text(encoding="utf-8"))})


def require_ended(folder: Path) -> None:
    """Logs that are still being written are not ours to merge."""
    parts = {os.path.realpath(folder / part) for part in PARTS}
    for entry in Path("/proc").glob("[0-9]*/fd/*"):
        try:
            if os.readlink(entry) in parts:
                raise UsageError(f"{folder}: its run goes on, process {entry.parts[2]} writes {os.path.basename(os.readlink(entry))}")
        except OSError:  # another user's process, or one that has just ended
            continue


def seal(folder: Path) -> None:
    """Sums of everything that a report is made from."""
    write_text(folder / SUMS, "".join(f"{sum_of(folder / name)}  {name}\n" for name in RECORDS if (folder / name).is_file()))


def verify(folder: Path) -> None:
    """Refuses a folder whose records are no longer those of its run. A folder without sums is an old one."""
    path = folder / SUMS
    if not path.is_file():
        return
    known = dict(reversed(line.split("  ", 1)) for line in path.read_text(errors="replace").splitlines() if "  " in line)
    for name in RECORDS:
        found = folder / name
        if name not in known and name in (CONFIGURATION, TELEMETRY):
            raise UsageError(f"{path} is damaged: it has no line for {name}; nothing was changed; {telemetry_log.RESTORE}")
        if found.is_file() and name in known and sum_of(found) != known[name]:
            raise UsageError(f"{found} is damaged: its SHA-256 is not the one in {SUMS}; nothing was changed; {telemetry_log.RESTORE}")


def require_unchanged(folder: Path) -> None:
    """Before anything is read from a folder: its records are those of its run, and whole."""
    verify(folder)
    if (folder / TELEMETRY).is_file():
        telemetry_log.require_whole(folder / TELEMETRY)


def sum_of(path: Path) -> str:
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
