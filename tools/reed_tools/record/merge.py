"""The two programs' logs made one: what is there stays until the merged log is whole and on the disk."""

import heapq
from pathlib import Path

from reed_tools.errors import RunError
from reed_tools.record.event_file import Event, write
from reed_tools.record.telemetry_log import events
from reed_tools.record.whole_file import draft_of, replacing


def merge(parts: list[Path], target: Path) -> None:
    """Writes all messages of `parts` by their own time, then deletes the parts."""
    parts = [part for part in parts if part.exists()]
    by_time = heapq.merge(*(events(part) for part in parts), key=lambda message: message[0])
    with replacing(target) as file:
        size = write(file, (Event(*message) for message in by_time))
        file.flush()
        if (found := draft_of(target).stat().st_size) != size:
            raise RunError(f"{target}: {size} bytes were written and {found} are there; the programs' own logs stay")
    for part in parts:
        part.unlink()
