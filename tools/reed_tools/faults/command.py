"""tools/reed faults: every fault in every phase of a scenario, with several seeds: what is noticed, how soon, and is the arm safe?"""

import functools
import json
import shlex
import tempfile
from pathlib import Path

from reed_tools import folders, streams
from reed_tools.engine import options as engine_options
from reed_tools.engine import progress
from reed_tools.engine.engine import Engine
from reed_tools.errors import UsageError
from reed_tools.faults import accepted, catalogue, cell, junit, requirements, results, safety_page
from reed_tools.faults.cell import Cell, Row
from reed_tools.faults.phases import PHASES
from reed_tools.run import in_memory, scenario

SCENARIOS = ("press_known", "press_sensor_loss", "free_motion")
MOST_SEEDS = 10_000
UNMONITORED = ("limits.monitors=false",)  # the same run without the monitors: how long a hazard takes
OWN_FILES = (results.FILE, junit.FILE, "faults.html")
EXAMPLE = """examples:
  tools/reed faults press_known --draws 1              # every fault in every phase once
  tools/reed faults --only encoder_stuck --phase pressing"""


def add_arguments(parser) -> None:
    parser.add_argument("scenarios", nargs="*", metavar="SCENARIO", help=f"names in config/scenarios or paths; default {' '.join(SCENARIOS)}")
    parser.add_argument("--draws", type=int, default=1, metavar="N", help="seeds of every cell; default %(default)s")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="the first of them; default %(default)s")
    parser.add_argument("--faults", type=Path, default=catalogue.STANDARD, metavar="FILE", help="TOML with [[fault]]; default config/faults/standard.toml")
    parser.add_argument("--only", action="append", metavar="ID", help="this fault of the file; repeatable")
    parser.add_argument("--phase", action="append", choices=PHASES, help="this phase; repeatable")
    engine_options.add_arguments(parser)
    parser.add_argument("--out", type=folders.argument, metavar="DIR", help="folder; default out/<time>-faults")
    parser.add_argument("--keep", action="store_true", help="write safety/matrix.jsonl and docs/safety.md, the evidence for the requirements; of the whole matrix")
    parser.add_argument("--json", action="store_true", help="print the content of faults.json, the rest on standard error")


def run(arguments) -> int:
    for option, least, most in (("draws", 1, MOST_SEEDS), ("seed", 0, 2**53)):
        if not least <= getattr(arguments, option) <= most:
            raise UsageError(f"--{option} {getattr(arguments, option)}: allowed: a whole number from {least} to {most}")
    engine_options.check(arguments)
    entries = catalogue.load(arguments.faults)
    wanted = [entries.index(entry) for entry in catalogue.chosen(entries, arguments.only)]
    scenarios = arguments.scenarios or list(SCENARIOS)
    requirements.load()
    if arguments.keep and (arguments.scenarios or arguments.only or arguments.phase or arguments.faults != catalogue.STANDARD):
        raise UsageError("--keep: evidence is the whole matrix; leave out SCENARIO, --faults, --only and --phase")
    refuse_early(scenarios, [entries[number] for number in wanted])
    allowed = accepted.load()
    folder = folders.fresh(arguments.out, "faults", OWN_FILES, "a matrix already; choose another folder")
    with streams.result_alone(arguments.json):
        result = matrix(arguments, folder, entries, wanted, scenarios, allowed)
    if arguments.json:
        print(json.dumps({"folder": str(folder), **result}))
    return 0 if result["verdict"] == "pass" else 1


def refuse_early(scenarios: list[str], entries: list[dict]) -> None:
    """A fault that nothing would apply is a line before anything runs."""
    with tempfile.TemporaryDirectory() as scratch:
        for name in scenarios:
            for entry in entries:
                scenario.judged(name, [catalogue.as_override([{**entry, "from_s": 0.0}])], "--write", str(Path(scratch, "effective.toml")))


def matrix(arguments, folder: Path, entries: list[dict], wanted: list[int], scenarios: list[str], allowed) -> dict:
    seeds = range(arguments.seed, arguments.seed + arguments.draws)
    cells, alarms = planned(scenarios, seeds, wanted, arguments.phase)
    print(f"faults: {len(wanted)} faults, {len(cells)} cells of {', '.join(scenarios)}, {engine_options.place(arguments)}", flush=True)
    one = functools.partial(cell.run, entries, UNMONITORED)
    rows = []
    with (Engine(min(engine_options.jobs(arguments), len(cells)), arguments.scheduler) as engine,
          progress.shown("faults", CellTally(len(cells))) as on_row):
        for _, row in engine.map(one, cells):
            rows.append(row)
            on_row(row)
        if engine.interrupted:
            raise KeyboardInterrupt
    result = results.build(rows, alarms, len(scenarios) * len(seeds), allowed, {"scenarios": scenarios, "seeds": list(seeds), "build": in_memory.build()})
    results.write(folder, result)
    junit.write(folder, result)
    if arguments.keep:
        requirements.keep(result["rows"])
        safety_page.write()
    from reed_tools.faults import page

    path = page.write(folder, result, command_of(arguments, scenarios))
    show(result)
    print(f"report  {path}")
    return result


def planned(scenarios: list[str], seeds, wanted: list[int], phases: list[str] | None) -> tuple[list[Cell], list[dict]]:
    """The cells in an order in which a worker needs few fault-free runs, and the alarms of those runs."""
    cells, alarms = [], []
    for name in scenarios:
        for seed in seeds:
            twin = cell.twin_of(name, seed)
            alarms += [{"scenario": name, "seed": seed, "by": event, "cycle": cycle} for cycle, event, _, code in twin.events
                       if cell.observed.stops_the_arm(code) or event == "collision"]
            cells += [Cell(name, number, phase, seed) for phase in cell.triggers_of(name, seed) if not phases or phase in phases for number in wanted]
    if not cells:
        raise UsageError(f"--phase {' '.join(phases or ())}: none of {', '.join(scenarios)} has it")
    return cells, alarms


def command_of(arguments, scenarios: list[str]) -> str:
    words = ["tools/reed", "faults", *scenarios, "--draws", str(arguments.draws), "--seed", str(arguments.seed), "--faults", str(arguments.faults)]
    for option, values in (("--only", arguments.only), ("--phase", arguments.phase)):
        words += [word for value in values or () for word in (option, value)]
    return shlex.join(words)


class CellTally(progress.Tally):
    unit = "cells"

    def __init__(self, total: int):
        super().__init__(total)
        self.undetected = 0

    def add(self, row: Row) -> None:
        super().add(row)
        self.undetected += row.verdict == "dangerous undetected"

    def text(self) -> str:
        return f"{self.undetected} dangerous undetected"


def show(result: dict) -> None:
    coverage = result["diagnostic_coverage"]
    print(f"  {result['cells']} cells: " + ", ".join(f"{count} {name}" for name, count in result["classes"].items()))
    print(f"  diagnostic coverage {'-' if coverage is None else f'{100.0 * coverage:.1f} %'}, false alarms {len(result['false_alarms'])} in "
          f"{result['fault_free_runs']} fault-free runs, not executed {len(result['not_executed'])}")
    for row in [row for row in result["rows"] if row["failure"]][:10]:
        print(f"  {row['fault']} in {row['scenario']}, {row['phase']}, seed {row['seed']}: {row['failure']}\n    {row['command']}")
