"""Both sides of every comparison of tools/reed bench: fresh processes, the same core, alternating slices."""

import importlib.util
import json
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

from reed_tools.errors import RunError
from reed_tools.paths import BUILD, program

CYCLICTEST_LINE = re.compile(r"^(\d{6}) (\d{6,})", re.M)
LATE_US = 1000


def nanoseconds(stages, processes: int, prefix: str = "reed_bench_") -> dict[str, float]:
    """Best of several fresh processes, by the name each program prints."""
    best: dict[str, float] = {}
    for _ in range(processes):
        for stage in stages:
            for line in output([str(program(prefix + stage))]).splitlines():
                row = json.loads(line)
                best[row["name"]] = min(best.get(row["name"], float("inf")), row["best_ns"])
    return best


def pinocchio(processes: int) -> tuple[dict[str, float], list[str]]:
    """The other side is built against the headers and the library inside the Python package pin."""
    found = importlib.util.find_spec("pinocchio")
    prefix = Path(found.origin).parents[4] if found and found.origin else None
    if prefix is None or not (prefix / "include" / "pinocchio").is_dir():
        return {}, ["Pinocchio's C++ is missing, no comparison of steps: build/venv/bin/pip install pin==4.1.0"]
    for command in (["cmake", "-S", ".", "-B", str(BUILD), f"-DREED_PINOCCHIO={prefix}"],
                    ["ninja", "-C", str(BUILD), "reed_bench_pinocchio"]):
        done = subprocess.run(command, cwd=Path(__file__).parents[2], capture_output=True, text=True)
        if done.returncode:
            return {}, [f"Pinocchio's side did not build: {done.stdout[-300:]}"]
    return nanoseconds(("pinocchio",), processes), []


def wake_slices(seconds: int) -> tuple[dict, dict, list[str]]:
    """Two alternating slices each, on the same core at the same priority; the better one of each side."""
    core, anchored = "0", shutil.which("cyclictest") is not None
    ours, theirs = [], []
    for _ in range(2):
        ours.append(json.loads(output([str(program("reed_bench_wake")), str(seconds), core])))
        if anchored:
            theirs.append(cyclictest(seconds, core))
    note = [] if anchored else ["cyclictest is missing, wake-up latency has no anchor: sudo apt install rt-tests"]
    return least(ours), least(theirs) if theirs else {}, note


def least(slices: list[dict]) -> dict:
    return {key: min(one[key] for one in slices) if key != "late" else sum(one[key] for one in slices) for key in slices[0]}


def cyclictest(seconds: int, core: str) -> dict:
    text = output(["cyclictest", "-q", "-m", "-p80", "-t1", f"-a{core}", "-i1000", f"-l{1000 * seconds}", "-h5000"])
    bins = [(int(us), int(count)) for us, count in CYCLICTEST_LINE.findall(text)]
    total = sum(count for _, count in bins)
    if not total:
        raise RunError("cyclictest printed no histogram; it needs the right to SCHED_FIFO")
    return {"p50_us": quantile(bins, 0.5 * total), "p99_us": quantile(bins, 0.99 * total),
            "late": sum(count for us, count in bins if us >= LATE_US)}


def quantile(bins: list[tuple[int, int]], wanted: float) -> float:
    """cyclictest rounds down to whole microseconds; the middle of the bin is the fair guess."""
    seen = 0
    for us, count in bins:
        seen += count
        if seen >= wanted:
            return us + 0.5
    return float(bins[-1][0])


def lockstep_speed(folder: Path) -> float:
    """Simulated over real time of a whole run, both programs, on the software bus."""
    common = ["--config", "press_known", "--bus", "udp:239.74.163.2:46311", "--clock", "lockstep", "--no-lcm"]
    plant = subprocess.Popen([str(program("reed_plant_sim")), *common, "--log", str(folder / "plant.lcmlog")],
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        time.sleep(0.5)
        started = time.monotonic()
        text = output([str(program("reed_firmware")), *common, "--enable", "--log", str(folder / "firmware.lcmlog")])
        cycles = int(text.split("done: ")[1].split()[0])
        return cycles / 1000.0 / (time.monotonic() - started)
    finally:
        plant.send_signal(signal.SIGINT)
        plant.wait(timeout=20)


def output(command: list[str]) -> str:
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise RunError(f"{Path(command[0]).name} ended with status {done.returncode}: {(done.stderr or done.stdout).strip()[-300:]}")
    return done.stdout
