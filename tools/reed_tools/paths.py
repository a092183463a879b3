"""Where things are: the repository, the build directory, the programs."""

import os
import subprocess
import sys
from pathlib import Path

from reed_tools.errors import RunError

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("REED_BUILD_DIR", ROOT / "build" / "release")).resolve()
SCENARIOS = ROOT / "config" / "scenarios"
ARMS = ROOT / "config" / "arms"
PYTHON = (sys.executable, "-I", "-X", "utf8")  # the caller's environment does not reach it

CURRENT_RUN = ROOT / "build" / "current-run"  # the folder of the run that was started last: for who watches it


def program(name: str) -> Path:
    path = BUILD / "bin" / name
    if not path.exists():
        raise RunError(f"{name} is not built: {path} is missing; `ninja -C {BUILD} {name}` builds it")
    return path


def build(*targets: str) -> None:
    """Built where they are not; silent when there is nothing to do."""
    done = subprocess.run(["ninja", "-C", str(BUILD), *targets], capture_output=True, text=True)
    if done.returncode:
        raise RunError(f"{' '.join(targets)} did not build: {done.stdout[-300:]}")


def use_message_types() -> None:
    """Makes `import reed` find the LCM types that the build generated from lcmtypes/."""
    types = BUILD / "lcmtypes" / "python"
    if not (types / "reed").is_dir():
        raise RunError(f"the LCM message types are not built: {types} is missing")
    if str(types) not in sys.path:
        sys.path.insert(0, str(types))
