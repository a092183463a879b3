"""Telemetry logs: the two programs' logs merged into one, and one log read into arrays."""

import hashlib
import heapq
import itertools
import os
import struct
from dataclasses import dataclass, field
from pathlib import Path

import lcm
import numpy as np

from reed_tools.errors import RunError, UsageError
from reed_tools.paths import use_message_types
from reed_tools.record.message_layout import decode_all

# Fixed order: it is part of the digest's definition.
DIGEST_CHANNELS = ("REED_MEASURED", "REED_CONTROL", "REED_ADAPTATION", "REED_PLANT")
TABLES = {"REED_MEASURED": "measured_t", "REED_CONTROL": "control_t", "REED_ADAPTATION": "adaptation_t",
          "REED_PLANT": "plant_t", "REED_TIMING": "timing_t", "REED_SHAPE": "shape_t"}
SINGLES = {"REED_RUN": "run_t", "REED_BUS": "bus_t", "REED_EVENT": "event_t", "REED_PLANT_EVENT": "event_t",
           "REED_HISTOGRAM": "histogram_t"}
EVENT_HEAD_BYTES = 28  # of an LCM log: sync word, number, time, two lengths
HEAD = struct.Struct(">8xqq")  # after the type's fingerprint: utime, cycle


@dataclass
class Recording:
    """One run as arrays. tables[channel][field] has one row per recorded cycle, tables[channel]["cycle"] says which."""

    tables: dict[str, dict[str, np.ndarray]] = field(default_factory=dict)
    singles: dict[str, list] = field(default_factory=dict)
    channel_digests: dict[str, str] = field(default_factory=dict)

    def has(self, channel: str) -> bool:
        return len(self.tables[channel]["cycle"]) > 0

    @property
    def run(self):
        """The last REED_RUN: the one written at the end if the firmware got that far."""
        return self.singles["REED_RUN"][-1] if self.singles["REED_RUN"] else None

    @property
    def finished_run(self):
        """What the firmware told of the loop when it ended; None if it never came to that."""
        return self.run if self.run and self.run.finished else None

    def digest(self, clock: str) -> str:
        """SHA-256 over the SHA-256 of each channel's encoded messages in cycle order. The plant's truth belongs to it in
        lockstep only: on a wall clock it is not the controller's state, and its samples depend on the machine."""
        total = hashlib.sha256()
        for channel in DIGEST_CHANNELS:
            if channel != "REED_PLANT" or clock == "lockstep":
                total.update(bytes.fromhex(self.channel_digests[channel]))
        return total.hexdigest()


def open_log(path: Path, mode: str) -> lcm.EventLog:
    """Through its descriptor's name: liblcm takes names in UTF-8 only."""
    descriptor = os.open(path, os.O_RDONLY if mode == "r" else os.O_RDWR | os.O_CREAT, 0o666)
    try:
        return lcm.EventLog(f"/proc/self/fd/{descriptor}", mode, overwrite=mode == "w")
    finally:
        os.close(descriptor)


def events(path: Path):
    """(utime, channel, bytes) of every message in the log, in its order."""
    log = open_log(path, "r")
    try:
        for event in log:
            if event.channel.startswith("REED_") and len(event.data) >= 16:
                yield HEAD.unpack_from(event.data)[0] if len(event.data) >= 24 else 0, event.channel, event.data
    finally:
        log.close()


def require_whole(path: Path) -> None:
    """A log that was cut or damaged reads as another run: liblcm passes over what it cannot read."""
    log = open_log(path, "r")
    try:
        read = sum(EVENT_HEAD_BYTES + len(event.channel) + len(event.data) for event in log)
    finally:
        log.close()
    if read != path.stat().st_size:
        raise UsageError(f"{path} is damaged: messages make up {read} of its {path.stat().st_size} bytes; nothing was changed")


def merge(parts: list[Path], target: Path) -> None:
    """Writes all messages of `parts` by their own time, then deletes the parts."""
    parts = [part for part in parts if part.exists()]
    if target.exists():
        target.unlink()
    log = open_log(target, "w")
    for utime, channel, data in heapq.merge(*(events(part) for part in parts), key=lambda event: event[0]):
        log.write_event(utime, channel, data)
    log.close()
    for part in parts:
        part.unlink()


def load(*paths: Path) -> Recording:
    """One merged log, or the two programs' own: no channel is in both."""
    for path in paths:
        if not path.is_file():
            raise RunError(f"{path} is missing: nothing was recorded")
    use_message_types()
    import reed

    payloads = {channel: [] for channel in TABLES}
    recording = Recording(singles={channel: [] for channel in SINGLES})
    for _, channel, data in itertools.chain.from_iterable(map(events, paths)):
        if channel in payloads:
            payloads[channel].append(data)
        elif channel in SINGLES:
            recording.singles[channel].append(getattr(reed, SINGLES[channel]).decode(data))
    for channel, name in TABLES.items():
        recording.tables[channel] = decode_all(getattr(reed, name), name, payloads[channel])
    last = max(recording.tables["REED_MEASURED"]["cycle"], default=-1)
    for channel in DIGEST_CHANNELS:
        # The plant may answer a SYNC after the controller's last recorded cycle.
        kept = [data for data in payloads[channel] if HEAD.unpack_from(data)[1] <= last]
        recording.channel_digests[channel] = hashlib.sha256(b"".join(kept)).hexdigest()
    return recording
