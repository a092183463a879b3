"""The programs that tools/reed bench runs: building those that nothing else needs, starting them, reading their lines."""

import importlib.util
import json
import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from reed_tools.errors import RunError
from reed_tools.paths import BUILD, ROOT, program

BUS_GROUP = "239.74.163.2"
WRITES_LAST = 300


def build(*targets: str) -> None:
    """Says so first: some of them take minutes."""
    if "no work to do" in subprocess.run(["ninja", "-C", str(BUILD), "-n", *targets], capture_output=True, text=True, errors="replace").stdout:
        return
    print(f"  building {' '.join(targets)}", file=sys.stderr, flush=True)  # standard output may be --json
    done = subprocess.run(["ninja", "-C", str(BUILD), *targets], capture_output=True, text=True, errors="replace")
    if done.returncode:
        raise RunError(f"{' '.join(targets)} did not build: {done.stdout[-WRITES_LAST:]}")


def build_pinocchio() -> str | None:
    """The other side, against the headers and the library inside the Python package pin; a line if that is missing."""
    found = importlib.util.find_spec("pinocchio")
    prefix = Path(found.origin).parents[4] if found and found.origin else None
    if prefix is None or not (prefix / "include" / "pinocchio").is_dir():
        return "Pinocchio's C++ is missing, no comparison of steps: build/venv/bin/pip install pin==4.1.0"
    done = subprocess.run(["cmake", "-S", str(ROOT), "-B", str(BUILD), f"-DREED_PINOCCHIO={prefix}"], capture_output=True, text=True, errors="replace")
    if done.returncode:
        return f"Pinocchio's side was not configured: {done.stderr[-WRITES_LAST:]}"
    try:
        build("reed_bench_pinocchio")
    except RunError as error:
        return str(error)
    return None


def output(command: list[str]) -> str:
    done = subprocess.run(command, capture_output=True, text=True, errors="replace")
    if done.returncode:
        raise RunError(f"{Path(command[0]).name} ended with status {done.returncode}: {(done.stderr or done.stdout).strip()[-WRITES_LAST:]}")
    return done.stdout


def nanoseconds(name: str, processes: int, *arguments: str) -> dict[str, dict[str, float]]:
    """{stage: {best_ns, median_ns}} of a benchmark program, each the least of several fresh processes: one process can sit in a
    slow mode of the machine from beginning to end."""
    least: dict[str, dict[str, float]] = {}
    for _ in range(processes):
        for line in output([str(program(name)), *arguments]).splitlines():
            row = json.loads(line)
            stage = least.setdefault(row.pop("name"), row)
            stage.update({key: min(stage[key], value) for key, value in row.items()})
    return least


@dataclass
class BenchRun:
    """Both programs from start to end."""

    text: str              # what the firmware printed, with what `under` added
    wall_s: float          # of the firmware's process
    firmware_cpu_s: float
    plant_cpu_s: float
    log: Path

    @property
    def cycles(self) -> int:
        return int(self.text.split("done: ")[1].split()[0])


def run_programs(folder: Path, port: int, clock: str, *settings: str, under: tuple[str, ...] = (), plant: list[str] | None = None,
        scenario: str = "press_known") -> BenchRun:
    """The scenario by hand: no report, no LCM network, the telemetry log of the firmware in `folder`. `under`: what the firmware
    runs under; `plant`: another program at its other end."""
    common = ["--config", scenario, "--bus", f"udp:{BUS_GROUP}:{port}", "--clock", clock, "--no-lcm"]
    for setting in settings:
        common += ["--set", setting]
    log = folder / "firmware.lcmlog"
    arm = subprocess.Popen(plant or [str(program("reed_plant_sim")), *common, "--log", str(folder / "plant.lcmlog")],
                           stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    try:
        if "waiting for SYNC" not in arm.stdout.readline():
            raise RunError(f"the plant did not start: {' '.join(map(str, arm.args))}")
        cpu_before, started = os.times(), time.monotonic()
        pauses = ["--host-pause"] if clock == "realtime" else []
        firmware = subprocess.run([*under, str(program("reed_firmware")), *common, "--enable", "--log", str(log), *pauses],
                                  capture_output=True, text=True, errors="replace")
        wall_s, cpu_after = time.monotonic() - started, os.times()
    finally:
        arm.send_signal(signal.SIGINT)
        arm.communicate(timeout=20)
    plant_times = os.times()
    if firmware.returncode:
        raise RunError(f"reed_firmware ended with status {firmware.returncode}: {firmware.stderr.strip()[-WRITES_LAST:]}")
    spent = [after.children_user + after.children_system - before.children_user - before.children_system
             for before, after in ((cpu_before, cpu_after), (cpu_after, plant_times))]
    return BenchRun(firmware.stdout, wall_s, spent[0], spent[1], log)
