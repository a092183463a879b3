"""tools/reed run: one hardware-in-the-loop run, from a scenario to a verdict."""

import re
import shutil
import tempfile
import time
from pathlib import Path

from reed_tools.errors import RunError, UsageError
from reed_tools.figures import report_page, result_table
from reed_tools.paths import ROOT, program
from reed_tools.record import trace_events
from reed_tools.record.telemetry_log import load, merge
from reed_tools.run import bus_choice, hil, progress, scenario, vm

STOPPED, USAGE = 1, 2  # statuses of the firmware: the arm ended in a fault; bad input
OWN_FILES = ("effective.toml", *hil.HALVES.values(), "firmware.txt", "plant.txt", "firmware.lcmlog", "plant.lcmlog", "telemetry.lcmlog", "bus.candump",
             "summary.json", "report.html", "trace.json", *(f"{name}.png" for name in report_page.CAPTIONS))
START_S = 60.0  # of the loop's own time, from the first SYNC to an active arm, at most


def add_arguments(parser) -> None:
    parser.add_argument("scenario", nargs="?", default="press_known", metavar="SCENARIO",
                        help="a name in config/scenarios or a path; default %(default)s")
    parser.add_argument("--arm", metavar="NAME|FILE", help="another arm than the scenario's")
    parser.add_argument("--duration", metavar="S", help="seconds from the moment the arm is active")
    parser.add_argument("--rate", metavar="HZ", help="cycles per second")
    parser.add_argument("--seed", metavar="N", help="of every random number of the plant")
    parser.add_argument("--out", metavar="DIR", type=Path, help="run folder; default out/<time>-<scenario>")
    parser.add_argument("--bus", default="auto", metavar="BUS",
                        help="auto (vcan if it exists or can be created, else udp), socketcan:IFACE, udp[:GROUP:PORT], "
                             "vm (real SocketCAN inside a small VM)")
    parser.add_argument("--clock", default="wall", choices=("wall", "lockstep"),
                        help="wall: paced by the clock; lockstep: as fast as possible, bit-reproducible")
    parser.add_argument("--set", action="append", default=[], metavar="SECTION.KEY=VALUE",
                        help="override any number of the scenario or arm; repeatable")
    parser.add_argument("--trace", action="store_true",
                        help="also write trace.json, for ui.perfetto.dev: a span per phase, instants for what happened")


def run(arguments) -> int:
    bus = bus_choice.choose(arguments.bus)
    with bus_choice.held(bus):
        with tempfile.TemporaryDirectory() as scratch:  # no run folder for a configuration that is refused
            checked = Path(scratch, "effective.toml")
            effective = scenario.write_effective(arguments.scenario, arguments.arm, scenario.overrides(arguments), checked)
            folder = make_folder(arguments, effective["scenario"]["name"])
            for name in (checked.name, *hil.HALVES.values()):
                shutil.copy(checked.with_name(name), folder)
        duration_s = effective["scenario"]["duration_s"]
        print(f"{effective['scenario']['name']} on {effective['arm']['name']}: {duration_s:g} s at "
              f"{effective['timing']['rate_hz']:g} Hz, {bus}, {arguments.clock} clock", flush=True)
        plan = hil.Plan(str(program("reed_firmware")), str(program("reed_plant_sim")), str(folder / "effective.toml"),
                        bus, arguments.clock, str(folder), most_cycles(effective))
        with progress.shown(effective["scenario"]["name"], duration_s) as on_progress:
            outcome = vm.run_pair(plan, on_progress) if bus == "vm" else hil.run_pair(plan, on_progress)
    return conclude(folder, plan, outcome, arguments.trace)


def most_cycles(effective: dict) -> int:
    return int((effective["scenario"]["duration_s"] + START_S) * effective["timing"]["rate_hz"])


def make_folder(arguments, name: str) -> Path:
    folder = arguments.out or ROOT / "out" / f"{time.strftime('%Y%m%d-%H%M%S')}-{re.sub(r'[^A-Za-z0-9_.-]', '_', name)}"
    if not (folder / "effective.toml").exists() and (others := [own for own in OWN_FILES if (folder / own).exists()]):
        raise UsageError(f"--out {folder}: is no run folder, and its {others[0]} would be replaced")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        clear(folder)
    except OSError as error:
        raise UsageError(f"--out {folder}: {error.strerror}") from None
    return folder.resolve()


def clear(folder: Path) -> None:
    """Without what an earlier run left there; other files stay."""
    for own in OWN_FILES:
        (folder / own).unlink(missing_ok=True)


def conclude(folder: Path, plan: hil.Plan, outcome: hil.Outcome, trace: bool = False) -> int:
    """Keeps what was recorded first, then tells what happened."""
    from reed_tools.figures.evaluate import evaluate  # numpy and matplotlib: not before the loop has run

    merge([plan.log("firmware"), plan.log("plant")], folder / "telemetry.lcmlog")
    if trace:
        trace_events.write(folder / "telemetry.lcmlog", folder / "trace.json")
    complaint = what_failed(plan, outcome)
    if complaint and USAGE in (outcome.firmware_status, outcome.plant_status):
        if not load(folder / "telemetry.lcmlog").has("REED_MEASURED"):  # nothing ran: no trace of it
            clear(folder)
            if not any(folder.iterdir()):
                folder.rmdir()
        raise UsageError(complaint)
    summary = evaluate(folder)
    if summary["cycles"]:
        result_table.show(summary)
    for line in hil.complaints(plan, "plant") + hil.complaints(plan, "firmware"):
        if not (complaint and line in complaint):
            print(line)  # what the machine refused, with the fix; why the arm stopped
    if outcome.interrupted:
        print("interrupted: the figures are those of the part that ran")
    print(f"report  {shown(folder / 'report.html')}")
    if complaint:
        raise RunError(complaint)
    return 0 if summary["verdict"] == "pass" else 1


def what_failed(plan: hil.Plan, outcome: hil.Outcome) -> str | None:
    """One line about the program that ended by itself with a complaint; the firmware's loss of its plant comes second."""
    if outcome.stopped_because:
        return f"stopped, because {outcome.stopped_because}; reed_firmware: {last_line(plan, 'firmware')}"
    for name, status in (("plant", outcome.plant_status), ("firmware", outcome.firmware_status)):
        if status and not (name == "firmware" and status == STOPPED):
            how = f"was ended by signal {-status}" if status < 0 else f"ended with status {status}"
            return f"{'reed_plant_sim' if name == 'plant' else 'reed_firmware'} {how}: {last_line(plan, name)}"
    return None


def last_line(plan: hil.Plan, name: str) -> str:
    return hil.last_words(plan, name) or f"it printed nothing ({shown(plan.output(name))})"


def shown(path: Path) -> str:
    try:
        return str(path.relative_to(Path.cwd()))
    except ValueError:
        return str(path)
