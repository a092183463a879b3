"""Where a run is: a bar on a terminal, plain lines without one."""

import sys
from contextlib import contextmanager

MODES = ("off", "ready", "active", "fault")


@contextmanager
def shown(scenario: str, duration_s: float):
    """Yields on_progress(mode, t_s)."""
    if sys.stdout.isatty():
        with bar(scenario, duration_s) as update:
            yield never_back(update)
    else:
        yield never_back(lines(duration_s))


def never_back(update):
    """The scenario's time is 0 again once the arm is no longer active; what was reached stays shown."""
    reached = 0.0

    def forward(mode: int, t_s: float) -> None:
        nonlocal reached
        reached = max(reached, t_s)
        update(mode, reached)

    return forward


@contextmanager
def bar(scenario: str, duration_s: float):
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}", markup=False), BarColumn(), TextColumn("{task.completed:5.1f} / {task.total:.1f} s  {task.fields[mode]}"),
               TimeRemainingColumn())
    with Progress(*columns, transient=True) as progress:
        task = progress.add_task(scenario, total=duration_s, mode="starting")
        yield lambda mode, t_s: progress.update(task, completed=min(t_s, duration_s), mode=MODES[mode])


def lines(duration_s: float):
    """Prints at every change of mode and at every tenth of the run."""
    last = {"mode": None, "tenth": 0}

    def update(mode: int, t_s: float) -> None:
        tenth = int(10 * t_s / duration_s)
        if mode != last["mode"] or tenth > last["tenth"]:
            last.update(mode=mode, tenth=tenth)
            print(f"  {t_s:6.1f} / {duration_s:.1f} s  {MODES[mode]}", flush=True)

    return update
