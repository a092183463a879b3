"""Draws run side by side: one worker process per core, each draw in one process on a bus in memory; results come back as records."""

import contextlib
import functools
import multiprocessing
import os
import queue
import signal
import tempfile
from pathlib import Path

from reed_tools.campaign.definition import Campaign
from reed_tools.campaign.draws import Record
from reed_tools.errors import ReedError, RunError, UsageError
from reed_tools.run import hil, plans, scenario

STOPPED, REFUSED = 1, 2  # statuses of the firmware: the arm ended in a fault; bad input
POLL_S = 0.2
NOT_READ_BY_FIGURES = ("wall.", "plant.", "force.", "disturbance.", "sensors.", "drives.", "scenario.seed")


def known_to_figures(campaign: Campaign, index: int) -> dict:
    """A draw's configuration as far as figures read it. The program reads and checks all of it; where no figure can differ, it is
    not written and parsed again for every draw."""
    if all(drawn.key.startswith(NOT_READ_BY_FIGURES) for drawn in campaign.drawn):
        with contextlib.suppress(UsageError):  # what is wrong without the drawn numbers may be right with them
            return effective_of(campaign.scenario, campaign.fixed)
    try:
        return effective_of(campaign.scenario, tuple(campaign.overrides(index)))
    except UsageError as error:
        raise UsageError(f"draw {index}: {error}") from None


@functools.lru_cache(maxsize=1)
def effective_of(name: str, entries: tuple[str, ...]) -> dict:
    with tempfile.TemporaryDirectory(prefix="reed-draw-") as scratch:
        return scenario.write_effective(name, None, list(entries), Path(scratch, "effective.toml"))


def run_draw(campaign: Campaign, index: int, build: str) -> Record | None:
    """None: interrupted before the end."""
    from reed_tools.figures import checks, summary
    from reed_tools.record import signals, telemetry_log

    record = Record(index, campaign.definition(), build, campaign.overrides(index), "finished")
    with tempfile.TemporaryDirectory(prefix="reed-draw-") as scratch:
        effective = known_to_figures(campaign, index)
        plan = plans.make(effective, campaign.scenario, hil.MEMORY, "lockstep", Path(scratch), lcm=False, candump=False,
                          entries=record.overrides)
        outcome = hil.run(plan, lambda mode, t_s: None)
        if outcome.interrupted:
            return None
        (status,) = outcome.statuses.values()
        said = hil.last_words(plan, plan.controller)
        if status == REFUSED:
            raise UsageError(f"draw {index}: {said}")
        if outcome.stopped_because or status not in (0, STOPPED):
            record.status, record.message = "died", f"{outcome.stopped_because or f'the program ended with {status}'}; {said}"
            return record
        if status == STOPPED:
            record.status, record.message = "fault", said
        recording = telemetry_log.load(plan.log("firmware"), plan.log("plant"))
        data = summary.run_data(effective, recording, signals.join(recording))
        record.checks, record.digest = checks.evaluate(effective["checks"], data), recording.digest("lockstep")
        record.stability = checks.evaluate(campaign.stable, data)
    return record


class Workers:
    """`with Workers(…) as workers: for record in workers.records(): …`. Leaving early, or a signal, stops the running pairs in
    order; what they had not finished is lost, nothing else."""

    def __init__(self, campaign: Campaign, indices: list[int], jobs: int, build: str):
        context = multiprocessing.get_context("fork")
        self.results = context.Queue()
        self.stopping = context.Event()
        self.taken = context.Value("q", 0)
        self.interrupted = False
        self.processes = [context.Process(target=self.work, args=(campaign, indices, build), daemon=True)
                          for _ in range(max(1, min(jobs, len(indices))))]

    def __enter__(self):
        for process in self.processes:
            process.start()
        self.handlers = {number: signal.signal(number, self.interrupt) for number in (signal.SIGINT, signal.SIGTERM)}
        return self

    def __exit__(self, *_):
        self.stop()
        for process in self.processes:
            process.join(2 * hil.STOP_PATIENCE_S)
        for number, handler in self.handlers.items():
            signal.signal(number, handler)

    def interrupt(self, *_) -> None:
        self.interrupted = True
        self.stop()

    def stop(self) -> None:
        self.stopping.set()
        for process in self.processes:
            if process.is_alive():
                os.kill(process.pid, signal.SIGINT)

    def records(self):
        """In the order in which they finish. Raises what a worker raised."""
        busy = len(self.processes)
        while busy:
            try:
                result = self.results.get(timeout=POLL_S)
            except queue.Empty:
                if not any(process.is_alive() for process in self.processes) and self.results.empty():
                    return
                continue
            if isinstance(result, Exception):
                raise result
            if result is None:
                busy -= 1
            else:
                yield result

    def next_position(self) -> int:
        with self.taken.get_lock():
            self.taken.value += 1
            return self.taken.value - 1

    def work(self, campaign: Campaign, indices: list[int], build: str) -> None:
        """In the worker's own process."""
        hil.die_with_parent()
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, lambda *_: self.stopping.set())
        try:
            while not self.stopping.is_set() and (position := self.next_position()) < len(indices):
                record = run_draw(campaign, indices[position], build)
                if record is None:
                    break
                self.results.put(record)
        except Exception as error:
            if not self.stopping.is_set():  # a Ctrl-C reaches reed_config too
                known = isinstance(error, (ReedError, OSError))
                self.results.put(error if known else RunError(f"internal error, {type(error).__name__}: {error}"))
        self.results.put(None)
