"""A tape (docs/replay.md): what the controller saw and did, cycle by cycle, as arrays by name. Read up to its last whole record."""

import struct
import tomllib
import zlib
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.paths import ROOT
from reed_tools.record import lcm_file, run_folder

NAME = run_folder.TAPE
MARK, SCHEMA = b"REEDTAPE", 1
HEADER, CYCLE, END = 1, 2, 3
HEAD, SUM = struct.Struct("<II"), struct.Struct("<I")
EVENT = struct.Struct("<iibbbbid")       # code, joint, mode, force source, about time, two unused, value
FRAME = struct.Struct("<iIBBH")          # offset_ns, identifier, 1: sent, size, unused; then the bytes
CONFIG = "\nconfig\n"


@cache
def of_axes() -> set[str]:
    """Signals with an entry for each of x, y and z."""
    return {f"{message}.{field.name}" for message in ("measured", "control")
            for field in lcm_file.fields(ROOT / "lcmtypes" / f"{message}_t.lcm") if field.length == "3"}


@dataclass(frozen=True)
class Field:
    name: str
    output: bool  # to be found again by a replay
    type: str     # of one entry, as NumPy calls it
    count: int

    def signal(self, index: int) -> str:
        """The name of one entry, joints and parameters counted from 1."""
        if self.count == 1:
            return self.name
        if self.name in of_axes():
            return f"{self.name}_{'xyz'[index]}"
        return f"{self.name}_{'p' if self.name.startswith('adaptation.') else 'j'}{index + 1}"


@dataclass
class Header:
    values: dict[str, str]
    fields: list[Field]
    config: str

    @property
    def joints(self) -> int:
        return int(self.values["joints"])

    @property
    def first_cycle(self) -> int:
        """Number of the run's first cycle; tapes of older programs begin at 0."""
        try:
            return int(tomllib.loads(self.config).get("timing", {}).get("first_cycle", 0))
        except (ValueError, TypeError, AttributeError):  # what is wrong with it is said by who reads it
            return 0

    @property
    def commit(self) -> str:
        return self.values.get("commit", "")

    def layout(self) -> np.dtype:
        return np.dtype([(field.name, f"<{field.type}", (field.count,)) for field in self.fields])


@dataclass
class Tape:
    path: Path
    header: Header
    rows: np.ndarray   # one structured row per cycle, by the names of the header's fields
    rest: list[bytes]  # events and frames of each cycle
    complete: bool     # the program ended by itself
    left: int          # bytes behind the last whole record: damage, or the cut of a program that was ended

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, name: str) -> np.ndarray:
        """(cycles,) or (cycles, entries)."""
        values = self.rows[name]
        return values[:, 0] if values.shape[1] == 1 else values

    @cached_property
    def row_bytes(self) -> np.ndarray:
        return self.rows.view(np.uint8).reshape(len(self.rows), -1)

    def events(self, cycle: int) -> list[tuple]:
        """(code, joint, value) of each."""
        data = self.rest[cycle]
        found = [EVENT.unpack_from(data, k * EVENT.size) for k in range(int(self.rows["num_events"][cycle, 0]))]
        return [(code, joint, value) for code, joint, *_, value in found]

    def sent(self, cycle: int) -> list[tuple[int, bytes]]:
        """(identifier, bytes) of the frames that the controller sent."""
        data, at, found = self.rest[cycle], int(self.rows["num_events"][cycle, 0]) * EVENT.size, []
        while at < len(data):
            _, identifier, sent, size, _ = FRAME.unpack_from(data, at)
            if sent:
                found.append((identifier, data[at + FRAME.size:at + FRAME.size + size]))
            at += FRAME.size + size
        return found

    def missing(self) -> str | None:
        """One line about what is not on the tape."""
        numbers = self["cycle"]
        holes = np.flatnonzero(np.diff(numbers) != 1)
        if len(holes):
            first = int(numbers[holes[0]])
            return f"cycles {first + 1} to {int(numbers[holes[0] + 1]) - 1} are not on the tape: the recorder was not fast enough for them"
        crowded = np.flatnonzero(self["frames_omitted"])
        if len(crowded):
            return f"cycle {int(numbers[crowded[0]])} had more frames than its record holds"
        if self.left and not self.complete:
            return f"the tape is cut or damaged behind cycle {int(numbers[-1]) if len(numbers) else 'none'}: {self.left} bytes there are no whole record"
        if not self.complete:
            return f"the tape ends at cycle {int(numbers[-1]) if len(numbers) else 'none'} without its end: the program was killed, or its disk was full"
        return None

    def usable(self) -> int:
        """Cycles from the first one on without a hole: as many can be replayed."""
        numbers = self["cycle"]
        whole = (numbers == self.header.first_cycle + np.arange(len(numbers))) & (self["frames_omitted"] == 0)
        return int(np.argmin(whole)) if not whole.all() else len(numbers)


