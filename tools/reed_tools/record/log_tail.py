"""Reads where a run is from the end of its growing telemetry log. Format of an LCM event log record, big-endian:
sync word, event number, timestamp, channel length, data length, channel, data."""

import os
import struct
from pathlib import Path

SYNC = bytes.fromhex("EDA1DA01")
RECORD = struct.Struct(">IQqII")
CONTROL = struct.Struct(">8xqqdb")  # after the type's fingerprint: utime, cycle, t_s, mode
WINDOW = 16384
SECONDS_BACK = 8 << 20  # bytes: a run ends in off, some cycles after it was active
ACTIVE = 2


class LogTail:
    def __init__(self, path: Path):
        self.path = path

    def size(self) -> int:
        try:
            return os.path.getsize(self.path)
        except OSError:
            return 0

    def control(self) -> tuple[int, int, float] | None:
        """(cycle, mode, t_s) of the newest complete REED_CONTROL in the last bytes of the file."""
        return next(self.controls(WINDOW), None)

    def reached_s(self) -> float:
        """t_s of the newest cycle with an active arm: it is 0 again in those after it."""
        return next((t_s for _, mode, t_s in self.controls(SECONDS_BACK) if mode == ACTIVE), 0.0)

    def controls(self, last_bytes: int):
        """(cycle, mode, t_s) of every complete REED_CONTROL in the last bytes of the file, newest first."""
        try:
            with open(self.path, "rb") as file:
                file.seek(max(0, self.size() - last_bytes))
                block = file.read()
        except OSError:
            return
        at = len(block)
        while (at := block.rfind(SYNC, 0, at)) >= 0:
            if at + RECORD.size > len(block):
                continue
            _, _, _, channel_size, data_size = RECORD.unpack_from(block, at)
            data_at = at + RECORD.size + channel_size
            if block[at + RECORD.size:data_at] == b"REED_CONTROL" and data_at + CONTROL.size <= len(block):
                _, cycle, t_s, mode = CONTROL.unpack_from(block, data_at)
                yield cycle, mode, t_s
