"""The programs of one run: two, started plant first, stopped firmware first; on a bus in memory one that is both. Standard
library only, because inside the small VM (tools/vm) they run without its packages (pair.py)."""

import ctypes
import json
import os
import resource
import select
import signal
import subprocess
import sys
import time
from contextlib import contextmanager, nullcontext
from dataclasses import asdict, dataclass, field
from pathlib import Path

from reed_tools.record.log_tail import ACTIVE, LogTail
from reed_tools.run import guard

PROGRAM = Path(__file__).with_name("pair.py")
POLL_S = 0.05
STACK_BYTES = 8 << 20     # what Linux gives by itself
STOP_PATIENCE_S = 10.0   # between asking a program to stop and ending it
START_PATIENCE_S = 10.0  # until the plant hears the bus
SILENCE_S = 30.0         # no recorded cycle for this long: something hangs
PROGRESS_MARK = "@cycle "
HALVES = {"firmware": "controller.toml", "plant": "plant.toml"}  # what each program may know, beside effective.toml
STOPPED, REFUSED = 1, 2  # statuses of the programs: the arm ended in a fault; bad input
MEMORY = "memory"        # the bus of controller and plant in one process


@dataclass
class Plan:
    programs: dict[str, str]  # path by name: "plant" and "firmware", or "one_process" on a bus in memory
    config: str
    bus: str
    clock: str
    out: str
    most_cycles: int  # more than the scenario and its start can need
    lcm: bool = True  # publish on the LCM network too
    candump: bool = True  # keep every frame, and the tape
    lock_memory: bool = True  # on a bus in memory many runs may leave it unlocked; nobody counts their page faults
    commit: str = ""  # of the programs, for the tape
    law: str = ""  # of the firmware's --law; "": the scenario's
    environment: dict = field(default_factory=dict)  # what the firmware needs beside the tool's own
    entries: list[str] = field(default_factory=list)  # KEY=VALUE, over what the configuration says
    first_cycle: int = 0  # its number
    host_pause: bool = False  # a bench whose host may pause: the controller's watch measures it

    @property
    def controller(self) -> str:
        """Name of the program that controls, the last to be started."""
        return list(self.programs)[-1]

    def half(self, name: str) -> str:
        """What the program reads: its half where a run folder keeps it, else the whole file."""
        half = Path(self.out) / HALVES[name] if name in HALVES else None
        return str(half) if half is not None and half.exists() else self.config

    def log(self, name: str) -> Path:
        """`name`: "plant" or "firmware", whoever writes it."""
        return Path(self.out) / f"{name}.lcmlog"

    def output(self, name: str) -> Path:
        return Path(self.out) / f"{name}.txt"


@dataclass
class Outcome:
    statuses: dict[str, int] = field(default_factory=dict)  # by name, in the order in which they count
    interrupted: bool = False
    stopped_because: str = ""


def die_with_parent() -> None:
    """In a Python child: end in order when the tool is killed outright."""
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)


def start(name: str, plan: Plan, options: list[str]) -> subprocess.Popen:
    entries = [word for entry in plan.entries for word in ("--set", entry)]
    command = [plan.programs[name], "--config", plan.half(name), *entries, *options, *([] if plan.lcm else ["--no-lcm"])]
    limit_stacks()
    with open(plan.output(name), "wb") as output:
        # A session of its own: Ctrl-C reaches the tool alone, which then stops the programs in order.
        return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT, start_new_session=True,
                                env={**os.environ, **plan.environment})


def limit_stacks() -> None:
    """A program that locks its memory locks whole stacks: one for each thread, as large as the caller's limit."""
    soft, hard = resource.getrlimit(resource.RLIMIT_STACK)
    if soft == resource.RLIM_INFINITY or soft > STACK_BYTES:
        resource.setrlimit(resource.RLIMIT_STACK, (STACK_BYTES, hard))


def on_bus(name: str, plan: Plan) -> list[str]:
    return ["--bus", plan.bus, "--clock", plan.clock, "--log", str(plan.log(name))]


def controls(plan: Plan) -> list[str]:
    """Of the program that controls, behind what all have."""
    frames = ["--candump", str(Path(plan.out) / "bus.candump"), "--tape", str(Path(plan.out) / "tape.reed"),
              *(["--tape-commit", plan.commit] if plan.commit else [])] if plan.candump else []
    return ["--enable", *frames, *(["--law", plan.law] if plan.law else []), *(["--host-pause"] if plan.host_pause else [])]


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


