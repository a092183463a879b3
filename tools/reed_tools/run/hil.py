"""The two programs of one run: started plant first, stopped firmware first. Standard library only, because inside the
small VM (tools/vm) this module itself is the program: `python -m reed_tools.run.hil PLAN.json`."""

import ctypes
import json
import signal
import subprocess
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path

from reed_tools.record.log_tail import LogTail

POLL_S = 0.05
STOP_PATIENCE_S = 10.0   # between asking a program to stop and ending it
START_PATIENCE_S = 10.0  # until the plant hears the bus
STALL_S = 30.0           # no recorded cycle for this long: something hangs
PROGRESS_MARK = "@cycle "
HALVES = {"firmware": "controller.toml", "plant": "plant.toml"}  # what each program may know, beside effective.toml


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

    def half(self, name: str) -> str:
        half = Path(self.config).with_name(HALVES[name])
        return str(half) if half.exists() else self.config

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
    """In the child: end when the tool is killed outright, so that no half of a run keeps the bus busy."""
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)


def start(name: str, program: str, plan: Plan, extra: list[str]) -> subprocess.Popen:
    command = [program, "--config", plan.half(name), "--bus", plan.bus, "--clock", plan.clock,
               "--log", str(plan.log(name)), *([] if plan.lcm else ["--no-lcm"]), *extra]
    with open(plan.output(name), "wb") as output:
        # A session of its own: Ctrl-C reaches the tool alone, which then stops the two in order.
        return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                                start_new_session=True, preexec_fn=die_with_parent)


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
    outcome = Outcome()
    interrupted = []
    handlers = {number: signal.signal(number, lambda *_: interrupted.append(True)) for number in stop_signals()}
    plant = start("plant", plan.plant_sim, plan, [])
    await_bus(plan, plant, interrupted)
    frames = ["--candump", str(Path(plan.out) / "bus.candump")] if plan.candump else []
    firmware = start("firmware", plan.firmware, plan, ["--enable", *frames])
    try:
        watch(plan, plant, firmware, interrupted, outcome, on_progress)
    finally:
        outcome.firmware_status = stop(firmware)
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
        if now - last_growth > STALL_S:
            outcome.stopped_because = f"the loop recorded nothing for {STALL_S:g} s"
            return
        if now - last_report > 0.25 and (state := tail.control()) is not None:
            last_report = now
            cycle, mode, t_s = state
            on_progress(mode, t_s)
            if cycle > plan.most_cycles:
                outcome.stopped_because = f"the scenario was not done after {cycle} cycles"
                return
        if plant.poll() is not None and now - last_growth > 3.0:
            return  # the firmware had its time to notice


def main() -> int:
    plan = Plan(**json.loads(Path(sys.argv[1]).read_text()))
    outcome = run_pair(plan, lambda mode, t_s: print(f"{PROGRESS_MARK}{mode} {t_s}", flush=True))
    (Path(plan.out) / "outcome.json").write_text(json.dumps(asdict(outcome)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
