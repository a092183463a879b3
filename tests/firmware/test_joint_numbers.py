"""The same templates run arms of two, six and seven joints: each scenario once, in lockstep, with its checks as the verdict."""

import json
import os
import pathlib
import subprocess
import sys

import own_address
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("REED_BUILD_DIR", ROOT / "build" / "release"))


@pytest.mark.parametrize("joints", [2, 6, 7])
def test_an_arm_runs_within_its_scenarios_checks_with_joints(joints, tmp_path):
    environment = {**os.environ, "REED_BUILD_DIR": str(BUILD), "PYTHONPATH": str(ROOT / "tools")}
    done = subprocess.run([sys.executable, "-m", "reed_tools", "run", f"joints{joints}", "--clock", "lockstep", "--bus",
                           own_address.bus(), "--out", str(tmp_path)],
                          env=environment, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["dof"] == joints and summary["verdict"] == "pass" and summary["sim_s"] > 3.0
