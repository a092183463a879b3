"""The loop's system calls in the release build: a handful by name, few per cycle, and nothing of the heap. Both programs, lockstep."""

import json
import signal
import subprocess
import sys
import time
import tomllib

import pytest

from reed_tools.paths import BUILD, ROOT

BUDGET = tomllib.loads((ROOT / "bench" / "budget.toml").read_text())["cycle"]
SENDMMSG = "307"
SCENARIO = ["--config", "press_known", "--set", "scenario.duration_s=1", "--clock", "lockstep", "--no-lcm"]

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="Linux system calls")


def fly(port: int, *options: str, under: tuple[str, ...] = ()) -> subprocess.CompletedProcess:
    bus = ["--bus", f"udp:239.74.163.2:{port}"]
    plant = subprocess.Popen([str(BUILD / "bin" / "reed_plant_sim"), *SCENARIO, *bus], stdout=subprocess.DEVNULL,
                             stderr=subprocess.DEVNULL)
    try:
        time.sleep(0.5)
        return subprocess.run([*under, str(BUILD / "bin" / "reed_firmware"), *SCENARIO, *bus, "--enable", *options],
                              capture_output=True, text=True, timeout=120)
    finally:
        plant.send_signal(signal.SIGINT)
        plant.wait(timeout=20)


def test_a_whole_run_makes_only_the_named_system_calls():
    done = fly(46211, "--seccomp")
    assert done.returncode == 0, done.stderr
    assert "0 heap allocations" in done.stdout


def test_a_cycle_makes_three_system_calls():
    done = fly(46212, under=(str(BUILD / "bin" / "reed_count_syscalls"),))
    assert done.returncode == 0, done.stderr
    cycles = int(done.stdout.split("done: ")[1].split()[0])
    threads = [json.loads(line)["calls"] for line in done.stdout.splitlines() if line.startswith("{")]
    loop = max(threads, key=lambda calls: calls.get(SENDMMSG, 0))
    receiving = sum(loop.get(number, 0) for number in ("299", "271", "230"))  # recvmmsg, ppoll, clock_nanosleep
    per_cycle = (loop[SENDMMSG] + receiving) / cycles
    assert per_cycle <= BUDGET["syscalls_lockstep"] * 1.05
