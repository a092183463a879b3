"""How far many runs are: a bar with the time left on a terminal, plain lines without one."""

import sys
import time
from contextlib import contextmanager

LINE_EVERY_S = 20.0


class Tally:
    """Counts records. What is worth saying of them, a command says in a class of its own."""

    unit = "runs"

    def __init__(self, total: int):
        self.total, self.done, self.started = total, 0, time.monotonic()

    def add(self, record) -> None:
        self.done += 1

    def text(self) -> str:
        return ""

    def left(self) -> str:
        seconds = (time.monotonic() - self.started) / self.done * (self.total - self.done)
        return f"{int(seconds // 60)}:{int(seconds % 60):02d} left"


@contextmanager
def shown(name: str, tally: Tally):
    """Yields on_record(record)."""
    if sys.stdout.isatty():
        with bar(name, tally) as update:
            yield update
    else:
        yield lines(tally)


@contextmanager
def bar(name: str, tally: Tally):
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    with Progress(TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TextColumn("{task.fields[tally]}"),
                  TimeRemainingColumn(), transient=True) as progress:
        task = progress.add_task(name, total=tally.total, tally="")

        def update(record) -> None:
            tally.add(record)
            progress.update(task, advance=1, tally=tally.text())

        yield update


def lines(tally: Tally):
    """A line now and then, and one at the end."""
    last = {"printed": time.monotonic()}

    def update(record) -> None:
        tally.add(record)
        if time.monotonic() - last["printed"] > LINE_EVERY_S or tally.done == tally.total:
            last["printed"] = time.monotonic()
            print(f"  {tally.done:4d} / {tally.total} {tally.unit}  {tally.text()}  {tally.left()}", flush=True)

    return update
