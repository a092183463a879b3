"""Wake-up latency of the loop's clock beside cyclictest: same core, same priority, alternating slices."""

import json
import re
import shutil

from reed_tools.bench import programs
from reed_tools.bench.rows import Found, Row
from reed_tools.errors import RunError
from reed_tools.paths import program

HISTOGRAM_LINE = re.compile(r"^(\d{6}) (\d{6,})", re.M)
OVERFLOWS = re.compile(r"^# Histogram Overflows: *(\d+)", re.M)
HOW_TO_GET = "cyclictest is missing, {} has no other side: sudo apt install rt-tests"
CORE, PRIORITY, LATE_US = "0", 80, 1000


def wake(arguments, _folder) -> Found:
    programs.build("reed_bench_wake")
    anchored = shutil.which("cyclictest") is not None
    ours, theirs = [], []
    for _ in range(arguments.slices):
        ours.append(json.loads(programs.output([str(program("reed_bench_wake")), str(arguments.slice), CORE])))
        if anchored:
            theirs.append(summary(cyclictest(arguments.slice, interval_us=1000)))
    mine, other = middle(ours), middle(theirs) if anchored else {}
    found = Found([Row(f"wake-up at 1 kHz, {name}", mine[f"{name}_us"], other.get(f"{name}_us"), "µs", 1.1, "cyclictest")
                   for name in ("p50", "p99")], details={"wake_us": {"reed": ours, "cyclictest": theirs}})
    if not anchored:
        found.notes.append(HOW_TO_GET.format("wake-up latency"))
    late = f", of cyclictest {other['late']}" if anchored else ""
    found.notes.append(f"wake-ups later than 1 ms in {arguments.slices * arguments.slice} s: of the loop {mine['late']}{late}")
    return found


def middle(slices: list[dict]) -> dict:
    """Median over the slices: a slice that the hypervisor spoilt must not decide for either side."""
    return {key: sum(one[key] for one in slices) if key == "late" else sorted(one[key] for one in slices)[len(slices) // 2]
            for key in slices[0]}


def cyclictest(seconds: int, interval_us: int) -> list[tuple[int, int]]:
    """Histogram: (latency in whole µs, rounded down; wake-ups). What did not fit is in the last bin."""
    last_us = 5000
    text = programs.output(["cyclictest", "-q", "-m", f"-p{PRIORITY}", "-t1", f"-a{CORE}", f"-i{interval_us}",
                                  f"-l{seconds * 1_000_000 // interval_us}", f"-h{last_us}"])
    bins = [(int(us), int(count)) for us, count in HISTOGRAM_LINE.findall(text) if int(count)]
    if not bins:
        raise RunError("cyclictest printed no histogram; it needs the right to SCHED_FIFO")
    overflows = OVERFLOWS.search(text)
    return bins + ([(last_us, int(overflows.group(1)))] if overflows and int(overflows.group(1)) else [])


def summary(bins: list[tuple[int, int]]) -> dict:
    total = sum(count for _, count in bins)
    return {"p50_us": quantile(bins, 0.5 * total), "p99_us": quantile(bins, 0.99 * total),
            "late": sum(count for us, count in bins if us >= LATE_US)}


def quantile(bins: list[tuple[int, int]], wanted: float) -> float:
    """Within a bin of 1 µs its wake-ups are taken as evenly spread."""
    seen = 0
    for us, count in bins:
        if seen + count >= wanted:
            return us + (wanted - seen) / count
        seen += count
    return float(bins[-1][0])