@contextmanager
def stop_requests():
    """A list that is empty until a signal asks for the end of the run."""
    interrupted = []
    handlers = {number: signal.signal(number, lambda *_: interrupted.append(True)) for number in stop_signals()}
    try:
        yield interrupted
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)


def run(plan: Plan, on_progress, interrupted: list | None = None) -> Outcome:
    """Runs the scenario to its end. on_progress(mode, t_s) is called a few times per second; None: nobody looks.
    `interrupted`: a list that somebody fills when the run shall end; without it signals ask for that."""
    outcome = Outcome()
    with stop_requests() if interrupted is None else nullcontext(interrupted) as interrupted:
        (run_one if plan.bus == MEMORY else run_pair)(plan, guard.of_this_tool(), interrupted, outcome, on_progress)
        outcome.interrupted = bool(interrupted)
    return outcome


def run_one(plan: Plan, guarded: guard.Guard, interrupted: list, outcome: Outcome, on_progress) -> None:
    name = "one_process"
    both = start(name, plan, ["--log", str(plan.log("firmware")), "--plant-log", str(plan.log("plant")), *controls(plan),
                               *([] if plan.lock_memory else ["--leave-memory-unlocked"])])
    guarded.watch(both)
    try:
        watch(plan, both, both, interrupted, outcome, on_progress)
    finally:
        outcome.statuses = {name: stop(both)}
        guarded.forget(both)
        tell_end(plan, on_progress)


def run_pair(plan: Plan, guarded: guard.Guard, interrupted: list, outcome: Outcome, on_progress) -> None:
    plant = start("plant", plan, on_bus("plant", plan))
    guarded.watch(plant)
    await_bus(plan, plant, interrupted)
    firmware = start("firmware", plan, [*on_bus("firmware", plan), *controls(plan)])
    guarded.watch(firmware)
    try:
        watch(plan, plant, firmware, interrupted, outcome, on_progress)
    finally:
        firmware_status = stop(firmware)
        tell_end(plan, on_progress)
        # The plant asked to stop is not a plant that died: only what it said before counts.
        died = plant.poll()
        status = stop(plant)
        plant_status = died if died is not None else (0 if status == -signal.SIGINT else status)
        guarded.forget(firmware)
        guarded.forget(plant)
        outcome.statuses = {"plant": plant_status, "firmware": firmware_status}  # its loss of the plant comes second


def ended_within(process: subprocess.Popen, seconds: float) -> bool:
    """Waits without asking again and again: a run in memory may be over in a tenth of a second."""
    try:
        descriptor = os.pidfd_open(process.pid)
    except OSError:  # an older kernel
        time.sleep(seconds)
        return process.poll() is not None
    try:
        return bool(select.select([descriptor], [], [], seconds)[0]) and process.poll() is not None
    finally:
        os.close(descriptor)


def watch(plan, plant, firmware, interrupted, outcome, on_progress) -> None:
    """Returns when the firmware has ended, was interrupted, or has to be stopped because nothing moves."""
    tail = LogTail(plan.log("firmware"))
    last_size, last_growth, last_report = -1, time.monotonic(), 0.0
    while not ended_within(firmware, POLL_S) and not interrupted:
        now = time.monotonic()
        size = tail.size()
        if size != last_size:
            last_size, last_growth = size, now
        if now - last_growth > SILENCE_S:
            outcome.stopped_because = f"the loop recorded nothing for {SILENCE_S:g} s"
            return
        if now - last_report > 0.25 and (state := tail.control()) is not None:
            last_report = now
            cycle = state[0] - plan.first_cycle
            if on_progress is not None:
                tell_progress(tail, state, on_progress)
            if cycle > plan.most_cycles:
                outcome.stopped_because = f"the scenario was not done after {cycle} cycles"
                return
        if plant.poll() is not None and now - last_growth > 3.0:
            return  # the firmware had its time to notice


def tell_progress(tail: LogTail, state: tuple[int, int, float], on_progress) -> None:
    _, mode, t_s = state
    on_progress(mode, t_s if mode == ACTIVE else tail.reached_s())


def tell_end(plan: Plan, on_progress) -> None:
    """Where the run ended, not where it was when last looked at."""
    tail = LogTail(plan.log("firmware"))
    if on_progress is not None and (state := tail.control()) is not None:
        tell_progress(tail, state, on_progress)


def main() -> int:
    plan = Plan(**json.loads(Path(sys.argv[1]).read_text()))
    outcome = run(plan, lambda mode, t_s: print(f"{PROGRESS_MARK}{mode} {t_s}", flush=True))
    (Path(plan.out) / "outcome.json").write_text(json.dumps(asdict(outcome)))
    return 0
