"""tools/reed run: one hardware-in-the-loop run, from a scenario to a verdict."""

import contextlib
import os
import shutil
import tempfile
from pathlib import Path

from reed_tools import folders, streams
from reed_tools.errors import RunError, UsageError
from reed_tools.figures import report_page, result_table
from reed_tools.law import choice as law_choice
from reed_tools.paths import CURRENT_RUN
from reed_tools.record import run_folder, trace_events
from reed_tools.record.telemetry_log import load
from reed_tools.record.whole_file import draft_of
from reed_tools.run import bus_choice, hil, live_page, origin, plans, progress, scenario, vm
from reed_tools.text import plain

OWN_FILES = (*run_folder.FILES, "summary.json", "report.html", "trace.json", *(f"{name}.png" for name in report_page.CAPTIONS))
EXAMPLE = """examples:
  tools/reed run                                       # the arm a5 presses 8 N on a wall
  tools/reed run press_known --clock lockstep --seed 7 # bit-identical when repeated
  tools/reed run --arm a7 --set control.Lambda=18      # any number of the scenario or of the arm"""


def add_arguments(parser) -> None:
    parser.add_argument("scenario", nargs="?", default="press_known", metavar="SCENARIO",
                        help="a name in config/scenarios or a path; default %(default)s")
    parser.add_argument("--arm", metavar="NAME|FILE", help="another arm than the scenario's")
    parser.add_argument("--duration", metavar="S", help="seconds from the moment the arm is active")
    parser.add_argument("--rate", metavar="HZ", help="cycles per second")
    parser.add_argument("--seed", metavar="N", help="of every random number of the plant")
    parser.add_argument("--out", metavar="DIR", type=folders.argument,
                        help="run folder, without a run in it yet; default out/<time>-<scenario>")
    parser.add_argument("--bus", default="auto", metavar="BUS",
                        help="auto (vcan if it exists or can be created, else udp), socketcan:IFACE, udp[:GROUP:PORT], "
                             "vm (real SocketCAN inside a small VM), memory (one process, in lockstep)")
    parser.add_argument("--clock", choices=("realtime", "wall", "lockstep"),
                        help="realtime (default, but for --bus memory; wall is its old name): paced by the clock; "
                             "lockstep: as fast as possible, bit-reproducible")
    parser.add_argument("--set", action="append", default=[], metavar="SECTION.KEY=VALUE",
                        help="override any number of the scenario or arm; repeatable")
    parser.add_argument("--law", metavar="LIB.so|FILE.py",
                        help="a law from outside: a shared library with the functions of reed/law.h, or a Python file (lockstep only)")
    parser.add_argument("--trace", action="store_true",
                        help="also write trace.json, for ui.perfetto.dev: a span per phase, instants for what happened")
    parser.add_argument("--live", action="store_true", help="with a page that shows the run as it happens, on 127.0.0.1")
    parser.add_argument("--json", action="store_true", help="print the content of summary.json and its folder, the rest on standard error")


def run(arguments) -> int:
    with streams.result_alone(arguments.json):
        folder, status = one_run(arguments)
    if arguments.json:
        print(run_folder.as_json(folder))
    return status


def one_run(arguments) -> tuple[Path, int]:
    """The run folder and the exit status."""
    bus = bus_choice.choose(arguments.bus)
    arguments.clock = clock = clock_on(bus, arguments.clock)  # the line that repeats the run names it
    law = law_choice.choose(arguments.law, clock)
    with bus_choice.held(bus):
        with tempfile.TemporaryDirectory() as scratch:  # no run folder for a configuration that is refused
            checked = Path(scratch, "effective.toml")
            effective = scenario.write_effective(arguments.scenario, arguments.arm, scenario.overrides(arguments), checked, halves=True)
            folder = folders.fresh(arguments.out, effective["scenario"]["name"], OWN_FILES,
                                   "a run already; remove it or choose another folder")
            for name in (checked.name, *hil.HALVES.values()):
                shutil.copy(checked.with_name(name), folder)
        known = origin.write(folder, arguments)
        say_where(folder)
        duration_s = effective["scenario"]["duration_s"]
        print(plain(f"{effective['scenario']['name']} on {effective['arm']['name']}: {duration_s:g} s at "
                    f"{effective['timing']['rate_hz']:g} Hz, {bus}, {clock} clock"), flush=True)
        plan = plans.make(effective, folder / "effective.toml", bus, clock, folder, law=law.spec, environment=law.environment,
                          commit=known["versions"]["commit"] or "",
                          host_pause=clock == "realtime" and bus_choice.simulated(bus))
        with live_page.beside() if arguments.live else contextlib.nullcontext():
            with progress.shown(plain(effective["scenario"]["name"]), duration_s) as on_progress:
                outcome = vm.run(plan, on_progress) if bus == "vm" else hil.run(plan, on_progress)
            return folder, conclude(folder, plan, outcome, arguments.trace)


