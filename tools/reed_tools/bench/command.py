"""tools/reed bench: the timing budget's figures beside what they are compared with, in one run; ratios first."""

import json
from pathlib import Path

from reed_tools import folders, streams
from reed_tools.bench import embedded, loop, plant, plot, rates, rows, steps, wake
from reed_tools.bench.machine import Machine
from reed_tools.bench.rows import Found, Row
from reed_tools.errors import ReedError, UsageError
from reed_tools.text import did_you_mean


def cortex_m7(_arguments, folder) -> Found:
    if missing := embedded.missing():
        return Found(notes=[f"the embedded core is not measured, missing: {'; '.join(missing)}"])
    proof = embedded.prove(folder)
    return Found([Row("Cortex-M7 step, instructions, worst", proof.instructions, None, ""),
                  Row("Cortex-M7 step, instructions, median", proof.instructions_median, None, ""), Row("Cortex-M7 flash", proof.flash_bytes, None, "B"),
                  Row("Cortex-M7 static RAM", proof.ram_bytes, None, "B"), Row("Cortex-M7 stack", proof.stack_bytes, None, "B")])


MEASURES = {"steps": (steps.steps, "control step and regressor beside Pinocchio's"),
            "growth": (steps.growth, "growth with the number of joints"),
            "wake": (wake.wake, "wake-up latency beside cyclictest"),
            "bus": (loop.bus_cycle, "one bus cycle beside a bare C program"),
            "lockstep": (loop.lockstep, "lockstep speed"),
            "telemetry": (loop.telemetry, "telemetry's cost"),
            "calls": (loop.system_calls, "system calls per cycle"),
            "rate": (rates.highest_rate, "the highest rate"),
            "embedded": (cortex_m7, "the control core on a Cortex-M7"),
            "plant": (plant.measure, "the plant beside MuJoCo")}
EXAMPLE = """examples:
  tools/reed bench --quick                             # two minutes
  tools/reed bench steps growth                        # these two alone"""


def add_arguments(parser) -> None:
    parser.add_argument("only", nargs="*", metavar="WHAT", help=f"only these: {', '.join(MEASURES)}; default all")
    parser.add_argument("--quick", action="store_true", help="few and short slices, up to 8 joints, without the highest rate: two minutes")
    parser.add_argument("--processes", type=int, metavar="N", help="fresh processes per figure in nanoseconds; default 6, quick 2")
    parser.add_argument("--slice", type=int, metavar="S", help="seconds per slice of wake-up latency; default 10, quick 2")
    parser.add_argument("--slices", type=int, metavar="N", help="alternating slices per side; default 3, quick 1")
    parser.add_argument("--out", type=folders.argument, metavar="DIR", help="folder for bench.json and bench.png; default out/<time>-bench")
    parser.add_argument("--json", action="store_true", help="print the content of bench.json, the rest on standard error")


def run(arguments) -> int:
    set_defaults(arguments)
    folder = folders.fresh(arguments.out, "bench", ("bench.json", "bench.png"), "a benchmark already; remove it or choose another folder")
    with streams.result_alone(arguments.json):
        measure_all(arguments, folder)
    if arguments.json:
        print(json.dumps(json.loads((folder / "bench.json").read_text(encoding="utf-8"))))
    return 0


def measure_all(arguments, folder: Path) -> None:
    machine, all_found = Machine(), Found()
    print(machine.text(), flush=True)
    for name in arguments.only or MEASURES:
        measure, text = MEASURES[name]
        print(f"measuring {text}", flush=True)
        try:
            all_found.add(measure(arguments, folder))
        except ReedError as error:
            all_found.notes.append(f"not measured, {text}: {error}")
    report(all_found, machine, folder)


def set_defaults(arguments) -> None:
    """Defaults that depend on --quick, and what makes no sense."""
    for name, usual, quick in (("processes", 6, 2), ("slice", 10, 2), ("slices", 3, 1)):
        value = getattr(arguments, name)
        if value is None:
            setattr(arguments, name, quick if arguments.quick else usual)
        elif value < 1:
            raise UsageError(f"--{name} {value}: allowed are 1 and more")
    for name in arguments.only:
        if name not in MEASURES:
            raise UsageError(f"bench {name}: there is no such measurement{did_you_mean(name, MEASURES)}; there are {', '.join(MEASURES)}")


def report(found: Found, machine: Machine, folder: Path) -> None:
    machine.finish()
    print()
    rows.show(found.rows)
    for note in found.notes:
        print(note)
    if machine.noise():
        print(f"warning: the machine was noisy ({machine.noise()}): read the ratios, not the figures")
    (folder / "bench.json").write_text(json.dumps({"machine": machine.as_json(), "rows": [row.as_json() for row in found.rows],
                                                   "notes": found.notes, "details": found.details}, indent=1))
    made = [folder / "bench.json"]
    if plot.draw(found, machine.text(), folder / "bench.png"):
        made.append(folder / "bench.png")
    print("written " + " and ".join(str(path) for path in made))
