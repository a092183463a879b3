"""tools/reed replay RUN_DIR: a recorded run through the controller's own code again."""

import json
import subprocess
import tempfile
import time
from pathlib import Path

from reed_tools import folders, versions
from reed_tools.errors import RunError, UsageError
from reed_tools.paths import PYTHON, ROOT
from reed_tools.record import run_folder, tape
from reed_tools.replay import differences
from reed_tools.replay.player import Changes, replay
from reed_tools.run import joints
from reed_tools.text import plain

OWN_FILES = ("commands.png", "estimates.png")
CLOSED = "closed"
EXAMPLE = """examples:
  tools/reed replay out/RUN                                     # the same to the bit, or the first difference
  tools/reed replay out/RUN --set control.K_d=[9,9,6,3,3]       # open loop: what other gains would have commanded
  tools/reed replay out/RUN --set force.desired_N=8 --closed    # the arm too: run again from the same seed"""


def add_arguments(parser) -> None:
    parser.add_argument("run_dir", metavar="RUN_DIR", type=folders.argument, help=f"a folder that tools/reed run wrote, or a {tape.NAME}")
    parser.add_argument("--set", action="append", default=[], metavar="SECTION.KEY=VALUE", help="what if: another number of the controller; repeatable")
    parser.add_argument("--law", metavar="LIB.so|FILE.py", help="what if: a law from outside")
    parser.add_argument("--arm", metavar="NAME|FILE", help="what if: another nominal arm, with as many joints")
    parser.add_argument("--closed", action="store_true", help="with the arm as well: run again from the same seed, and compared with the run")
    parser.add_argument("--out", metavar="DIR", type=folders.argument, help="folder for the plots of a what-if; default out/<time>-replay")
    parser.add_argument("--json", action="store_true", help="print {same, cycles, first: {cycle, signal, recorded, replayed}}")


def run(arguments) -> int:
    changes = Changes(arguments.set, arguments.arm, arguments.law)
    started = time.monotonic()
    recorded = tape.read(tape.find(arguments.run_dir))
    if arguments.closed and not (arguments.run_dir / run_folder.CONFIGURATION).is_file():
        raise UsageError(f"{arguments.run_dir}: --closed needs a run folder with its {run_folder.CONFIGURATION}")
    if not recorded.usable():
        raise UsageError(f"{recorded.path}: its first cycle is missing; nothing of it can be replayed")
    joints.need(recorded.header.joints, "reed_replay")
    with tempfile.TemporaryDirectory(prefix="reed-replay-") as scratch:
        replayed = replay(recorded, changes, Path(scratch))
        first = differences.first(recorded, replayed, recorded.usable())
        if arguments.json:
            print(json.dumps(as_json(recorded, first)))
        else:
            say(recorded, first, changes, time.monotonic() - started)
        if changes.any() and not arguments.json:
            draw(arguments, recorded, replayed, changes)
    return 1 if first else 0


def as_json(recorded: tape.Tape, first: differences.Difference | None) -> dict:
    found = first and {"cycle": first.cycle, "signal": first.signal, "recorded": first.before, "replayed": first.after}
    return {"same": first is None, "cycles": recorded.usable(), "first": found, "missing": recorded.missing()}


def say(recorded: tape.Tape, first: differences.Difference | None, changes: Changes, took_s: float) -> None:
    if changes.any():
        print("open loop: the measurements are those of the run, whatever is commanded now")
    if first:
        print(f"differs: {first.in_words('recorded', 'replayed')}")
    else:
        print(f"same: {recorded.usable()} cycles, every signal to the bit ({took_s:.1f} s)")
    if line := recorded.missing():
        print(f"not replayed: {line}")
    now = versions.commit()
    if recorded.header.commit and now and recorded.header.commit != now:
        print(f"the tape is of commit {plain(recorded.header.commit)}, this is {now}")


def draw(arguments, recorded: tape.Tape, replayed: tape.Tape, changes: Changes) -> None:
    from reed_tools.replay import plots

    folder = folders.fresh(arguments.out, "replay", (*OWN_FILES, CLOSED), "a replay already; remove it or choose another folder")
    for path in plots.draw(folder, recorded, replayed):
        print(f"plot  {path}")
    if arguments.closed:
        print(f"closed loop: the arm again, from the same seed, in {folder / CLOSED}", flush=True)
        run_closed(arguments.run_dir, folder / CLOSED, changes)


def run_closed(run_dir: Path, out: Path, changes: Changes) -> None:
    options = [word for entry in changes.entries for word in ("--set", entry)]
    options += ["--arm", changes.arm] if changes.arm else []
    options += ["--law", changes.law] if changes.law else []
    reed = [*PYTHON, str(ROOT / "tools" / "reed_tools" / "__main__.py")]
    status = subprocess.run([*reed, "run", str(run_dir / run_folder.CONFIGURATION), "--bus", "memory", "--out", str(out), *options]).returncode
    if status > 1:
        raise RunError(f"--closed: the run ended with status {status}")
    subprocess.run([*reed, "compare", str(run_dir), str(out), "--out", str(out.parent / "compare")], check=False)