def say_where(folder: Path) -> None:
    """For the live page: telemetry does not say where a run's configuration lies. Not worth a run if it cannot be written."""
    with contextlib.suppress(OSError):
        CURRENT_RUN.write_bytes(os.fsencode(folder) + b"\n")


def clock_on(bus: str, asked: str | None) -> str:
    if bus == hil.MEMORY and asked in ("realtime", "wall"):
        raise UsageError(f"--bus memory --clock {asked}: controller and plant of one process take turns, no clock paces them; "
                         "allowed: --clock lockstep, or another bus")
    return "lockstep" if asked == "lockstep" or bus == hil.MEMORY else "realtime"


def clear(folder: Path) -> None:
    """Without what a run left there; other files stay."""
    for own in OWN_FILES:
        (folder / own).unlink(missing_ok=True)
        draft_of(folder / own).unlink(missing_ok=True)


def conclude(folder: Path, plan: hil.Plan, outcome: hil.Outcome, trace: bool = False) -> int:
    """Keeps what was recorded first, then reports what happened."""
    from reed_tools.figures.evaluate import evaluate  # numpy and matplotlib: not before the loop has run

    link_frames(folder)
    unmerged = run_folder.complete(folder)
    if trace and not unmerged:
        trace_events.write(folder / "telemetry.lcmlog", folder / "trace.json")
    complaint = law_choice.in_words(what_failed(plan, outcome))
    if complaint and hil.REFUSED in outcome.statuses.values():
        if not load(*run_folder.logs(folder)).has("REED_MEASURED"):  # nothing ran: no trace of it
            clear(folder)
            if not any(folder.iterdir()):
                folder.rmdir()
        raise UsageError(complaint)
    summary, unwritten = evaluate(folder)
    if summary["cycles"]:
        result_table.show(summary)
    for line in (line for name in plan.programs for line in hil.complaints(plan, name)):
        if not (complaint and line in complaint):
            print(plain(law_choice.in_words(line)))  # what the machine refused, with the fix; why the arm stopped
    if outcome.interrupted:
        print("interrupted: the figures are those of the part that ran")
    if not unwritten:
        print(f"report  {shown(folder / 'report.html')}")
    if problem := complaint or unmerged or unwritten:
        raise RunError(problem)
    return 0 if summary["verdict"] == "pass" else 1


def link_frames(folder: Path) -> None:
    """python-can goes by the suffix and knows this format as .log."""
    if (folder / "bus.candump").exists():
        with contextlib.suppress(OSError):  # a file system without links
            (folder / "bus.log").symlink_to("bus.candump")


def what_failed(plan: hil.Plan, outcome: hil.Outcome) -> str | None:
    """One line about the program that ended by itself with a complaint; the firmware's loss of its plant comes second."""
    names, controller = plans.names(plan.bus), plan.controller
    if outcome.stopped_because:
        return f"stopped, because {outcome.stopped_because}; {names[controller]}: {last_line(plan, controller)}"
    for name, status in outcome.statuses.items():
        if status and not (name == controller and status == hil.STOPPED):
            how = f"was ended by signal {-status}" if status < 0 else f"ended with status {status}"
            return f"{names[name]} {how}: {last_line(plan, name)}"
    return None


def last_line(plan: hil.Plan, name: str) -> str:
    return hil.last_words(plan, name) or f"it printed nothing ({shown(plan.output(name))})"


def shown(path: Path) -> str:
    try:
        return str(path.relative_to(Path.cwd()))
    except (ValueError, OSError):  # elsewhere; or the current folder is gone
        return str(path)
