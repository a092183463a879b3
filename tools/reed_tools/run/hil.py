"""The two programs of one run: started plant first, stopped firmware first. Standard library only, because inside the
small VM (tools/vm) they run without its packages (pair.py)."""

import ctypes
import json
import os
import resource
import signal
import subprocess
import sys
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path

from reed_tools.record.log_tail import ACTIVE, LogTail
from reed_tools.run.guard import Guard

PROGRAM = Path(__file__).with_name("pair.py")
POLL_S = 0.05
STACK_BYTES = 8 << 20     # what Linux gives by itself
STOP_PATIENCE_S = 10.0   # between asking a program to stop and ending it
START_PATIENCE_S = 10.0  # until the plant hears the bus
SILENCE_S = 30.0         # no recorded cycle for this long: something hangs
PROGRESS_MARK = "@cycle "


@dataclass
class Plan:
    firmware: str
    plant_sim: str
    config: str
    bus: str
    clock: str
    out: str
    most_cycles: int  # more than the scenario and its start can need
    lcm: bool = True  # publish on the LCM network too
    candump: bool = True  # keep every frame
    law: str = ""  # of the firmware's --law; "": the scenario's
    environment: dict = field(default_factory=dict)  # what the firmware needs beside the tool's own
    host_pause: bool = False  # a bench whose host may pause: the controller's watch measures it

    def log(self, name: str) -> Path:
        return Path(self.out) / f"{name}.lcmlog"

    def output(self, name: str) -> Path:
        return Path(self.out) / f"{name}.txt"


@dataclass
class Outcome:
    firmware_status: int | None = None
    plant_status: int | None = None
    interrupted: bool = False
    stopped_because: str = ""


def die_with_parent() -> None:
    """In a Python child: end in order when the tool is killed outright."""
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)


def start(name: str, program: str, plan: Plan, extra: list[str]) -> subprocess.Popen:
    command = [program, "--config", plan.config, "--bus", plan.bus, "--clock", plan.clock,
               "--log", str(plan.log(name)), *([] if plan.lcm else ["--no-lcm"]), *extra]
    limit_stacks()
    with open(plan.output(name), "wb") as output:
        # A session of its own: Ctrl-C reaches the tool alone, which then stops the two in order.
        return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT, start_new_session=True,
                                env={**os.environ, **plan.environment})


def limit_stacks() -> None:
    """A program that locks its memory locks whole stacks: one for each thread, as large as the caller's limit."""
    soft, hard = resource.getrlimit(resource.RLIMIT_STACK)
    if soft == resource.RLIM_INFINITY or soft > STACK_BYTES:
        resource.setrlimit(resource.RLIMIT_STACK, (STACK_BYTES, hard))


def said(plan: Plan, name: str) -> list[str]:
    path = plan.output(name)
    return path.read_text(errors="replace").strip().splitlines() if path.exists() else []


def complaints(plan: Plan, name: str) -> list[str]:
    """What a program had to say against the machine or the run: the lines that begin with its own name, and another arm."""
    return [line for line in said(plan, name) if line.startswith(("reed_", "another arm "))]


def last_words(plan: Plan, name: str) -> str:
    """What a program said last, "" if nothing. What it did is printed in another stream and may come after its complaints."""
    return (complaints(plan, name) or said(plan, name) or [""])[-1]


def stop(process: subprocess.Popen) -> int:
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(STOP_PATIENCE_S)
        except subprocess.TimeoutExpired:
            process.kill()
    return process.wait()


def stop_signals() -> list[int]:
    """A closed terminal stops a run in order, too, unless it was started with nohup."""
    hangup = [] if signal.getsignal(signal.SIGHUP) == signal.SIG_IGN else [signal.SIGHUP]
    return [signal.SIGINT, signal.SIGTERM, *hangup]


def await_bus(plan: Plan, plant: subprocess.Popen, interrupted: list) -> None:
    """Until the plant hears its bus: a SYNC that nobody hears is a cycle more in this run than in the next one."""
    end = time.monotonic() + START_PATIENCE_S
    while "waiting for SYNC" not in plan.output("plant").read_text(errors="replace"):
        if plant.poll() is not None or interrupted or time.monotonic() > end:
            return
        time.sleep(0.005)


def run_pair(plan: Plan, on_progress) -> Outcome:
    """Runs both programs to the end of the scenario. on_progress(mode, t_s) is called a few times per second."""
    with Guard() as guard:
        return run_guarded(plan, on_progress, guard)


def run_guarded(plan: Plan, on_progress, guard: Guard) -> Outcome:
    outcome = Outcome()
    interrupted = []
    handlers = {number: signal.signal(number, lambda *_: interrupted.append(True)) for number in stop_signals()}
    plant = start("plant", plan.plant_sim, plan, [])
    guard.watch(plant)
    await_bus(plan, plant, interrupted)
    frames = ["--candump", str(Path(plan.out) / "bus.candump")] if plan.candump else []
    pauses = ["--host-pause"] if plan.host_pause else []
    law = ["--law", plan.law] if plan.law else []
    firmware = start("firmware", plan.firmware, plan, ["--enable", *frames, *law, *pauses])
    guard.watch(firmware)
    try:
        watch(plan, plant, firmware, interrupted, outcome, on_progress)
    finally:
        outcome.firmware_status = stop(firmware)
        tail = LogTail(plan.log("firmware"))
        if (state := tail.control()) is not None:
            tell_progress(tail, state, on_progress)  # where the run ended, not where it was when last looked at
        # The plant asked to stop is not a plant that died: only what it said before counts.
        died = plant.poll()
        status = stop(plant)
        outcome.plant_status = died if died is not None else (0 if status == -signal.SIGINT else status)
        outcome.interrupted = bool(interrupted)
        for number, handler in handlers.items():
            signal.signal(number, handler)
    return outcome


def watch(plan, plant, firmware, interrupted, outcome, on_progress) -> None:
    """Returns when the firmware has ended, was interrupted, or has to be stopped because nothing moves."""
    tail = LogTail(plan.log("firmware"))
    last_size, last_growth, last_report = -1, time.monotonic(), 0.0
    while firmware.poll() is None and not interrupted:
        time.sleep(POLL_S)
        now = time.monotonic()
        size = tail.size()
        if size != last_size:
            last_size, last_growth = size, now
        if now - last_growth > SILENCE_S:
            outcome.stopped_because = f"the loop recorded nothing for {SILENCE_S:g} s"
            return
        if now - last_report > 0.25 and (state := tail.control()) is not None:
            last_report = now
            cycle = state[0]
            tell_progress(tail, state, on_progress)
            if cycle > plan.most_cycles:
                outcome.stopped_because = f"the scenario was not done after {cycle} cycles"
                return
        if plant.poll() is not None and now - last_growth > 3.0:
            return  # the firmware had its time to notice


def tell_progress(tail: LogTail, state: tuple[int, int, float], on_progress) -> None:
    _, mode, t_s = state
    on_progress(mode, t_s if mode == ACTIVE else tail.reached_s())


def main() -> int:
    plan = Plan(**json.loads(Path(sys.argv[1]).read_text()))
    outcome = run_pair(plan, lambda mode, t_s: print(f"{PROGRESS_MARK}{mode} {t_s}", flush=True))
    (Path(plan.out) / "outcome.json").write_text(json.dumps(asdict(outcome)))
    return 0
