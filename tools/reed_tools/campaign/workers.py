"""Draws run side by side: one worker process per core, each with a bus of its own; results come back as records."""

import multiprocessing
import os
import queue
import signal
import tempfile
from pathlib import Path

from reed_tools.campaign.definition import Campaign
from reed_tools.campaign.draws import Record
from reed_tools.errors import ReedError, RunError, UsageError
from reed_tools.paths import program
from reed_tools.run import bus_choice, hil, scenario

PORTS = range(45100, 45900)
START_S = 60.0      # from the first SYNC to an active arm, at most
STOPPED, REFUSED = 1, 2  # statuses of the firmware: the arm ended in a fault; bad input
POLL_S = 0.2


def free_bus(stack) -> str:
    if bus := bus_choice.free_udp(stack, PORTS):
        return bus
    raise UsageError(f"no free software bus: ports {PORTS[0]} to {PORTS[-1]} are all in use by other runs")


def run_draw(campaign: Campaign, index: int, build: str, bus: str) -> Record | None:
    """None: interrupted before the end."""
    from reed_tools.figures import checks, summary
    from reed_tools.record import telemetry_log

    record = Record(index, campaign.definition(), build, campaign.overrides(index), "finished")
    with tempfile.TemporaryDirectory(prefix="reed-draw-") as scratch:
        folder = Path(scratch)
        try:
            effective = scenario.write_effective(campaign.scenario, None, record.overrides, folder / "effective.toml")
        except UsageError as error:
            raise UsageError(f"draw {index}: {error}") from None
        most_cycles = int((effective["scenario"]["duration_s"] + START_S) * effective["timing"]["rate_hz"])
        plan = hil.Plan(str(program("reed_firmware")), str(program("reed_plant_sim")), str(folder / "effective.toml"), bus,
                        "lockstep", scratch, most_cycles, lcm=False, candump=False)
        outcome = hil.run_pair(plan, lambda mode, t_s: None)
        if outcome.interrupted:
            return None
        if REFUSED in (outcome.firmware_status, outcome.plant_status):
            raise UsageError(f"draw {index}: {hil.last_words(plan, 'firmware' if outcome.firmware_status == REFUSED else 'plant')}")
        if outcome.plant_status or outcome.stopped_because or outcome.firmware_status not in (0, STOPPED):
            record.status = "died"
            record.message = outcome.stopped_because or f"firmware ended with {outcome.firmware_status}, plant with {outcome.plant_status}"
            record.message += "".join(f"; {name}: {hil.last_words(plan, name)}" for name in ("firmware", "plant"))
            return record
        if outcome.firmware_status == STOPPED:
            record.status, record.message = "fault", hil.last_words(plan, "firmware")
        recording = telemetry_log.load(plan.log("firmware"), plan.log("plant"))
        figures, signals = summary.build(folder, recording)
        record.checks, record.digest = figures["checks"], figures["digest"]
        record.stability = checks.evaluate(campaign.stable, summary.run_data(effective, recording, signals))
    return record


class Workers:
    """`with Workers(…) as workers: for record in workers.records(): …`. Leaving early, or a signal, stops the running pairs in
    order; what they had not finished is lost, nothing else."""

    def __init__(self, campaign: Campaign, indices: list[int], jobs: int, build: str, buses: list[str]):
        context = multiprocessing.get_context("fork")
        self.results = context.Queue()
        self.stopping = context.Event()
        self.taken = context.Value("q", 0)
        self.interrupted = False
        self.processes = [context.Process(target=self.work, args=(campaign, indices, build, bus), daemon=True)
                          for bus in buses[:max(1, min(jobs, len(indices)))]]

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

    def work(self, campaign: Campaign, indices: list[int], build: str, bus: str) -> None:
        """In the worker's own process."""
        hil.die_with_parent()
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, lambda *_: self.stopping.set())
        try:
            while not self.stopping.is_set() and (position := self.next_position()) < len(indices):
                record = run_draw(campaign, indices[position], build, bus)
                if record is None:
                    break
                self.results.put(record)
        except Exception as error:
            if not self.stopping.is_set():  # a Ctrl-C reaches reed_config too
                known = isinstance(error, (ReedError, OSError))
                self.results.put(error if known else RunError(f"internal error, {type(error).__name__}: {error}"))
        self.results.put(None)
