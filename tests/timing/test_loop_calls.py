"""The loop's system calls in the release build: a handful by name, few per cycle, and nothing of the heap. Both programs."""

import json
import re
import signal
import subprocess
import sys
import tomllib

import own_address
import pytest

from reed_tools.paths import BUILD, ROOT

BUDGET = tomllib.loads((ROOT / "bench" / "budget.toml").read_text())["cycle"]
SENDMMSG, CALLS = "307", ("307", "299", "271", "230", "426")  # sendmmsg, recvmmsg, ppoll, clock_nanosleep, io_uring_enter
SCENARIO = ["--config", "press_known", "--set", "scenario.duration_s=1", "--no-lcm"]

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="Linux system calls")


def fly(*options: str, clock: str = "lockstep", under: tuple[str, ...] = ()) -> subprocess.CompletedProcess:
    pauses = ["--host-pause"] if clock == "realtime" else []
    options = ["--clock", clock, "--bus", own_address.bus(), *options, *pauses]
    plant = subprocess.Popen([str(BUILD / "bin" / "reed_plant_sim"), *SCENARIO, *options[:4]], stdout=subprocess.PIPE,
                             stderr=subprocess.DEVNULL, text=True)
    try:
        assert "waiting for SYNC" in plant.stdout.readline()
        return subprocess.run([*under, str(BUILD / "bin" / "reed_firmware"), *SCENARIO, *options, "--enable"],
                              capture_output=True, text=True, timeout=120)
    finally:
        plant.send_signal(signal.SIGINT)
        plant.communicate(timeout=20)


def counted(done: subprocess.CompletedProcess, what: str) -> int:
    """A figure of the firmware's closing line."""
    return int(re.search(rf"(\d+) {what}", done.stdout).group(1))


@pytest.mark.parametrize("clock", ["lockstep", "realtime"])
def test_a_whole_run_makes_only_the_named_system_calls_asks_no_heap_and_faults_no_page(clock):
    done = fly("--seccomp", "--set", "limits.hold_age_cycles=100", "--set", "limits.stop_age_cycles=1000",
               "--set", "timing.max_missed_in_row=1000", "--set", "drives.command_timeout_cycles=1000", clock=clock)
    assert done.returncode >= 0, f"a forbidden call ended it with signal {-done.returncode}"
    assert counted(done, "cycles") > 50
    assert counted(done, "heap allocations") == 0
    assert counted(done, "page faults") == 0
    assert "involuntary switches" in done.stdout


@pytest.mark.parametrize("clock", ["lockstep", "realtime"])
def test_a_cycle_makes_as_few_system_calls_as_its_budget_says(clock):
    """Where io_uring is forbidden a cycle on the clock makes two calls more, and two for every further part of its answers."""
    done = fly(clock=clock, under=(str(BUILD / "bin" / "reed_count_syscalls"),))
    threads = [json.loads(line)["calls"] for line in done.stdout.splitlines() if line.startswith("{")]
    loop = max(threads, key=lambda calls: calls.get(SENDMMSG, 0))
    per_cycle = sum(loop.get(number, 0) for number in CALLS) / counted(done, "cycles")
    allowed = BUDGET[f"syscalls_{clock}"] if clock == "lockstep" or loop.get("426") else 7
    assert 2.0 < per_cycle <= allowed * 1.05
