"""Every scenario of the five-joint arm, once, in lockstep, by both sides in one process: each ends with its checks held.
Long ones are cut where what they show has been seen."""

import json
import os
import pathlib
import subprocess
import sys
import tomllib

import own_address
import pytest

from reed_tools.figures import summary
from reed_tools.paths import ROOT
from reed_tools.record import telemetry_log
from reed_tools.run import hil, plans, scenario

SCENARIOS = sorted(path.stem for path in (ROOT / "config/scenarios").glob("*.toml") if tomllib.loads(path.read_text())["arm"] == "a5")
SHORTER_S = {"wall_soft": 3.0, "fluctuating_unknown": 3.0, "free_motion": 3.0,
             "payload_step": 3.0, "press_no_sensor": 3.0}
BUS = own_address.bus()


def run_and_judge(name, folder, *entries):
    """(outcome, summary) without pictures and page."""
    config = folder / "effective.toml"
    effective = scenario.write_effective(name, None, list(entries), config)
    plan = plans.make(effective, config, hil.MEMORY, "lockstep", folder)
    outcome = hil.run(plan, lambda mode, t_s: None)
    return outcome, summary.build(folder, telemetry_log.load(plan.log("firmware"), plan.log("plant")))[0]


@pytest.mark.parametrize("name", SCENARIOS)
def test_scenario_holds_its_checks(name, tmp_path):
    entries = [f"scenario.duration_s={SHORTER_S[name]}"] if name in SHORTER_S else []
    outcome, figures = run_and_judge(name, tmp_path, *entries)
    assert (outcome.statuses, outcome.stopped_because) == ({"one_process": 0}, "")
    broken = [check for check in figures["checks"] if not check["ok"]]
    assert figures["verdict"] == "pass" and not broken, broken
    assert len(figures["checks"]) >= 3, "a scenario says what it is to show"
    assert figures["windows"][-1]["to_s"] == pytest.approx(entries and SHORTER_S[name] or figures["windows"][-1]["to_s"], abs=0.01)


def test_the_paper_as_printed_diverges_is_caught_by_the_limits_and_the_arm_stops(tmp_path):
    """As a user would run it: exit status 1, the reason named, no torque left."""
    command = [sys.executable, "-m", "reed_tools", "run", "fluctuating_unknown", "--set", "control.law=paper_printed",
               "--clock", "lockstep", "--bus", BUS, "--out", str(tmp_path)]
    done = subprocess.run(command, env={**os.environ, "PYTHONPATH": str(ROOT / "tools")}, capture_output=True, text=True, timeout=120)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "speed limit" in done.stdout or "position limit" in done.stdout, done.stdout
    figures = json.loads((tmp_path / "summary.json").read_text())
    assert figures["verdict"] == "fail"
    assert [mode["mode"] for mode in figures["modes"]][-2:] == ["active", "fault"] or figures["modes"][-1]["mode"] == "fault"
    control = telemetry_log.load(pathlib.Path(tmp_path) / "telemetry.lcmlog").tables["REED_CONTROL"]
    assert control["mode"][-1] == 3 and abs(control["tau"][-1]).max() == 0.0
    assert control["t_s"].max() < 2.0, "it did not get far"
