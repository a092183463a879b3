"""Digests that a commit keeps of what its controller does (config/gate/digests.toml): the next one is measured by them, and nothing is
built twice. The bits are those of every machine, so a digest means the same everywhere."""

import hashlib
import tomllib
from dataclasses import dataclass

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.gate.commits import git
from reed_tools.paths import ROOT
from reed_tools.record.tape import Tape
from reed_tools.record.whole_file import write_text

PATH = "config/gate/digests.toml"
DIGITS = 16
HEAD = """# What this commit's controller and simulated arm do: one digest per tape and scenario of corpus.toml, over the signals below, the
# events and the sent frames of every cycle. `tools/reed gate --write` makes this file; a commit that changes a digest says
# `changes-control: why` in its message.
"""


class Gone(Exception):
    """A signal that the digests are of is not on the tape."""


@dataclass(frozen=True)
class Kept:
    signals: tuple[str, ...]
    digests: dict[str, dict[str, str]]  # kind, name, digest

    def text(self) -> str:
        lines = [HEAD, "signals = [", *(f'  "{name}",' for name in self.signals), "]"]
        for kind, names in self.digests.items():
            lines += ["", f"[{kind}]", *(f'{name} = "{digest}"' for name, digest in sorted(names.items()))]
        return "\n".join(lines) + "\n"


def parse(text: str, where: str) -> Kept:
    try:
        found = tomllib.loads(text)
        return Kept(tuple(found["signals"]), {kind: dict(found[kind]) for kind in ("tape", "scenario")})
    except (KeyError, TypeError, ValueError) as error:
        raise UsageError(f"{where}: {error}; `tools/reed gate --write` makes it anew") from None


def of_checkout() -> Kept | None:
    path = ROOT / PATH
    return parse(path.read_text(encoding="utf-8"), str(path)) if path.is_file() else None


def of_commit(commit: str) -> Kept | None:
    done = git("show", f"{commit}:{PATH}")
    return parse(done.stdout, f"{commit[:12]}:{PATH}") if done.returncode == 0 else None


def of_tapes(tapes: dict[tuple[str, str], Tape]) -> Kept:
    """By kind and name. The signals are those that every tape has."""
    lists = [[field.name for field in tape.header.fields if field.output] for tape in tapes.values()]
    signals = tuple(name for name in lists[0] if all(name in other for other in lists))
    digests: dict[str, dict[str, str]] = {"tape": {}, "scenario": {}}
    for (kind, name), tape in tapes.items():
        digests[kind][name] = digest(tape, signals)
    return Kept(signals, digests)


def write(kept: Kept) -> None:
    write_text(ROOT / PATH, kept.text())


def digest(tape: Tape, signals: tuple[str, ...]) -> str:
    """Of bits. Signals that came later are no change; one that is gone cannot be compared."""
    total = hashlib.sha256(str(len(tape)).encode())
    for name in signals:
        if name not in tape.rows.dtype.fields:
            raise Gone(name)
        total.update(name.encode() + np.ascontiguousarray(tape.rows[name]).tobytes())
    for cycle in range(len(tape)):
        total.update(repr(tape.events(cycle)).encode() if tape.rows["num_events"][cycle, 0] else b"")
        for identifier, data in tape.sent(cycle):
            total.update(identifier.to_bytes(4, "little") + data)
    return total.hexdigest()[:DIGITS]


def differences(kept: Kept, tapes: dict[tuple[str, str], Tape]) -> tuple[list[tuple[str, str]], list[tuple[str, str]]]:
    """(kind, name) of the tapes whose digest is another one, and of those of which none is kept."""
    changed = [(kind, name) for (kind, name), tape in tapes.items()
               if (before := kept.digests[kind].get(name)) is not None and before != digest(tape, kept.signals)]
    return changed, [(kind, name) for kind, name in tapes if name not in kept.digests[kind]]
