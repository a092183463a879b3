"""How far a campaign is: a bar with the time left on a terminal, plain lines without one."""

import sys
import time
from contextlib import contextmanager

from reed_tools.campaign.draws import Record

LINE_EVERY_S = 20.0


class Tally:
    def __init__(self, total: int):
        self.total, self.done, self.unstable, self.outside, self.started = total, 0, 0, 0, time.monotonic()

    def add(self, record: Record) -> None:
        self.done += 1
        self.unstable += not record.stable
        self.outside += record.stable and not record.within

    def text(self) -> str:
        return f"{self.unstable} not stable, {self.outside} outside limits"

    def left(self) -> str:
        seconds = (time.monotonic() - self.started) / self.done * (self.total - self.done)
        return f"{int(seconds // 60)}:{int(seconds % 60):02d} left"


@contextmanager
def shown(name: str, total: int):
    """Yields on_record(record)."""
    tally = Tally(total)
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

        def update(record: Record) -> None:
            tally.add(record)
            progress.update(task, advance=1, tally=tally.text())

        yield update


def lines(tally: Tally):
    """A line now and then, and one at the end."""
    last = {"printed": time.monotonic()}

    def update(record: Record) -> None:
        tally.add(record)
        if time.monotonic() - last["printed"] > LINE_EVERY_S or tally.done == tally.total:
            last["printed"] = time.monotonic()
            print(f"  {tally.done:4d} / {tally.total} draws  {tally.text()}  {tally.left()}", flush=True)

    return update
