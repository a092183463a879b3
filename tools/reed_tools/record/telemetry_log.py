"""Telemetry logs read into arrays: one merged log, or the two programs' own."""

import hashlib
import itertools
import struct
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from reed_tools.errors import RunError, UsageError
from reed_tools.paths import use_message_types
from reed_tools.record import event_file, event_log
from reed_tools.record.message_layout import decode_all, joined

# Fixed order: it is part of the digest's definition.
DIGEST_CHANNELS = ("REED_MEASURED", "REED_CONTROL", "REED_ADAPTATION", "REED_PLANT")
TABLES = {"REED_MEASURED": "measured_t", "REED_CONTROL": "control_t", "REED_ADAPTATION": "adaptation_t",
          "REED_PLANT": "plant_t", "REED_TIMING": "timing_t", "REED_SHAPE": "shape_t", "REED_LAW": "law_t",
          "REED_WIRE": "wire_t"}
SINGLES = {"REED_RUN": "run_t", "REED_BUS": "bus_t", "REED_EVENT": "event_t", "REED_PLANT_EVENT": "event_t",
           "REED_HISTOGRAM": "histogram_t", "REED_LAW_NAMES": "law_names_t"}
RESTORE = "restore it from a copy, or run again: `command` in the folder's run.json"
LEAST_BYTES = 16     # of a message of ours: fingerprint and utime
HEAD = struct.Struct(">8xqq")  # after the type's fingerprint: utime, cycle


def name_of(channel: str, field: str) -> str:
    """control.f_d, as in exported tables."""
    return f"{channel.removeprefix('REED_').lower()}.{field}"


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
        """What the firmware reported of the loop at its end; None without that report."""
        return self.run if self.run and self.run.finished else None

    @property
    def law_names(self) -> list[str]:
        """What a law from outside calls the values that it shows; empty where it shows none."""
        said = self.singles.get("REED_LAW_NAMES")
        return list(said[-1].names) if said else []

    def digest(self, clock: str) -> str:
        """SHA-256 over the SHA-256 of each channel's encoded messages in cycle order. The plant's truth belongs to it in
        lockstep only: in realtime it is not the controller's state, and its samples depend on the machine."""
        total = hashlib.sha256()
        for channel in DIGEST_CHANNELS:
            if channel != "REED_PLANT" or clock == "lockstep":
                total.update(bytes.fromhex(self.channel_digests[channel]))
        return total.hexdigest()


def events(path: Path):
    """(utime, channel, bytes) of every message in the log, in its order."""
    for event in event_file.read(path):
        if event.channel.startswith("REED_") and len(event.data) >= LEAST_BYTES:
            yield HEAD.unpack_from(event.data)[0] if len(event.data) >= HEAD.size else 0, event.channel, event.data


def payloads(path: Path) -> event_log.Blocks:
    """By channel, all that can be read: damaged stretches are left out, as event_file.py reads them."""
    try:
        blocks = event_log.read(path)
    except ValueError:
        blocks = {}
        for _, channel, data in events(path):
            blocks.setdefault(channel, []).append(np.frombuffer(data, np.uint8)[np.newaxis])
    return {channel: [block for block in found if block.shape[1] >= LEAST_BYTES] for channel, found in blocks.items()}


def require_whole(path: Path) -> None:
    """A log that was cut or damaged reads as another run."""
    read, size = sum(event.size for event in event_file.read(path)), path.stat().st_size
    if read != size or not size:
        raise UsageError(f"{path} is damaged: whole messages make up {read} of its {size} bytes; nothing was changed; {RESTORE}")


def load(*paths: Path) -> Recording:
    """One merged log, or the two programs' own: no channel is in both."""
    for path in paths:
        if not path.is_file():
            raise RunError(f"{path} is missing: nothing was recorded")
    use_message_types()
    import reed

    recording = Recording(singles={channel: [] for channel in SINGLES})
    messages = {channel: [] for channel in TABLES}
    for channel, blocks in itertools.chain.from_iterable(payloads(path).items() for path in paths):
        if channel in messages:
            messages[channel] += blocks
        elif channel in SINGLES:
            decode = getattr(reed, SINGLES[channel]).decode
            recording.singles[channel] += [decoded(decode, channel, row.tobytes()) for block in blocks for row in block]
    whole = {channel: joined(name, messages[channel]) for channel, name in TABLES.items()}
    for channel, name in TABLES.items():
        recording.tables[channel] = decoded(decode_all, channel, getattr(reed, name), name, whole[channel])
    last = int(recording.tables["REED_MEASURED"]["cycle"].max()) if recording.has("REED_MEASURED") else -1
    for channel in DIGEST_CHANNELS:
        # The plant may answer a SYNC after the controller's last recorded cycle.
        kept = recording.tables[channel]["cycle"] <= last
        recording.channel_digests[channel] = hashlib.sha256(whole[channel] if kept.all() else whole[channel][kept]).hexdigest()
    return recording


def decoded(decode, channel: str, *what):
    """The generated classes raise whatever they stumble over."""
    try:
        return decode(*what)
    except (ValueError, struct.error, IndexError, MemoryError):  # UnicodeDecodeError is a ValueError
        raise UsageError(f"a message of {channel} cannot be read: the log is damaged, or was written with other message types; "
                         "read it with the Reed that wrote it: `commit` in the folder's run.json") from None
