"""The highest rate: 60 s at 4 kHz in `realtime`, while cyclictest on the same cores records the host pauses."""

import re
import shutil
import subprocess
import tempfile
import time

import numpy as np

from reed_tools.bench import programs, wake
from reed_tools.bench.loop import PORT, cores, pinned
from reed_tools.bench.rows import Found, Row
from reed_tools.errors import RunError
from reed_tools.record.telemetry_log import load

RATE_HZ, SECONDS = 4000, 60
# cyclictest wakes up above the loop's priority, often enough to see what a cycle of 100 µs in a period of 250 cannot bear.
LOOK_US, PAUSE_US, EDGE_US = 100, 60, 100
# Delays below PAUSE_US add up and are not seen: of 456 missed cycles 7 (1.5 %) were outside every pause.
AIM = 0.05
# The same times as at 1 kHz: a pause of this machine is as long at any rate.
AGES = ("limits.hold_age_cycles=8", "limits.stop_age_cycles=40", "drives.command_timeout_cycles=80", "timing.max_missed_in_row=200")
SAMPLE = re.compile(r"^ *(\d+): *\d+: *(\d+)$", re.M)


def highest_rate(arguments, folder) -> Found:
    """A real wire is too slow for that: it is the compute budget that is tried."""
    if arguments.quick:
        return Found(notes=["the highest rate takes a minute: left out with --quick"])
    if not shutil.which("cyclictest"):
        missed = int(timing_of_run(folder)["missed"][-1])
        return Found([Row(f"missed cycles in {SECONDS} s at {RATE_HZ} Hz", missed, None, "")],
                     notes=[wake.HOW_TO_GET.format("the highest rate")])
    with PauseWatch() as watch:
        table = timing_of_run(folder)
        pauses = watch.pauses()
    missed, alone = int(table["missed"][-1]), outside_pauses(table, pauses)
    found = Found([Row(f"missed at {RATE_HZ} Hz outside host pauses", alone, missed, "cycles", AIM, "all missed cycles")])
    taken = 1e-6 * float((pauses[:, 1] - pauses[:, 0]).sum()) / (SECONDS * len(set(cores())))
    found.notes.append(f"{SECONDS} s at {RATE_HZ} Hz: {missed} of {SECONDS * RATE_HZ} cycles missed, {missed - alone} of them where "
                       f"cyclictest was late too; it saw {len(pauses)} pauses of {PAUSE_US} µs and more, {100 * taken:.1f} % of the time; "
                       f"of the punctual cycles {100 * by_chance(table, pauses):.1f} % met one")
    found.details = {"highest_rate": {"missed": missed, "away": alone, "stalls": len(pauses), "stalled_share": taken}}
    return found


def timing_of_run(folder) -> dict[str, np.ndarray]:
    """REED_TIMING of one run at that rate."""
    done = programs.run_programs(folder, PORT, "realtime", f"scenario.duration_s={SECONDS}", f"timing.rate_hz={RATE_HZ}",
                                "timing.rx_budget_us=130", "timing.compute_budget_us=60", "timing.tx_budget_us=60",
                                "scenario.allow_wire_overload=true", *AGES, *pinned())
    return load(done.log).tables["REED_TIMING"]


class PauseWatch:
    """cyclictest on the cores of both programs, its wake-ups aligned to a second of CLOCK_MONOTONIC."""

    def __init__(self):
        while time.monotonic() % 1.0 > 0.3:  # it starts at the next full second
            time.sleep(0.05)
        self.start_us = 1e6 * (int(time.monotonic()) + 1)
        threads = sorted(set(cores()))
        self.text = tempfile.TemporaryFile("w+")
        self.process = subprocess.Popen(
            ["cyclictest", "-v", "-m", f"-p{wake.PRIORITY + 1}", f"-t{len(threads)}", f"-a{','.join(map(str, threads))}",
             f"-i{LOOK_US}", "-d0", "--secaligned", f"-l{(SECONDS + 2) * 1_000_000 // LOOK_US}"],
            stdout=self.text, stderr=subprocess.DEVNULL)
        time.sleep(1.0)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        """A run that failed needs no watch any more."""
        self.process.kill()
        self.process.wait()
        self.text.close()

    def pauses(self) -> np.ndarray:
        """When a core did not run: rows of (due, woken), µs of CLOCK_MONOTONIC. Waits for cyclictest's end."""
        self.process.wait()
        self.text.seek(0)
        late: dict[str, list[int]] = {}
        for thread, latency_us in SAMPLE.findall(self.text.read()):
            late.setdefault(thread, []).append(int(latency_us))
        if not late:
            raise RunError("cyclictest printed nothing; it needs the right to SCHED_FIFO")
        found = [pause for latencies in late.values() for pause in pauses_of(latencies, self.start_us)]
        return np.array(sorted(found)).reshape(-1, 2)


def pauses_of(latencies_us: list[int], start_us: float) -> list[tuple[float, float]]:
    """cyclictest keeps its grid: after a late wake-up the next one is due at the first point that is not past."""
    found, due = [], start_us + LOOK_US
    for latency_us in latencies_us:
        woken = due + latency_us
        if latency_us >= PAUSE_US:
            found.append((due, woken))
        due += LOOK_US * (1 + max(0, latency_us // LOOK_US))
    return found


def outside_pauses(table: dict[str, np.ndarray], pauses: np.ndarray) -> int:
    """Missed cycles that no pause explains."""
    steps = np.diff(table["missed"])
    late = np.nonzero(steps)[0] + 1
    return int(steps[late - 1][~met_pause(table, late, pauses)].sum())


def by_chance(table: dict[str, np.ndarray], pauses: np.ndarray) -> float:
    """Share of the punctual cycles that met a pause, too: what counts as a host pause by chance."""
    punctual = np.nonzero(np.diff(table["missed"]) == 0)[0] + 1
    return float(met_pause(table, punctual[::20], pauses).mean())


def met_pause(table: dict[str, np.ndarray], cycles: np.ndarray, pauses: np.ndarray) -> np.ndarray:
    """Whether a core did not run between a cycle's due time and its end."""
    to_monotonic_us = 1e6 * (time.monotonic() - time.time())
    began = table["utime"][cycles] + to_monotonic_us
    due, ended = began - table["wake_ns"][cycles] * 1e-3 - EDGE_US, began + table["cycle_ns"][cycles] * 1e-3 + EDGE_US
    return np.array([((pauses[:, 0] <= end) & (pauses[:, 1] >= begin)).any() for begin, end in zip(due, ended)], dtype=bool)