def find(place: Path) -> Path:
    """Of a run folder, or the tape itself."""
    if place.is_file():
        return place
    if not place.is_dir():
        raise UsageError(f"{place}: there is no such run folder")
    if (place / NAME).is_file():
        return place / NAME
    raise UsageError(f"{place}: has no {NAME}, so there is nothing to replay; runs of tools/reed run have one since Reed 0.2: run it again")


def read(path: Path) -> Tape:
    with open(path, "rb") as file:
        if file.read(len(MARK)) != MARK:
            raise UsageError(f"{path}: is no tape; allowed: the {NAME} of a run folder")
        kind, header = record(file, path)
        if kind != HEADER:
            raise UsageError(f"{path}: its header is damaged; nothing of it can be replayed")
        head = parse(header.decode(errors="replace"), path)
        body = file.read()
    return cycles(path, head, body)


def record(file, path: Path) -> tuple[int, bytes]:
    start = file.read(HEAD.size)
    kind, size = HEAD.unpack(start) if len(start) == HEAD.size else (0, 0)
    data, total = file.read(size) if size < 1 << 20 else b"", file.read(SUM.size)
    if len(data) != size or len(total) != SUM.size or SUM.unpack(total)[0] != zlib.crc32(data, zlib.crc32(start)):
        raise UsageError(f"{path}: its header is damaged; nothing of it can be replayed")
    return kind, data


def parse(text: str, path: Path) -> Header:
    lines, found, config = text.partition(CONFIG)
    values, fields = {}, []
    for key, _, value in (line.partition(" ") for line in lines.splitlines()):
        if key == "field":
            role, name, kind, count = value.split()
            fields.append(Field(name, role == "out", kind, int(count)))
        else:
            values[key] = value
    schema = values.get("schema", "")
    if schema != str(SCHEMA):
        raise UsageError(f"{path}: tape schema {schema or 'unknown'}, this Reed reads {SCHEMA}; "
                         f"replay it with the Reed that wrote it, commit {values.get('commit') or 'unknown'}")
    if not found or "joints" not in values or not {"cycle", "num_events", "num_frames", "frames_omitted"} <= {field.name for field in fields}:
        raise UsageError(f"{path}: its header is damaged; nothing of it can be replayed")
    return Header(values, fields, config)


def cycles(path: Path, head: Header, body: bytes) -> Tape:
    layout = head.layout()
    fixed, view = layout.itemsize, memoryview(body)
    rows, rest, at, complete = [], [], 0, False
    unpack, crc = HEAD.unpack_from, zlib.crc32
    while not complete and at + HEAD.size + SUM.size <= len(body):
        kind, size = unpack(body, at)
        end = at + HEAD.size + size
        if end + SUM.size > len(body) or SUM.unpack_from(body, end)[0] != crc(view[at:end]):
            break
        if kind == CYCLE and size >= fixed:
            rows.append(view[at + HEAD.size:at + HEAD.size + fixed])
            rest.append(body[at + HEAD.size + fixed:end])
        complete = kind == END
        at = end + SUM.size
    return Tape(path, head, np.frombuffer(b"".join(rows), layout), rest, complete, len(body) - at)
