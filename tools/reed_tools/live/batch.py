"""Telemetry of a while as arrays: from the LCM network, or cut out of a recording. The page knows nothing else."""

import os
import threading
from dataclasses import dataclass, field

import lcm
import numpy as np

from reed_tools.errors import RunError
from reed_tools.paths import use_message_types
from reed_tools.record.message_layout import decode_all
from reed_tools.record.telemetry_log import SINGLES, TABLES, Recording

CLOCK = "REED_CONTROL"     # the channel whose messages are a run's time
MOST_PAYLOADS = 20000      # per channel between two takes; beyond it the oldest go
POLL_ms = 100
BUFFER_BYTES = 2 << 20


@dataclass
class Batch:
    """tables[channel] only where there is at least one message; singles[channel] in order."""

    tables: dict[str, dict[str, np.ndarray]] = field(default_factory=dict)
    singles: dict[str, list] = field(default_factory=dict)
    restarted: bool = False  # a run began within it: what came before is of another run

    def __bool__(self) -> bool:
        return bool(self.tables or any(self.singles.values()))


def telemetry_url() -> str:
    """As everywhere, with a receive buffer of a second: the page may be kept from running for that long."""
    url = os.environ.get("LCM_DEFAULT_URL") or "udpm://239.255.76.67:7667?ttl=0"
    if not url.startswith("udpm") or "recv_buf_size" in url:
        return url
    return f"{url}{'&' if '?' in url else '?'}recv_buf_size={BUFFER_BYTES}"


class LcmFeed:
    """Listens in a thread of its own and keeps bytes; decoding waits for take()."""

    def __init__(self):
        use_message_types()
        import reed

        self.types = {channel: (getattr(reed, name), name) for channel, name in (TABLES | SINGLES).items()}
        try:
            self.lcm = lcm.LCM(telemetry_url())
        except RuntimeError as error:
            raise RunError(f"telemetry cannot be heard: {error}; LCM_DEFAULT_URL is wrong or there is no multicast (tools/reed doctor)") from None
        self.lock = threading.Lock()
        self.payloads: dict[str, list[bytes]] = {channel: [] for channel in self.types}
        self.last_cycle = -1
        self.subscription = self.lcm.subscribe("REED_.*", self.keep)
        self.subscription.set_queue_capacity(MOST_PAYLOADS)
        threading.Thread(target=self.listen, daemon=True).start()

    def listen(self) -> None:
        while True:
            self.lcm.handle_timeout(POLL_ms)

    def keep(self, channel: str, data: bytes) -> None:
        with self.lock:
            if (kept := self.payloads.get(channel)) is not None:
                kept.append(data)
                del kept[:-MOST_PAYLOADS]

    def take(self) -> Batch:
        """What came since the last call."""
        with self.lock:
            taken, self.payloads = self.payloads, {channel: [] for channel in self.types}
        batch = Batch()
        for channel, payloads in taken.items():
            kind, name = self.types[channel]
            fingerprint = kind._get_packed_fingerprint()
            payloads = [data for data in payloads if data[:8] == fingerprint]  # another version of the message: not ours
            if not payloads:
                continue
            if channel in SINGLES:
                batch.singles[channel] = [kind.decode(data) for data in payloads]
            else:
                same = [data for data in payloads if len(data) == len(payloads[-1])]  # an arm with other joints came before
                batch.tables[channel] = after_restart(decode_all(kind, name, np.frombuffer(b"".join(same), np.uint8).reshape(len(same), -1)))
        batch.restarted = self.restarted(batch)
        return batch

    def restarted(self, batch: Batch) -> bool:
        begun = any(not run.finished for run in batch.singles.get("REED_RUN", []))
        if CLOCK in batch.tables:
            cycles = batch.tables[CLOCK]["cycle"]
            begun = begun or cycles[0] <= self.last_cycle
            self.last_cycle = int(cycles[-1])
        return begun


def after_restart(table: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Without the rows before the cycle number went back."""
    back = np.flatnonzero(np.diff(table["cycle"]) < 0)
    return table if not len(back) else {name: values[back[-1] + 1:] for name, values in table.items()}


def whole(recording: Recording) -> Batch:
    return Batch({channel: table for channel, table in recording.tables.items() if len(table["cycle"])}, recording.singles)


def until(recording: Recording, utime: int) -> Batch:
    """The newest message of every table up to a time, and all singles up to it."""
    batch = Batch()
    for channel, table in whole(recording).tables.items():
        row = int(np.searchsorted(table["utime"], utime, side="right")) - 1
        if row >= 0:
            batch.tables[channel] = {name: values[row:row + 1] for name, values in table.items()}
    for channel, messages in recording.singles.items():
        batch.singles[channel] = [message for message in messages if message.utime <= utime]
    return batch
