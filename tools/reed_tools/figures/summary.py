"""summary.json: every figure of a run, from its effective.toml and its telemetry alone, so that it can be rebuilt."""

import hashlib
import json
from pathlib import Path

from reed_tools.figures import checks, events, faults, metrics, scalars
from reed_tools.figures.run_data import RunData
from reed_tools.record import configuration, run_folder
from reed_tools.record.signals import Signals, join
from reed_tools.record.telemetry_log import Recording
from reed_tools.record.whole_file import write_text
from reed_tools.robots.joint_frames import dof

SCHEMA = 1


def build(folder: Path, recording: Recording) -> tuple[dict, Signals | None]:
    effective = configuration.load(folder / "effective.toml")
    signals = join(recording)
    run, rate_hz = recording.run, effective["timing"]["rate_hz"]
    clock = run.clock if run else None
    verdicts = checks.evaluate(effective["checks"], run_data(effective, recording, signals))
    happened = events.of_run(recording, rate_hz)
    reason = events.reason(happened)
    injected = faults.of_run(effective, recording, rate_hz)
    verdicts += faults.checks(injected)
    for check in verdicts:
        if check["name"] == "faults" and not check["ok"] and reason:
            check["why"] = events.in_words(reason)
    origin = run_folder.origin(folder)
    arm = effective["arm"]
    summary = {
        "schema": SCHEMA,
        "scenario": effective["scenario"]["name"],
        "arm": arm["name"],
        "dof": dof(arm),
        "seed": effective["scenario"]["seed"],
        "law": effective["control"]["law"],
        "config_sha256": hashlib.sha256((folder / "effective.toml").read_bytes()).hexdigest(),
        "verdict": "pass" if all(check["ok"] for check in verdicts) else "fail",
        "reason": reason,
        "cause": events.cause(reason, verdicts),
        "checks": verdicts,
        "bus": bus(recording),
        "wire_time": wire_time(recording),
        **clock_figures(recording, rate_hz),
        "machine": origin["machine"] or {},
        "host_pause": host_pause(recording, clock),
        "timing_us": metrics.timing_us(recording, clock),
        "loop": {name: getattr(recording.finished_run, name, None) for name in
                 ("heap_allocations", "page_faults", "telemetry_dropped", "scheduler", "memory_locked")},
        "events": happened,
        "faults": injected,
        "modes": metrics.modes(recording, rate_hz),
        "windows": metrics.windows(signals, rate_hz),
        "parameters": metrics.parameters(recording, [
            {"name": name, "truth": truth} for name, truth in zip(arm["param_names"], arm["p_true"])]),
        "scalars": scalars.of_run(recording),
        "versions": origin["versions"] or dict.fromkeys(("reed", "commit", "build", "law")),
        "command": origin["command"],
        "digest": recording.digest(clock),
    }
    return summary, signals


def run_data(effective: dict, recording: Recording, signals: Signals | None) -> RunData:
    return RunData(recording, signals, effective["timing"]["rate_hz"], effective["arm"]["torque_limit"],
                          configuration.parameter_boxes(effective), configuration.sigma_limits(effective), effective["scenario"]["duration_s"])


def bus(recording: Recording) -> dict:
    run = recording.run
    counters = recording.singles["REED_BUS"][-1] if recording.singles["REED_BUS"] else None
    return {"kind": run.bus_kind if run else None, "interface": run.bus_interface if run else None, "fd": True,
            **{name: getattr(counters, name) if counters else None for name in
               ("frames_rx", "frames_tx", "lost", "crc_errors", "repeated")},
            "wire_load_percent": round(run.wire_load_percent, 3) if run else None}


def wire_time(recording: Recording) -> dict | None:
    """When frames were through on the simulated wire, beside the schedule's worst case without others; None without link.wire_time."""
    if not recording.has("REED_WIRE"):
        return None
    wire = recording.tables["REED_WIRE"]
    lasted_s = 1e-6 * float(wire["utime"][-1] - wire["utime"][0])
    if lasted_s <= 0:
        return None
    figures = {f"{name}_us": metrics.percentiles(wire[f"{name}_us"][1:]) | {"computed": round(float(wire[f"computed_{name}_us"][-1]), 3)}
               for name in ("answers", "command")}  # a message is about the cycle before: the first one about none
    return figures | {"foreign_percent": round(100 * float(wire["foreign_s"][-1] - wire["foreign_s"][0]) / lasted_s, 3),
                      "dropped": int(wire["dropped"][-1])}


def clock_figures(recording: Recording, rate_hz: float) -> dict:
    cycles, timing, run = recording.tables["REED_MEASURED"]["cycle"], recording.tables["REED_TIMING"], recording.run
    count = int(cycles[-1] - cycles[0] + 1) if len(cycles) else 0
    some = recording.has("REED_TIMING")
    return {"clock": run.clock if run else None, "rate_hz": rate_hz, "cycles": count,
            "missed_cycles": int(timing["missed"][-1]) if some else None,
            "overruns": int(timing["overruns"][-1]) if some else None,
            "wall_s": round(recording.finished_run.wall_s, 6) if recording.finished_run else None, "sim_s": round(count / rate_hz, 6)}


def host_pause(recording: Recording, clock: str | None) -> dict:
    """How often and for how long the bench's host ran neither program, and the cycles that were missed in it: the plant held the
    arm's clock, and the controller did not count them against itself. None where no clock is followed."""
    timing, plant = recording.tables["REED_TIMING"], recording.tables["REED_PLANT"]
    if clock != "wall" or not recording.has("REED_TIMING") or not recording.has("REED_PLANT"):
        return dict.fromkeys(("count", "host_pause_s", "missed_cycles"))
    return {"count": int(plant["stalls"][-1]), "host_pause_s": round(float(plant["stood_s"][-1]), 6),
            "missed_cycles": int(timing["missed_host_paused"][-1])}


def write(folder: Path, summary: dict) -> None:
    write_text(folder / "summary.json", json.dumps(summary, indent=2, allow_nan=False) + "\n")
