"""config/campaigns/*.toml: which scenario, what every draw sets, what it draws, and what all draws together must hold.

A draw is its list of overrides, and follows from (campaign seed, index) alone: any machine can run any part of a campaign."""

import hashlib
import math
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.figures import checks
from reed_tools.paths import ROOT
from reed_tools.text import did_you_mean, plain

CAMPAIGNS = ROOT / "config" / "campaigns"
DISTRIBUTIONS = ("uniform", "log_uniform", "integer", "choice")
SECTIONS = {"campaign": {"name", "description", "scenario", "draws", "seed"},
            "limits": {"stable_percent", "within_percent", "worst_ratio"}, "stable": set(checks.FIGURES)}
LIMITS = {"stable_percent": 100.0, "within_percent": 95.0, "worst_ratio": 2.0}
MOST_DRAWS = 1_000_000
LARGEST = 2**53  # every whole number up to here is a double too
SIGNIFICANT_DIGITS = 6  # a drawn number is what its text says: the command line that repeats it is exact


@dataclass(frozen=True)
class Drawn:
    """One [[draw]]: where a number goes and how it is distributed."""

    key: str
    distribution: str
    support: list
    times: float | list | None = None  # what the drawn factor multiplies; a list: each entry has a factor of its own

    def value(self, seed: int, index: int):
        if isinstance(self.times, list):
            return [self.factor(seed, index, entry) * base for entry, base in enumerate(self.times)]
        factor = self.factor(seed, index, 0)
        return factor if self.times is None else factor * self.times

    def factor(self, seed: int, index: int, entry: int):
        return self.at(unit_number(f"{seed}/{index}/{self.key}/{entry}"))

    def at(self, u: float):
        """The factor at a share u of the distribution, 0 to 1."""
        if self.distribution == "choice":
            return self.support[min(int(u * len(self.support)), len(self.support) - 1)]
        low, high = self.support
        if self.distribution == "integer":
            return min(low + int(u * (high - low + 1)), high)
        if self.distribution == "log_uniform":
            return math.exp(math.log(low) + u * (math.log(high) - math.log(low)))
        return low + u * (high - low)


@dataclass(frozen=True)
class Campaign:
    name: str
    description: str
    scenario: str
    draws: int
    seed: int
    limits: dict
    stable: list[dict]          # {name, limit} of figures that a stable draw keeps beside running to its end
    fixed: tuple[str, ...]      # KEY=VALUE, the same in every draw
    drawn: tuple[Drawn, ...]
    text: str                   # of the file

    def values(self, index: int) -> dict:
        """What draw `index` has drawn, by key."""
        return {drawn.key: drawn.value(self.seed, index) for drawn in self.drawn}

    def overrides(self, index: int) -> list[str]:
        return [*self.fixed, *(f"{key}={text_of(value)}" for key, value in self.values(index).items())]

    def definition(self) -> str:
        """Equal for campaigns whose draws of equal index have equal records."""
        content = [self.scenario, str(self.seed), repr(self.stable), *self.fixed, *map(repr, self.drawn)]
        return hashlib.sha256("\n".join(content).encode()).hexdigest()


def unit_number(label: str) -> float:
    """[0, 1), 53 bits. A hash and no generator: a number more in the file leaves all others as they were."""
    return (int.from_bytes(hashlib.sha256(label.encode()).digest()[:8], "big") >> 11) / 2.0**53


def text_of(value) -> str:
    """As an override: what TOML reads."""
    if isinstance(value, list):
        return "[" + ",".join(text_of(entry) for entry in value) + "]"
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:.{SIGNIFICANT_DIGITS}g}" if isinstance(value, float) else str(value)


def find(name_or_path: str) -> Path:
    path = CAMPAIGNS / f"{name_or_path}.toml"
    if "/" in name_or_path or name_or_path.endswith(".toml"):
        path = Path(name_or_path)
    if not path.is_file():
        names = sorted(file.stem for file in CAMPAIGNS.glob("*.toml"))
        raise UsageError(f"campaign {name_or_path}: {path} is not there{did_you_mean(name_or_path, names)}; "
                         f"config/campaigns has: {', '.join(names)}")
    return path


