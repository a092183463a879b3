"""reed_replay, the controller's own code with a tape as its world, started on a tape."""

import os
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from reed_tools.errors import RunError, UsageError
from reed_tools.law import choice as law_choice
from reed_tools.paths import program
from reed_tools.record.tape import Tape, read


@dataclass
class Changes:
    """What a what-if asks for; nothing: a replay of the run as it was."""

    entries: list[str] = field(default_factory=list)  # of --set
    arm: str | None = None
    law: str | None = None

    def any(self) -> bool:
        return bool(self.entries or self.arm or self.law)


def law_of(tape: Tape, changes: Changes) -> law_choice.Law:
    """The one that is asked for, else the one that the run had from outside."""
    recorded = tape.header.values.get("law_library", "")
    wanted = changes.law or law_choice.in_words(recorded)
    if not changes.law and wanted and not law_choice.file_of(wanted).is_file():
        raise UsageError(f"{tape.path}: the run's law {wanted} is not there any more; --law names where it is now")
    return law_choice.choose(wanted, "lockstep")  # nothing waits for a replay, so that Python is quick enough


def replay(tape: Tape, changes: Changes, scratch: Path, replayer: Path | None = None) -> Tape:
    """What the controller does now, as a tape. `replayer`: another version's program."""
    config, out = scratch / "controller.toml", scratch / "replayed.tape"
    config.write_text(tape.header.config, encoding="utf-8")
    law = law_of(tape, changes)
    command = [str(replayer or program("reed_replay")), "--tape", str(tape.path), "--config", str(config), "--out", str(out)]
    command += ["--arm", changes.arm] if changes.arm else []
    command += ["--law", law.spec] if law.spec else []
    for entry in changes.entries:
        command += ["--set", entry]
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", env={**os.environ, **law.environment})
    message = law_choice.in_words(done.stderr.strip())
    if done.returncode == 2:
        raise UsageError(message.replace(str(config), str(tape.path)))
    if done.returncode:
        raise RunError(message or f"reed_replay was ended by signal {-done.returncode}")
    return read(out)
