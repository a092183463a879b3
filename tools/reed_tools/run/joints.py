"""The controller is compiled for each number of joints on its own; a run compiles the number that it needs and no other."""

import fcntl
import re
import subprocess
import sys
import time

from reed_tools.errors import RunError
from reed_tools.paths import BUILD, ROOT, build

POSSIBLE = range(2, 9)


def built() -> set[int]:
    """Numbers of joints that the build directory is configured for."""
    cache = BUILD / "CMakeCache.txt"
    found = re.search(r"^REED_JOINTS:\w+=(.*)$", cache.read_text(errors="replace"), re.M) if cache.exists() else None
    return {int(number) for number in found.group(1).split(";") if number} if found else set(POSSIBLE)


def need(number: int, target: str = "reed_firmware") -> None:
    """Builds the program for this number of joints where that is missing; an impossible number is the firmware's to refuse."""
    if number not in POSSIBLE or number in built():
        return
    with open(ROOT / "build" / ".bootstrap.lock", "a") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # two runs at once: one builds, the other waits
        if number in built():
            return
        print(f"  building the controller for {number} joints ", end="", file=sys.stderr, flush=True)
        started = time.monotonic()
        wanted = ";".join(map(str, sorted(built() | {number})))
        done = subprocess.run(["cmake", "-S", str(ROOT), "-B", str(BUILD), f"-DREED_JOINTS={wanted}"], capture_output=True, text=True)
        if done.returncode:
            raise RunError(f"the controller for {number} joints could not be configured: {done.stderr.strip()[-300:]}")
        build(target)
        print(f"{time.monotonic() - started:6.1f} s", file=sys.stderr, flush=True)