def load(path: Path, seed: int | None = None, extra: tuple[str, ...] = ()) -> Campaign:
    """`seed` and `extra` (KEY=VALUE) come from the command line and win over the file."""
    try:
        text = path.read_text(encoding="utf-8")
        tree = tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # no UTF-8, no TOML, numbers of thousands of digits, brackets without end
        raise UsageError(f"{path}: not TOML: {error}") from None
    for section, content in tree.items():
        if section not in (*SECTIONS, "set", "draw"):
            raise UsageError(f"{path}: {section}: unknown section; allowed: campaign, limits, stable, set, draw")
        tables = content if section == "draw" else [content]
        if not isinstance(tables, list) or not all(isinstance(table, dict) for table in tables):
            raise UsageError(f"{path}: {section}: expected {'[[draw]] tables' if section == 'draw' else f'a table [{section}]'}")
    for section, keys in SECTIONS.items():
        for key in tree.get(section, {}):
            if key not in keys:
                raise UsageError(f"{path}: {section}.{key}: unknown key{did_you_mean(key, keys)}; allowed: {', '.join(sorted(keys))}")
    head = tree.get("campaign", {})
    for key in ("name", "scenario", "draws"):
        if key not in head:
            raise UsageError(f"{path}: campaign.{key}: missing")
    listed = [read_drawn(path, entry, position) for position, entry in enumerate(tree.get("draw", []))]
    given = {entry.partition("=")[0] for entry in extra}
    fixed = [f"{key}={text_of(setting(path, key, value))}" for key, value in tree.get("set", {}).items()]
    return Campaign(name(path, "campaign.name", head["name"]), name(path, "campaign.description", head.get("description", ""), keep="\n\t"),
                    name(path, "campaign.scenario", head["scenario"]),
                    whole(path, "campaign.draws", head["draws"], 1, MOST_DRAWS),
                    whole(path, "campaign.seed", head.get("seed", 1) if seed is None else seed, 0),
                    {key: number(path, f"limits.{key}", tree.get("limits", {}).get(key, standard))
                     for key, standard in LIMITS.items()},
                    [{"name": key, "limit": number(path, f"stable.{key}", limit)} for key, limit in tree.get("stable", {}).items()],
                    (*fixed, *extra), tuple(drawn for drawn in listed if drawn.key not in given), text)


def name(path: Path, key: str, value, keep: str = "") -> str:
    """Text that can be shown on terminals, in pages and in XML; a description may have lines."""
    if not isinstance(value, str) or plain(value, keep) != value:
        raise UsageError(f"{path}: {key} = {value!r}: expected text without control characters{'' if keep else ', on one line'}")
    return value


def setting(path: Path, key: str, value):
    if isinstance(value, dict):
        raise UsageError(f"{path}: set.{key}: expected a value; a key with dots needs quotes, like \"wall.friction\" = 0.2")
    return value


def whole(path: Path, key: str, value, least: int, most: int = LARGEST) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
        raise UsageError(f"{path}: {key} = {value}: allowed: a whole number from {least} to {most}")
    return value


def number(path: Path, key: str, value) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) <= sys.float_info.max:
        raise UsageError(f"{path}: {key} = {value}: expected a number")
    return value


def read_drawn(path: Path, entry: dict, position: int) -> Drawn:
    where = f"{path}: draw[{position}]"
    for key in entry:
        if key not in ("key", "times", *DISTRIBUTIONS):
            raise UsageError(f"{where}.{key}: unknown key; allowed: key, times, {', '.join(DISTRIBUTIONS)}")
    kinds = [kind for kind in DISTRIBUTIONS if kind in entry]
    if not isinstance(entry.get("key"), str) or len(kinds) != 1:
        raise UsageError(f"{where}: needs a key and one of {', '.join(DISTRIBUTIONS)}")
    kind, support, times = kinds[0], entry[kinds[0]], entry.get("times")
    if not isinstance(support, list) or not support:
        raise UsageError(f"{where}.{kind}: expected a list")
    if kind != "choice":
        low, high = [number(path, f"draw[{position}].{kind}", value) for value in (support if len(support) == 2 else (None, None))]
        if not low < high or (kind == "log_uniform" and low <= 0):
            raise UsageError(f"{where}.{kind} = {support}: allowed: [low, high] with {'0 < ' if kind == 'log_uniform' else ''}low < high")
        if kind == "integer":
            support = [whole(path, f"draw[{position}].integer", value, -LARGEST) for value in support]
    for base in times if isinstance(times, list) else [] if times is None else [times]:
        number(path, f"draw[{position}].times", base)
    if times is not None and kind == "choice" and not all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in support):
        raise UsageError(f"{where}.times: multiplies numbers, and the choice has others")
    return Drawn(entry["key"], kind, support, times)
