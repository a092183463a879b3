"""LCM event log files, record by record. liblcm's own reader trusts the lengths that a record claims and passes over damage
without a word: here a record counts only if it lies in the file and another one, or the end, follows it."""

from pathlib import Path
from typing import BinaryIO, Iterator, NamedTuple

from reed_tools.record.log_tail import RECORD, SYNC

LONGEST_CHANNEL = 63  # letters, by liblcm
SYNC_NUMBER = int.from_bytes(SYNC, "big")
BLOCK = 1 << 20


class Event(NamedTuple):
    time_us: int
    channel: str
    data: bytes

    @property
    def size(self) -> int:
        return RECORD.size + len(self.channel) + len(self.data)


def read(path: Path) -> Iterator[Event]:
    """The whole records; damaged stretches and a record cut at the end are left out."""
    with open(path, "rb") as file:
        size = path.stat().st_size
        at, head = 0, file.read(RECORD.size)
        while len(head) == RECORD.size:
            sync, _, time_us, channel_size, data_size = RECORD.unpack(head)
            end = at + RECORD.size + channel_size + data_size
            body = b""
            if sync == SYNC_NUMBER and 0 < channel_size <= LONGEST_CHANNEL and end <= size:
                body = file.read(channel_size + data_size + RECORD.size)  # and the head of the next one
            following = body[channel_size + data_size:]
            channel = body[:channel_size]
            if body and channel.isascii() and SYNC.startswith(following[:len(SYNC)]):
                yield Event(time_us, channel.decode("ascii"), body[channel_size:channel_size + data_size])
                at, head = end, following
            else:
                at = next_sync(file, at + 1)
                head = file.read(RECORD.size)


def next_sync(file: BinaryIO, at: int) -> int:
    """Moves to the next sync word from `at` on, or to the end."""
    file.seek(at)
    block = file.read(BLOCK)
    while block:
        found = block.find(SYNC)
        if found >= 0:
            file.seek(at + found)
            return at + found
        if len(block) < BLOCK:
            break
        at += BLOCK - len(SYNC) + 1
        file.seek(at)
        block = file.read(BLOCK)
    return file.seek(0, 2)


def write(file: BinaryIO, events: Iterator[Event]) -> int:
    """Returns the number of bytes."""
    size = 0
    for number, event in enumerate(events):
        channel = event.channel.encode("ascii")
        file.write(RECORD.pack(SYNC_NUMBER, number, event.time_us, len(channel), len(event.data)) + channel + event.data)
        size += event.size
    return size
