"""Where two tapes differ, signal by signal, by their bits: NaN equals NaN, and -0 is not 0."""

from dataclasses import dataclass

import numpy as np

from reed_tools.record.tape import Field, Tape

EVENTS, SENT, LENGTH = "events", "sent frames", "number of cycles"


@dataclass(frozen=True)
class Difference:
    signal: str
    cycle: int        # the first in which it differs
    before: str       # bits there, in hex
    after: str
    value_before: float | None = None
    value_after: float | None = None
    largest: float | None = None  # over all cycles; None where it is no number

    def in_words(self, first: str, second: str) -> str:
        def side(bits: str, value: float | None) -> str:
            return bits if value is None else f"{bits} ({value:.9g})"
        return (f"cycle {self.cycle}, {self.signal}: {first} {side(self.before, self.value_before)}, "
                f"{second} {side(self.after, self.value_after)}")


def first(before: Tape, after: Tape, length: int | None = None) -> Difference | None:
    """The earliest cycle, in it the signal that comes first in the tape. `length`: cycles that both should have."""
    found = every(before, after, length)
    return min(found, key=lambda one: one.cycle, default=None)  # stable: signals are in the order of the messages


def every(before: Tape, after: Tape, length: int | None = None) -> list[Difference]:
    """One per signal that both tapes have and that differs. `length`: as many cycles of each, else all."""
    want_before, want_after = (length, length) if length is not None else (len(before), len(after))
    both = min(len(before), len(after), want_before, want_after)
    found = []
    if not same_rows(before, after, both):
        of_after = {field.name: field for field in after.header.fields}
        for field in before.header.fields:
            if field.output and of_after.get(field.name) == field:
                found += of_field(field, before.rows[field.name][:both], after.rows[field.name][:both])
    if before.rest[:both] != after.rest[:both]:
        found += [one for one in (of_events(before, after, both), of_sent(before, after, both)) if one]
    shorter = min(len(before), want_before), min(len(after), want_after)
    if shorter[0] != shorter[1]:
        found.append(Difference(LENGTH, both, hex(shorter[0]), hex(shorter[1]), shorter[0], shorter[1], abs(shorter[0] - shorter[1])))
    return found


def same_rows(before: Tape, after: Tape, both: int) -> bool:
    """Quick where everything is the same, inputs too, as in a replay."""
    return before.header.fields == after.header.fields and np.array_equal(before.row_bytes[:both], after.row_bytes[:both])


def of_field(field: Field, before: np.ndarray, after: np.ndarray) -> list[Difference]:
    bits = f"u{field.type[1]}"
    raw_before, raw_after = np.ascontiguousarray(before).view(bits), np.ascontiguousarray(after).view(bits)
    differs = raw_before != raw_after
    found = []
    for k in np.flatnonzero(differs.any(axis=0)):
        cycle = int(np.argmax(differs[:, k]))
        with np.errstate(invalid="ignore", over="ignore"):
            apart = np.abs(after[:, k].astype(float) - before[:, k].astype(float))[differs[:, k]]
        width = 2 * int(field.type[1])
        found.append(Difference(field.signal(int(k)), cycle, f"0x{int(raw_before[cycle, k]):0{width}x}", f"0x{int(raw_after[cycle, k]):0{width}x}",
                                float(before[cycle, k]), float(after[cycle, k]), float(np.nanmax(apart)) if np.isfinite(apart).any() else None))
    return found


def of_events(before: Tape, after: Tape, both: int) -> Difference | None:
    for k in range(both):
        if (one := before.events(k)) != (other := after.events(k)) and repr(one) != repr(other):  # NaN has one text
            return Difference(EVENTS, k, in_short(one), in_short(other))
    return None


def of_sent(before: Tape, after: Tape, both: int) -> Difference | None:
    for k in range(both):
        if before.rest[k] != after.rest[k] and (one := before.sent(k)) != (other := after.sent(k)):
            pairs = [(a, b) for a, b in zip(one, other) if a != b] or [(None, None)]
            return Difference(SENT, k, *(f"0x{part[1].hex()} of identifier {part[0]:#x}" if part else "one frame less" for part in pairs[0]))
    return None


def in_short(events: list[tuple]) -> str:
    return ", ".join(f"{code} (joint {joint + 1}: {value:g})" if joint >= 0 else f"{code} ({value:g})" for code, joint, value in events) or "none"
