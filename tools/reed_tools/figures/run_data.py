"""What the figures of the checks are computed from, and why one of them may not exist."""

from dataclasses import dataclass

import numpy as np

from reed_tools.record.signals import ACTIVE, Signals
from reed_tools.record.telemetry_log import Recording

CONTACT_N = 0.01         # true normal force that counts as contact


class NoFigure(Exception):
    """The run did not get far enough for a figure; the text says what is missing."""


@dataclass
class RunData:
    recording: Recording
    joined: Signals | None
    rate_hz: float
    torque_limits: list[float]
    boxes: list[tuple[float, float]]
    sigma_limits: tuple[float, float] = (1.0, 1.0)
    duration_s: float = 0.0

    @property
    def signals(self) -> Signals:
        if self.joined is None:
            raise NoFigure("no cycle of an active arm was recorded by both programs" if self.active_cycles() else "the arm was never active")
        return self.joined

    def active_cycles(self) -> int:
        """From the first to the last one that the controller recorded, with those between that it did not."""
        control = self.recording.tables["REED_CONTROL"]
        active = control["cycle"][control["mode"] == ACTIVE]
        return int(active.max() - active.min() + 1) if len(active) else 0

    def complete_cycles(self) -> int:
        """Of these, those that both programs recorded."""
        return len(self.joined.t) if self.joined is not None else 0

    def last_second(self) -> np.ndarray:
        """Rows of the last second of the active arm, not of the last second that happens to be recorded."""
        signals = self.signals
        control = self.recording.tables["REED_CONTROL"]
        last = control["cycle"][control["mode"] == ACTIVE].max()
        rows = signals.cycle > last - self.rate_hz
        if rows.sum() < 0.5 * min(self.rate_hz, self.active_cycles()):
            raise NoFigure("the last second was not recorded by both programs")
        return rows

    def first_contact(self) -> int:
        touching = np.flatnonzero(self.signals.force_true > CONTACT_N)
        if not len(touching):
            raise NoFigure("contact was never made")
        return int(touching[0])

    def end_of_run(self):
        if self.recording.finished_run is None:
            raise NoFigure("the firmware did not report its end")
        return self.recording.finished_run

    def last(self, channel: str, field: str) -> int:
        values = self.recording.tables[channel][field]
        if not len(values):
            raise NoFigure(f"no {channel} was recorded")
        return int(values[-1])

    def bus(self):
        if not self.recording.singles["REED_BUS"]:
            raise NoFigure("no bus counters were recorded")
        return self.recording.singles["REED_BUS"][-1]
