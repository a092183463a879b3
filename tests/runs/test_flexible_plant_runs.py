"""Whole runs of both programs on the bending plant, in lockstep: nodal compensation, the known-force run, a plant that diverges."""

import json
import os
import subprocess
import sys
from pathlib import Path

import own_address
import pytest

ROOT = Path(__file__).resolve().parents[2]
BUS = own_address.bus()


@pytest.fixture
def run(tmp_path):
    """run(scenario, *overrides) -> (the finished process, its folder)."""

    def call(scenario, *overrides, name="run"):
        settings = [word for override in overrides for word in ("--set", override)]
        folder = tmp_path / name
        done = subprocess.run([sys.executable, "-m", "reed_tools", "run", scenario, "--clock", "lockstep", "--bus", BUS,
                               "--out", str(folder), *settings], env={**os.environ, "PYTHONPATH": str(ROOT / "tools")},
                              capture_output=True, text=True, timeout=240)
        return done, folder

    return call


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


def test_nodal_compensation_brings_the_bent_tip_three_times_nearer_to_the_plan(run):
    rms = {}
    for compensated in ("true", "false"):
        _, folder = run("free_motion", f"control.nodal_compensation={compensated}", name=compensated)
        result = summary(folder)
        assert result["parameters"]["initial"] == result["parameters"]["true"]
        rms[compensated] = [window["tip_rms_mm"] for window in result["windows"]]
    assert len(rms["true"]) == len(rms["false"]) == 4
    for with_it, without in zip(rms["true"], rms["false"]):
        assert without > 1.0, "the arm must sag for this to mean anything"
        assert 3.0 * with_it < without


def test_the_known_force_run_holds_its_limits_on_the_bending_plant(run):
    done, folder = run("press_known")
    assert done.returncode == 0, done.stderr
    assert 'flexible_links = true' in (folder / "effective.toml").read_text()
    assert summary(folder)["verdict"] == "pass"


def test_a_plant_that_diverges_names_state_and_time_exits_3_and_leaves_the_run_folder(run):
    # A load that bends links a fiftieth as stiff far beyond what the equations describe.
    done, folder = run("free_motion", "plant.stiffness_scale=0.02", "plant.payload_step_kg=100", "plant.payload_step_s=0.2")
    assert done.returncode == 3
    said = (folder / "plant.txt").read_text()
    assert "brakes closed" in said
    for text in (done.stderr, said):
        assert "the simulated arm diverged: " in text
        assert any(f"{part} {k} at " in text for part in ("motor", "joint", "element") for k in range(1, 6)), text
        assert ", t = 0.3" in text  # 0.2 s after the drives were enabled at 0.065 s
    result = summary(folder)
    assert result["verdict"] == "fail" and result["sim_s"] > 0.2
    for name in ("report.html", "telemetry.lcmlog", "bus.candump", "effective.toml"):
        assert (folder / name).stat().st_size > 0, name
