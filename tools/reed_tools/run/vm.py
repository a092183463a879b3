"""The small VM with a real SocketCAN stack (tools/vm)."""

import json
import signal
import subprocess
import tempfile
from dataclasses import asdict, replace
from pathlib import Path

from reed_tools.errors import RunError
from reed_tools.paths import PYTHON, ROOT
from reed_tools.run import hil
from reed_tools.run.guard import Guard

VM = ROOT / "tools" / "vm" / "vm"
BUS = "socketcan:vcan0"
START_S, SLOWEST_CYCLE_S = 600, 0.05  # a run inside that takes longer hangs; it has its own watch for that


def command(inner: list[str], time_limit_s: float | None = None, realtime: bool = False) -> list[str]:
    """realtime: the whole VM above the machine's ordinary load, for what is paced by the clock."""
    limit = ["--time-limit", str(time_limit_s)] if time_limit_s else []
    return [str(VM), *limit, *(["--realtime"] if realtime else []), "--", *inner]


def run(plan: hil.Plan, on_progress) -> hil.Outcome:
    """hil.run inside the VM, with the run folder outside."""
    inner = replace(plan, bus=BUS, lcm=False)  # the VM's network ends in the VM: nobody could listen
    outcome_file = Path(plan.out) / "outcome.json"
    outcome_file.unlink(missing_ok=True)
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(asdict(inner), file)
        file.flush()
        inside = command([*PYTHON, str(hil.PROGRAM), file.name], START_S + SLOWEST_CYCLE_S * plan.most_cycles,
                         realtime=plan.clock == "realtime")
        with Guard() as guard:
            process = subprocess.Popen(inside, stdout=subprocess.PIPE, text=True, errors="replace", start_new_session=True)
            guard.watch(process)
            interrupted = follow(process, on_progress)
    if not outcome_file.exists():
        raise RunError(f"the VM ended with status {process.returncode} before the run did")
    outcome = hil.Outcome(**json.loads(outcome_file.read_text()))
    outcome_file.unlink()
    outcome.interrupted |= interrupted
    return outcome


def follow(process: subprocess.Popen, on_progress) -> bool:
    """Passes progress on until the VM is down; the first Ctrl-C asks the run inside to stop in order."""
    interrupted = []

    def ask_to_stop(*_):
        interrupted.append(True)
        process.send_signal(signal.SIGINT)

    handlers = {number: signal.signal(number, ask_to_stop) for number in hil.stop_signals()}
    try:
        for line in process.stdout:
            if line.startswith(hil.PROGRESS_MARK):
                mode, t_s = line.removeprefix(hil.PROGRESS_MARK).split()
                on_progress(int(mode), float(t_s))
            else:
                print(line, end="")
        process.wait()
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
    return bool(interrupted)
