"""run.json: what a run folder could not say by itself: the line that repeats the run, what ran, and on which machine."""

import json
import shlex
from pathlib import Path

from reed_tools import versions
from reed_tools.law import choice as law_choice
from reed_tools.record import machine, run_folder
from reed_tools.record.whole_file import write_text
from reed_tools.run import plans

OPTIONS = ("arm", "law", "duration", "rate", "seed", "bus", "clock")
FILES = ("arm", "law")


def command(arguments) -> str:
    """From the repository's root; files by their full path."""
    words = ["tools/reed", "run", located(arguments.scenario)]
    for name in OPTIONS:
        if (value := getattr(arguments, name)) is not None:
            words += [f"--{name}", located(value) if name in FILES else str(value)]
    for entry in arguments.set:
        words += ["--set", entry]
    return shlex.join(words)


def located(name: str) -> str:
    """A library may have an argument behind a colon."""
    file, colon, argument = name.partition(":")
    return f"{Path(file).resolve()}{colon}{argument}" if Path(file).is_file() else name


def write(folder: Path, arguments) -> dict:
    """What it wrote."""
    ran = versions.all_of_them(plans.names(arguments.bus).values(), law_choice.file_of(arguments.law))
    origin = {"command": command(arguments), "versions": ran, "machine": machine.description()}
    write_text(folder / run_folder.ORIGIN, json.dumps(origin, indent=2) + "\n")
    return origin
