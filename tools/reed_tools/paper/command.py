"""tools/reed paper: the experiments of the paper's section 4, run in lockstep, and one page with what came out."""

import json
from contextlib import contextmanager

from reed_tools import folders, streams
from reed_tools.engine import options as engine_options
from reed_tools.engine.engine import Engine
from reed_tools.paper import catalogue, runs
from reed_tools.paths import ROOT
from reed_tools.show import tables

CACHE = ROOT / "out" / "paper-runs"
EXAMPLE = """examples:
  tools/reed paper                                     # about five minutes
  tools/reed paper --fresh --jobs 2                    # all runs again, two at a time
  tools/reed paper --json                              # the last second of each experiment, for a script"""


def add_arguments(parser) -> None:
    parser.add_argument("--out", metavar="DIR", type=folders.argument, help="folder of the page; default out/<time>-paper")
    engine_options.add_arguments(parser)
    parser.add_argument("--fresh", action="store_true", help="run everything again instead of keeping what ran before")
    parser.add_argument("--json", action="store_true", help="print {page, experiments: [{experiment, law, joint_rms_mrad, force_rms_N, stopped_at_s}]}, "
                                                            "the rest on standard error")


def run(arguments) -> int:
    engine_options.check(arguments)
    CACHE.mkdir(parents=True, exist_ok=True)
    folders.hold(CACHE)
    folder = folders.fresh(arguments.out, "paper", ("paper.html",), "such a page already; remove it or choose another folder")
    if arguments.fresh:
        runs.forget(CACHE)
    experiments = catalogue.everything()
    with streams.result_alone(arguments.json):
        with progress(len(experiments)) as report:
            results = runs.run_all(lambda: Engine(engine_options.jobs(arguments), arguments.scheduler), experiments, CACHE, report)
        from reed_tools.paper import page  # matplotlib: not before the runs are safe

        path = page.write(folder, results)
        found = [last_second(result) for result in results]
        show(found)
        print(f"page  {path}")
    if arguments.json:
        print(json.dumps({"page": str(path), "experiments": found}))
    return 0


def last_second(result) -> dict:
    from reed_tools.paper.phases import force_by_second, joint_by_second

    rate = result.effective["timing"]["rate_hz"]
    return {"experiment": result.experiment.key.split("/")[0], "law": result.experiment.law,
            "joint_rms_mrad": joint_by_second(result.signals, rate, result.signals.has_wall)[-1],
            "force_rms_N": force_by_second(result.signals, rate)[-1],
            "stopped_at_s": float(result.signals.t[-1]) if result.stopped else None}


def show(found: list[dict]) -> None:
    grid = tables.grid("last second, 2-3 s", "experiment", "law", "joint rms", "force rms", "")
    grid.add_row("", "", "mrad", "N", "", style="dim")
    for row in found:
        stopped = f"stopped at {row['stopped_at_s']:.2f} s" if row["stopped_at_s"] is not None else ""
        grid.add_row(row["experiment"], row["law"], tables.number(row["joint_rms_mrad"], 3), tables.number(row["force_rms_N"], 3), stopped)
    tables.console().print(grid)


@contextmanager
def progress(count: int):
    """Yields report(event, experiment, seconds) for run_all, called once per experiment: a bar on a terminal, lines without one."""
    out = tables.console()
    if not out.is_terminal:
        finished = []

        def line(event, experiment, seconds):
            finished.append(experiment)
            how = "kept from before" if event == "kept" else f"{seconds:.1f} s"
            print(f"  {len(finished):2}/{count}  {experiment.key}: {how}", flush=True)

        yield line
        return
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    with Progress(TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn(),
                  console=out, transient=True) as bars:
        whole = bars.add_task("experiments", total=count)
        yield lambda event, experiment, seconds: bars.update(whole, advance=1, description=experiment.key)
