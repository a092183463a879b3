"""A run's or a campaign's figures by name, and those that differ between several."""

from dataclasses import dataclass
from typing import Any

from reed_tools.show.tables import number

NEVER_SAME = ("wall_s", "timing_us", "host_pause", "scheduler", "memory_locked",
              "loop.page_faults", "command")  # differ from one lockstep run to its repetition
LONGEST_WORD = 24
SUMMARY = ("verdict", "cause", "digest", "versions", "machine")
RESULTS = ("clock", "cycles", "missed_cycles", "overruns", "wall_s", "sim_s", "bus", "loop", "timing_us", "host_pause")


@dataclass(frozen=True)
class Difference:
    figure: str
    values: list[Any]


def flat(value: Any, name: str) -> dict[str, Any]:
    """Tables by their keys, lists of tables by their names or numbers; other lists stay whole."""
    if isinstance(value, dict):
        return {key: leaf for part, inner in value.items() for key, leaf in flat(inner, f"{name}.{part}" if name else part).items()}
    if isinstance(value, list) and value and all(isinstance(entry, dict) for entry in value):
        return {key: leaf for number, entry in enumerate(value) for key, leaf in flat(entry, f"{name}.{entry.get('name', number)}").items()}
    return {name: value}


def of_run(summary: dict, effective: dict) -> dict[str, Any]:
    """Verdict and versions, configuration, checks, errors by second, parameters, then loop, bus and clock."""
    found = {key: leaf for name in SUMMARY for key, leaf in flat(summary[name], name).items()}
    found |= flat({key: value for key, value in effective.items() if key != "checks"}, "config")
    for check in summary["checks"]:
        found |= {f"checks.{check['name']}": check["value"], f"checks.{check['name']}.limit": check["limit"]}
    for window in summary["windows"]:
        second = f"second {round(window['from_s']) + 1}"  # also one that was cut short
        found |= {f"{second}: {name}": value for name, value in window.items() if name not in ("from_s", "to_s")}
    known = summary["parameters"]
    found |= {f"parameters.{name}.final": value for name, value in zip(known["names"], known["final"] or [])}
    found |= {key: leaf for name in RESULTS for key, leaf in flat(summary[name], name).items()}
    return found


def of_campaign(summary: dict) -> dict[str, Any]:
    kept = {key: value for key, value in summary.items() if key not in ("worst", "schema", "repeated", "different")}
    return flat(kept, "")


def differences(figures: list[dict[str, Any]], repeatable: bool) -> list[Difference]:
    """In the order of the first that has the figure. `repeatable`: without what no repetition of a run would keep."""
    names = list(dict.fromkeys(name for each in figures for name in each))
    found = (Difference(name, [each.get(name) for each in figures]) for name in names)
    return [entry for entry in found if any(value != entry.values[0] for value in entry.values)
            and not (repeatable and entry.figure.startswith(NEVER_SAME))]


def in_short(value: Any) -> str:
    """For a table: hashes and sentences are cut, --json has them whole."""
    if isinstance(value, list):
        return "[" + ", ".join(map(in_short, value)) + "]"
    if value is None or isinstance(value, (int, float)) and not isinstance(value, bool):
        return number(value)
    text = str(value)
    return text if len(text) <= LONGEST_WORD or " " in text else text[:LONGEST_WORD - 1] + "…"
