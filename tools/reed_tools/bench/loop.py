"""The loop with the plant at the other end: bus cycle, lockstep speed, telemetry, system calls."""

import json
import os
import signal
import subprocess
import tempfile
import time
import tomllib
from statistics import median

import numpy as np

from reed_tools.bench import programs
from reed_tools.bench.rows import Found, Row
from reed_tools.paths import BUILD, ROOT, program
from reed_tools.record.telemetry_log import load

PORT = 46311
CALLS = {"clock_nanosleep": "230", "sendmmsg": "307", "io_uring_enter": "426", "ppoll": "271", "recvmmsg": "299"}  # x86-64
UNMOVED = tuple(f"limits.{key}=1e6" for key in ("stuck_rad", "following_error_share", "unexplained_torque_share"))  # an arm without physics


def cores() -> tuple[int, int]:
    """Of the controller and of the plant: two where the machine has them."""
    mine = sorted(os.sched_getaffinity(0))
    return (mine[0], mine[1]) if len(mine) > 1 else (mine[0], mine[0])


def pinned() -> list[str]:
    loop, plant = cores()
    return [f"timing.cpu={loop}", f"timing.plant_cpu={plant}"]


def timing(done: programs.BenchRun) -> dict[str, np.ndarray]:
    """The firmware's own record, without the start."""
    table = load(done.log).tables["REED_TIMING"]
    return {name: column[len(column) // 10:] for name, column in table.items()}


def bus_cycle(arguments, folder) -> Found:
    """SYNC, states, wrench, command at 1 kHz by the loop's own clock, less its compute phase, beside two bare programs that bounce
    the bytes. At the other end is the plant program without physics: integrating is no bus time."""
    programs.build("reed_bare_bus", "reed_still_plant")
    seconds = 2 if arguments.quick else 5
    ours, bent, bare = [], [], []
    for _ in range(arguments.slices):
        bare.append(bare_cycle(seconds))
        ours.append(bus_time(folder, seconds, plant=[str(program("reed_still_plant")), programs.BUS_GROUP, str(PORT), str(cores()[1])]))
        bent.append(bus_time(folder, seconds))
    found = Found([Row("bus cycle, both programs, p50", median(ours), median(bare), "µs", 1.25, "the same bytes by bare C")],
                  details={"bus_cycle_us": {"reed": ours, "flexible": bent, "bare": bare}})
    found.notes.append(f"bus cycle with the flexible plant, whose physics comes before its answer: {median(bent):.1f} µs")
    return found


def bus_time(folder, seconds: int, plant: list[str] | None = None) -> float:
    still = UNMOVED if plant else ()
    table = timing(programs.run_programs(folder, PORT, "realtime", f"scenario.duration_s={seconds}", *pinned(), *still, plant=plant))
    return float(np.median(table["rx_ns"] + table["tx_ns"])) * 1e-3


def bare_cycle(seconds: int) -> float:
    loop, plant = cores()
    bare, bus = str(program("reed_bare_bus")), [programs.BUS_GROUP, str(PORT + 1)]
    answering = subprocess.Popen([bare, "plant", *bus, str(plant)])
    try:
        time.sleep(0.3)
        lines = programs.output([bare, "controller", *bus, str(loop), str(1000 * seconds), "1000"]).split()
    finally:
        answering.send_signal(signal.SIGTERM)
        answering.wait()
    return median(int(line) for line in lines) * 1e-3


def lockstep(arguments, folder) -> Found:
    runs = [programs.run_programs(folder, PORT, "lockstep") for _ in range(arguments.slices)]
    done = sorted(runs, key=lambda one: one.wall_s)[len(runs) // 2]
    us = 1e6 * done.wall_s / done.cycles
    mean = {phase: float(timing(done)[f"{phase}_ns"].mean()) * 1e-3 for phase in ("rx", "compute", "tx")}
    rest = us - sum(mean.values())
    found = Found([Row("lockstep press_known, flexible plant", done.cycles * 1e-3 / done.wall_s, None, "×", 8.0,
                       less_is_better=False)])
    found.notes.append(
        f"a lockstep cycle of {us:.1f} µs: the loop waits {mean['rx']:.1f} µs for the plant, computes {mean['compute']:.1f}, sends "
        f"{mean['tx']:.1f}, records and starts up {rest:.1f}; processor time per cycle: plant "
        f"{1e6 * done.plant_cpu_s / done.cycles:.1f} µs, firmware {1e6 * done.firmware_cpu_s / done.cycles:.1f} µs")
    found.details = {"lockstep_us": {"cycle": us, **mean, "rest": rest}}
    return found


def telemetry(arguments, _folder) -> Found:
    programs.build("reed_bench_telemetry")
    with tempfile.TemporaryDirectory() as scratch:
        ns = programs.nanoseconds("reed_bench_telemetry", arguments.processes, scratch)["telemetry"]
    return Found([Row("telemetry, cost per cycle, best", ns["best_ns"] * 1e-3, None, "µs", 0.5)], details={"telemetry_ns": ns})


def system_calls(_arguments, folder) -> Found:
    """Counted by the kernel (ptrace) over a whole run of one second."""
    programs.build("reed_count_syscalls")
    budget = tomllib.loads((ROOT / "bench" / "budget.toml").read_text())["cycle"]
    found = Found()
    for clock in ("lockstep", "realtime"):
        done = programs.run_programs(folder, PORT, clock, "scenario.duration_s=1", under=(str(BUILD / "bin" / "reed_count_syscalls"),))
        threads = [json.loads(line)["calls"] for line in done.text.splitlines() if line.startswith("{")]
        loop = max(threads, key=lambda calls: calls.get(CALLS["sendmmsg"], 0))
        per_cycle = {name: loop.get(number, 0) / done.cycles for name, number in CALLS.items()}
        # To a tenth: listening for another controller before the start makes some too.
        found.rows.append(Row(f"system calls per cycle, {clock}", round(sum(per_cycle.values()), 1), None, "", 4.0))
        found.notes.append(f"system calls per cycle, {clock}: " + ", ".join(f"{name} {count:.2f}" for name, count in per_cycle.items() if count)
                           + f"; budget {budget[f'syscalls_{clock}']}")
    return found
