"""config/faults/*.toml: the faults to inject, without what starts them."""

import tomllib
from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.paths import ROOT
from reed_tools.text import did_you_mean

FAULTS = ROOT / "config" / "faults"
STANDARD = FAULTS / "standard.toml"
TRIGGERS = ("from_s", "from_cycle", "from_mode", "from_event", "signal", "edge", "level", "for_s", "delay_s")


def load(path: Path) -> list[dict]:
    """Each with at least id, target and kind; the reader of scenarios checks the rest."""
    try:
        entries = tomllib.loads(path.read_text(encoding="utf-8")).get("fault")
    except OSError as error:
        raise UsageError(f"--faults {path}: {(error.strerror or str(error)).lower()}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise UsageError(f"--faults {path}: not TOML: {error}") from None
    if not isinstance(entries, list) or not entries or not all(isinstance(entry, dict) for entry in entries):
        raise UsageError(f"--faults {path}: has no [[fault]]")
    for number, entry in enumerate(entries):
        missing = [key for key in ("id", "target", "kind") if not isinstance(entry.get(key), str)]
        if missing:
            raise UsageError(f"--faults {path}: fault[{number}].{missing[0]}: missing; a text")
        set_here = [key for key in TRIGGERS if key in entry]
        if set_here:
            raise UsageError(f"--faults {path}: fault[{number}].{set_here[0]}: the phase starts it; leave it out")
    names = [entry["id"] for entry in entries]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice:
        raise UsageError(f"--faults {path}: the id '{twice}' is there twice")
    return entries


def chosen(entries: list[dict], names: list[str] | None) -> list[dict]:
    known = [entry["id"] for entry in entries]
    for name in names or []:
        if name not in known:
            raise UsageError(f"--only {name}: no such fault{did_you_mean(name, known)}; there are: {', '.join(known)}")
    return [entry for entry in entries if not names or entry["id"] in names]


def as_override(entries: list[dict]) -> str:
    """As `--set` takes it."""
    return "fault=[" + ",".join("{" + ",".join(f"{key}={text_of(value)}" for key, value in entry.items()) + "}" for entry in entries) + "]"


def text_of(value) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f'"{value}"' if isinstance(value, str) else repr(value)
