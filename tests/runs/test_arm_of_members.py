"""A closed loop with an arm of members: an L-shaped upper arm with two bending stiffnesses, a skew forearm, a hand that is rigid for a
part."""

import json

import pytest
from arm_of_members import text
from built import reed


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("members")
    arm = folder / "arm.toml"
    arm.write_text(text())

    def call(scenario, *overrides):
        out = folder / "-".join([scenario, *overrides])
        done = reed("run", scenario, "--arm", arm, "--bus", "memory", "--out", out, *(word for entry in overrides for word in ("--set", entry)))
        return done, json.loads((out / "summary.json").read_text())

    return call


def test_static_deflection_compensation_brings_the_tip_to_the_plan(run):
    rms = {given: [window["tip_rms_mm"] for window in run("free_motion", f"control.nodal_compensation={given}")[1]["windows"]] for given in ("true", "false")}
    for compensated, plain in zip(rms["true"], rms["false"], strict=True):
        assert plain > 1.0, "the arm must sag for this to mean anything"
        assert 3.0 * compensated < plain


def test_a_press_holds_the_limits_of_press_known(run):
    done, summary = run("press_known")
    assert done.returncode == 0 and summary["verdict"] == "pass", done.stdout + done.stderr
