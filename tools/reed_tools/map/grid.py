"""The grids that are run: one or two axes, each a key of the configuration with its values."""

import re
from dataclasses import dataclass

from reed_tools.errors import UsageError

MOST_VALUES = 100
AXIS = re.compile(r"([A-Za-z_.0-9]+)=([^:]+):([^:]+):(\d+)")
UNITS = {"link.command_delay_s": "s", "link.measurement_delay_s": "s", "link.command_jitter_s": "s", "link.measurement_jitter_s": "s",
         "link.command_loss": "1", "link.measurement_loss": "1", "timing.rate_hz": "Hz"}
RATES_HZ = (250.0, 500.0, 1000.0, 2000.0, 4000.0)


@dataclass(frozen=True)
class Axis:
    key: str
    values: tuple[float, ...]

    @property
    def unit(self) -> str:
        return UNITS.get(self.key, "")

    def entry(self, k: int) -> str:
        return f"{self.key}={self.values[k]:.6g}"


@dataclass(frozen=True)
class Grid:
    name: str
    axes: tuple[Axis, ...]
    fixed: tuple[str, ...] = ()  # KEY=VALUE, the same in every run

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(len(axis.values) for axis in self.axes)

    def entries(self, place: tuple[int, ...]) -> list[str]:
        return [*self.fixed, *(axis.entry(k) for axis, k in zip(self.axes, place))]


def even(key: str, low: float, high: float, steps: int) -> Axis:
    return Axis(key, tuple(low + (high - low) * k / (steps - 1) for k in range(steps)) if steps > 1 else (low,))


def standard(steps: int) -> dict[str, Grid]:
    """By name. Without a wire in time: delays are beside lockstep's own, and a rate is free of what a wire carries."""
    def both(name: str, quantity: str, most: float) -> Grid:
        return Grid(name, (even(f"link.command_{quantity}", 0.0, most, steps), even(f"link.measurement_{quantity}", 0.0, most, steps)))

    rate = Grid("rate", (Axis("timing.rate_hz", RATES_HZ), even("link.command_delay_s", 0.0, 0.005, steps)), ("scenario.allow_wire_overload=true",))
    return {"delay": both("delay", "delay_s", 0.005), "jitter": both("jitter", "jitter_s", 0.005), "loss": both("loss", "loss", 0.5), "rate": rate}


def own(words: list[str]) -> Grid:
    """--axis KEY=FROM:TO:N, once or twice."""
    if len(words) > 2:
        raise UsageError("--axis: once or twice, a map has no more")
    return Grid("own", tuple(axis_of(word) for word in words))


def axis_of(word: str) -> Axis:
    found = AXIS.fullmatch(word)
    try:
        low, high, count = float(found[2]), float(found[3]), int(found[4])
    except (TypeError, ValueError):
        raise UsageError(f"--axis {word}: expected SECTION.KEY=FROM:TO:N, as in link.command_delay_s=0:0.01:11") from None
    if not 2 <= count <= MOST_VALUES or not abs(high) < 1e12 or not low < high:
        raise UsageError(f"--axis {word}: allowed: FROM below TO, and N from 2 to {MOST_VALUES}")
    return even(found[1], low, high, count)
