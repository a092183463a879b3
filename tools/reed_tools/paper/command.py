"""tools/reed paper: the experiments of the paper's section 4, run in lockstep, and one page with what came out."""

import os
from contextlib import contextmanager

from reed_tools import folders
from reed_tools.errors import UsageError
from reed_tools.paper import catalogue, runs
from reed_tools.paths import ROOT
from reed_tools.show import tables

CACHE = ROOT / "out" / "paper-runs"
EXAMPLE = """examples:
  tools/reed paper                                     # about five minutes
  tools/reed paper --fresh --jobs 2                    # all runs again, two at a time"""


def add_arguments(parser) -> None:
    parser.add_argument("--out", metavar="DIR", type=folders.argument, help="folder of the page; default out/<time>-paper")
    parser.add_argument("--jobs", metavar="N", type=int, default=max(1, len(os.sched_getaffinity(0)) // 2),
                        help="runs side by side, two programs each; default half the cores, here %(default)s")
    parser.add_argument("--fresh", action="store_true", help="run everything again instead of keeping what ran before")
    parser.epilog = f"{EXAMPLE}\n\n{parser.epilog}"


def run(arguments) -> int:
    if arguments.jobs < 1:
        raise UsageError(f"--jobs {arguments.jobs}: allowed are 1 and more")
    CACHE.mkdir(parents=True, exist_ok=True)
    folders.hold(CACHE)
    folder = folders.fresh(arguments.out, "paper", ("paper.html",), "such a page already; remove it or choose another folder")
    if arguments.fresh:
        runs.forget(CACHE)
    experiments = catalogue.everything()
    with progress(len(experiments)) as report:
        results = runs.run_all(experiments, CACHE, arguments.jobs, report)
    from reed_tools.paper import page  # matplotlib: not before the runs are safe

    path = page.write(folder, results)
    show(results)
    print(f"page  {path}")
    return 0


def show(results) -> None:
    from reed_tools.paper.phases import force_by_second, joint_by_second

    grid = tables.grid("last second, 2-3 s", "experiment", "law", "joint rms", "force rms", "")
    grid.add_row("", "", "mrad", "N", "", style="dim")
    for result in results:
        rate = result.effective["timing"]["rate_hz"]
        joint = joint_by_second(result.signals, rate, result.signals.has_wall)[-1]
        force = force_by_second(result.signals, rate)[-1]
        grid.add_row(result.experiment.key.split("/")[0], result.experiment.law, tables.number(joint, 3),
                     tables.number(force, 3), f"stopped at {result.signals.t[-1]:.2f} s" if result.stopped else "")
    tables.console().print(grid)


@contextmanager
def progress(count: int):
    """Yields report(event, experiment, seconds) for run_all: a bar on a terminal, a line per run without one."""
    out = tables.console()
    if not out.is_terminal:
        finished = []

        def line(event, experiment, seconds):
            if event in ("kept", "done"):
                finished.append(experiment)
                how = "kept from before" if event == "kept" else f"{seconds:.1f} s"
                print(f"  {len(finished):2}/{count}  {experiment.key}: {how}", flush=True)

        yield line
        return
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    with Progress(TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn(),
                  console=out, transient=True) as bars:
        whole = bars.add_task("experiments", total=count)
        into: dict[str, float] = {}

        def update(event, experiment, seconds):
            into[experiment.key] = 1.0 if event in ("kept", "done") else seconds / catalogue.DURATION_S
            bars.update(whole, completed=sum(into.values()), description=experiment.key)

        yield update
