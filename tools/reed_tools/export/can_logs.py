"""bus.candump in the formats of CAN tools, by python-can's writers. Its TRC and SQLite writers lose CAN FD: not offered."""

from datetime import datetime
from itertools import chain
from pathlib import Path

import can
from can.io.asc import ASCWriter

from reed_tools.errors import UsageError


class AscLog(ASCWriter):
    """python-can dates the header with the moment of writing; here it is the recording's."""

    def __init__(self, file: Path, start_s: float):
        self.start = datetime.fromtimestamp(start_s)
        super().__init__(file)

    def _format_header_datetime(self, dt: datetime) -> str:
        return super()._format_header_datetime(self.start)


class Numbered:
    """The lines of a file, and which one was read last."""

    def __init__(self, file):
        self.file, self.number, self.text = file, 0, ""
        self.close = file.close

    def __iter__(self):
        for self.number, self.text in enumerate(self.file, 1):
            yield self.text


def frames(file, name: str):
    """Every frame of candump -L text; a line that is none is named."""
    lines = Numbered(file)
    try:
        yield from can.CanutilsLogReader(lines)
    except (ValueError, IndexError, OverflowError):
        raise UsageError(f"{name}:{lines.number}: is no line of candump -L: {lines.text.strip()[:60]!r}; "
                         "allowed: bus.candump as a run or `candump -L` writes it") from None


def write(candump: Path, kind: str, target: Path) -> list[Path]:
    source = frames(open(candump, encoding="ascii", errors="replace"), str(candump))
    first = next(source, None)
    if first is None:
        raise UsageError(f"{candump} holds no frame")
    writers = {"asc": lambda: AscLog(target, first.timestamp), "blf": lambda: can.BLFWriter(target), "mf4": lambda: can.MF4Writer(target)}
    with writers[kind]() as log:
        for frame in chain([first], source):
            log.on_message_received(frame)
    return [target]
