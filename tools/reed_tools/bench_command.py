"""tools/reed bench: the timing budget's figures beside what they are compared with, in one run; ratios first."""

import json
import platform
import subprocess
import time
from dataclasses import asdict, dataclass
from pathlib import Path

from reed_tools import bench_embedded, bench_sides
from reed_tools.errors import ReedError
from reed_tools.paths import ROOT


@dataclass
class Row:
    what: str
    ours: float
    theirs: float | None
    unit: str
    aim: float | None        # of the ratio, or of the figure itself where nothing is compared
    less_is_better: bool = True

    @property
    def ratio(self) -> float | None:
        return self.ours / self.theirs if self.theirs else None

    @property
    def ok(self) -> bool | None:
        figure = self.ratio if self.theirs else self.ours
        return None if self.aim is None or figure is None else figure <= self.aim if self.less_is_better else figure >= self.aim


def add_arguments(parser) -> None:
    parser.add_argument("--processes", type=int, default=6, metavar="N", help="fresh processes per figure in nanoseconds; default %(default)s")
    parser.add_argument("--slice", type=int, default=10, metavar="S", help="seconds per slice of wake-up latency; default %(default)s")
    parser.add_argument("--out", type=Path, metavar="DIR", help="folder for bench.json and bench.png; default out/<time>-bench")


def run(arguments) -> int:
    folder = arguments.out or ROOT / "out" / f"{time.strftime('%Y%m%d-%H%M%S')}-bench"
    folder.mkdir(parents=True, exist_ok=True)
    rows, notes = [], []
    for measure in (steps, wake, lockstep, embedded):
        try:
            found, remarks = measure(arguments, folder)
            rows += found
            notes += remarks
        except ReedError as error:
            notes.append(f"{measure.__name__}: {error}")
    machine = describe_machine()
    show(rows, notes, machine)
    rows_json = [{**asdict(row), "ratio": row.ratio, "ok": row.ok} for row in rows]
    (folder / "bench.json").write_text(json.dumps({"machine": machine, "rows": rows_json, "notes": notes}, indent=1))
    if rows:
        plot(rows, folder / "bench.png")
    print(f"written {folder / 'bench.json'}")
    return 0


def steps(arguments, _folder) -> tuple[list[Row], list[str]]:
    ours = bench_sides.nanoseconds(("step", "regressor", "codec"), arguments.processes)
    theirs, notes = bench_sides.pinocchio(arguments.processes)
    rows = [Row("control step a5", ours["step_a5"], theirs.get("pinocchio_step_a5"), "ns", 0.5 if theirs else None)]
    for arm in ("a5", "a7"):
        rows.append(Row(f"regressor {arm} (with kinematics)", ours[f"regressor_{arm}"], theirs.get(f"pinocchio_torque_regressor_{arm}"),
                        "ns", 0.5 if theirs else None))
    rows.append(Row("codec, one cycle of a5", ours["codec_a5"], None, "ns", None))
    return rows, notes


def wake(arguments, _folder) -> tuple[list[Row], list[str]]:
    ours, theirs, notes = bench_sides.wake_slices(arguments.slice)
    rows = [Row(f"wake-up latency {name}", ours[f"{name}_us"], theirs.get(f"{name}_us"), "us", 1.1 if theirs else None)
            for name in ("p50", "p99")]
    late = f", cyclictest {theirs['late']}" if theirs else ""
    return rows, [*notes, f"wake-ups later than 1 ms: loop {ours['late']}{late}"]


def lockstep(_arguments, folder) -> tuple[list[Row], list[str]]:
    speed = bench_sides.lockstep_speed(folder)
    return [Row("lockstep press_known, times real time", speed, None, "x", 8.0, less_is_better=False)], []


def embedded(_arguments, folder) -> tuple[list[Row], list[str]]:
    if missing := bench_embedded.missing():
        return [], [f"embedded core not measured, missing: {'; '.join(missing)}"]
    proof = bench_embedded.prove(folder)
    return [Row("Cortex-M7 step", proof.instructions, None, "instructions", None), Row("Cortex-M7 flash", proof.flash_bytes, None, "B", None),
            Row("Cortex-M7 stack", proof.stack_bytes, None, "B", None)], []


def describe_machine() -> dict:
    model = next((line.split(":")[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")), "?")
    load = Path("/proc/loadavg").read_text().split()[0]
    cores = subprocess.run(["nproc"], capture_output=True, text=True).stdout.strip()
    return {"cpu": model, "cores": int(cores), "kernel": platform.release(), "load": float(load), "noisy": float(load) > 0.5 * int(cores)}


def show(rows: list[Row], notes: list[str], machine: dict) -> None:
    print(f"{machine['cpu']}, {machine['cores']} cores, kernel {machine['kernel']}")
    if machine["noisy"]:
        print(f"warning: the machine is busy (load {machine['load']:g}): read the ratios, not the figures")
    print(f"{'ratio':>7}  {'aim':>6}  {'':4}{'what':<40}{'Reed':>12}{'other side':>12}")
    for row in rows:
        ratio = f"{row.ratio:.2f}" if row.ratio else "-"
        aim = f"{'<=' if row.less_is_better else '>='}{row.aim:g}" if row.aim else "-"
        verdict = {True: "ok", False: "no", None: ""}[row.ok]
        theirs = f"{row.theirs:.1f}" if row.theirs else "-"
        print(f"{ratio:>7}  {aim:>6}  {verdict:<4}{row.what:<40}{row.ours:>12.1f}{theirs:>12} {row.unit}")
    for note in notes:
        print(note)


def plot(rows: list[Row], target: Path) -> None:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    compared = [row for row in rows if row.ratio]
    figure, axes = pyplot.subplots(figsize=(8, 0.5 * len(compared) + 1.2), layout="constrained")
    axes.barh([row.what for row in compared], [row.ratio for row in compared])
    for i, row in enumerate(compared):
        if row.aim:
            axes.plot([row.aim, row.aim], [i - 0.4, i + 0.4], "k--")
    axes.set_xlabel("Reed / other side; dashed: aim")
    axes.invert_yaxis()
    figure.savefig(target, dpi=120)
    pyplot.close(figure)
