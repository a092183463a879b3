"""What --law names: a shared library with the functions of reed/law.h, or a Python file."""

import os
import sys
from dataclasses import dataclass, field
from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.paths import BUILD, build

SERVER = Path(__file__).with_name("server.py")
PYTHON_LAW = BUILD / "lib" / "libreed_python_law.so"


@dataclass
class Law:
    """For the firmware: the value of its --law, "" for the scenario's own, and what its environment needs."""

    spec: str = ""
    environment: dict[str, str] = field(default_factory=dict)


def in_words(line: str | None) -> str | None:
    """A program's line about a law, with the user's file instead of what runs it."""
    return line and line.replace(f"{PYTHON_LAW}:", "")


def file_of(wanted: str | None) -> Path | None:
    """Without the argument that a library may have behind a colon."""
    return Path(wanted.partition(":")[0]) if wanted else None


def choose(wanted: str | None, clock: str) -> Law:
    path = file_of(wanted)
    if path is None:
        return Law()
    if not path.is_file():
        raise UsageError(f"--law {wanted}: there is no file {path}; allowed: LIB.so[:ARGUMENT] or FILE.py")
    if path.suffix != ".py":
        return Law(os.path.abspath(path) + wanted[len(str(path)):] if wanted.startswith(str(path)) else os.path.abspath(path))
    if clock != "lockstep":
        raise UsageError(f"--law {wanted}: Python cannot keep a deadline; use it with --clock lockstep")
    build("reed_python_law")
    return Law(f"{PYTHON_LAW}:{path.resolve()}", {"REED_LAW_PYTHON": sys.executable, "REED_LAW_SERVER": str(SERVER)})
