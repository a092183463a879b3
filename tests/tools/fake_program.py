"""Stands in for reed_firmware, reed_plant_sim and reed_one_process: same options, same exit statuses, synthetic logs. What it does
comes from REED_FAKE_FIRMWARE, REED_FAKE_PLANT, REED_FAKE_ONE_PROCESS: ok (default), complain, refuse, die, endless or late (a plant)."""

import argparse
import ctypes
import os
import resource
import signal
import sys
import time
from pathlib import Path

import synthetic_run


def main() -> int:
    name = {"reed_plant_sim": "plant", "reed_firmware": "firmware"}.get(Path(sys.argv[0]).name, "one_process")
    behaviour = os.environ.get(f"REED_FAKE_{name.upper()}", "ok")
    parser = argparse.ArgumentParser()
    for option in ("--config", "--bus", "--clock", "--log", "--plant-log", "--candump", "--tape", "--tape-commit"):
        parser.add_argument(option)
    parser.add_argument("--enable", action="store_true")
    parser.add_argument("--no-lcm", action="store_true")
    parser.add_argument("--host-pause", action="store_true")
    parser.add_argument("--leave-memory-unlocked", action="store_true")
    parser.add_argument("--set", action="append")
    options = parser.parse_args()
    ctypes.CDLL(None).prctl(1, 0)  # as the kernel does for a program with file capabilities: no signal when its parent ends
    stopped = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: stopped.append(True))
    for ending, content in (("pid", str(os.getpid())), ("stack", str(resource.getrlimit(resource.RLIMIT_STACK)[0])),
                            ("options", " ".join(sys.argv[1:]))):
        (Path(options.log).parent / f"{name}.{ending}").write_bytes(os.fsencode(content))
    if behaviour == "refuse":
        print("arm.dh: 9 joints, at most 8 are allowed", file=sys.stderr)
        return 2
    if behaviour == "complain":
        print(f"{Path(sys.argv[0]).name}: SCHED_FIFO 80 not granted; fix: rtprio 80", file=sys.stderr)
    if behaviour == "late":
        time.sleep(0.5)
    if name == "plant":
        print("synthetic arm: waiting for SYNC", flush=True)
    if name == "firmware":
        (Path(options.log).parent / "plant_had_said").write_text((Path(options.log).parent / "plant.txt").read_text())
        hear_the_plant(Path(options.log).parent)
    for log in filter(None, (options.log, options.plant_log)):
        write_own_log(Path(log), "wall" if options.clock in ("realtime", "wall") else "lockstep")
    if behaviour == "die":
        print("bus lost: vcan0 went away", file=sys.stderr)
        return 3
    if name == "plant" or behaviour == "endless":
        while not stopped:
            time.sleep(0.02)
        with open(Path(options.log).parent / "stopped", "a") as file:
            file.write(name + "\n")
    return 0


def hear_the_plant(folder: Path, patience_s: float = 20.0) -> None:
    """A controller's run needs the plant's answers: it cannot end before a plant is up and can be asked to stop."""
    end = time.monotonic() + patience_s
    while os.environ.get("REED_FAKE_PLANT") != "refuse" and not (folder / "plant.lcmlog").exists() and time.monotonic() < end:
        time.sleep(0.01)


def write_own_log(path: Path, clock: str) -> None:
    scratch = synthetic_run.write(path.parent / f"scratch-{path.stem}", [], duration_s=1.0, clock=clock)
    (scratch / path.name).rename(path)


if __name__ == "__main__":
    sys.exit(main())
