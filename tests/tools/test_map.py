"""tools/reed map: borders of a planted margin, the border of stability of a rigid joint against python-control, bad input."""

import json
import math
import subprocess

import control
import numpy as np
import pytest
import rigid_joint
from built import reed

from reed_tools.map import grid
from reed_tools.map.borders import border, row
from reed_tools.map.grid import Axis
from reed_tools.map.measured import Mapped
from reed_tools.paths import build, program

STEP_S = 2e-3
MOTION = """[[reference.legs]]
kind = "joint"
duration_s = 0.3
to_rad = [0.1, 1.057362, -1.764384, -2.43457, 0.0]
"""
MORE = """[limits]
torque_rate_scale = 10000.0
[[checks]]
name = "joint_rms_mrad_last_second"
limit = 30.0
"""
STILL = rigid_joint.scenario(3.0, "[33.0, 9.0, 6.0, 1.5, 0.8]", MOTION, MORE)


def test_a_border_is_where_good_values_in_a_row_end():
    assert border(np.array([True, True, False, True])) == (0, 1)
    assert border(np.array([False, True, True])) == (1, 2)
    assert border(np.array([True] * 4)) == (0, 3)
    assert border(np.array([False] * 4)) is None


def test_a_map_says_both_borders_along_each_axis_and_what_breaks_first():
    x, y = grid.even("link.command_delay_s", 0.0, 0.003, 4), grid.even("link.command_loss", 0.0, 0.5, 2)
    margin = np.array([[0.5, 0.1], [0.2, -0.3], [-0.4, np.nan], [np.nan, np.nan]])
    assert row(planted((x, y), margin), 0) == ("own", "link.command_delay_s", "up to 0.001 s, not at 0.002", "up to 0.002 s, not at 0.003", "figure = 20")
    assert row(planted((x, y), margin), 1) == ("own", "link.command_loss", "up to 0.5, the largest value", "up to 0.5, the largest value", "–")


def test_a_rate_that_is_too_low_is_below_the_border():
    rate, delay = Axis("timing.rate_hz", (250.0, 500.0, 1000.0)), grid.even("link.command_delay_s", 0.0, 0.002, 3)
    margin = np.array([[np.nan] * 3, [0.2, -0.1, np.nan], [0.4, 0.3, 0.1]])
    assert row(planted((rate, delay), margin), 0)[1:3] == ("timing.rate_hz", "from 500 up to 1000 Hz, the largest value")
    assert row(planted((rate, delay), margin), 1)[1:3] == ("link.command_delay_s, timing.rate_hz = 500", "up to 0 s, not at 0.001")
    assert row(planted((rate, delay), np.full((3, 3), np.nan)), 0)[2:] == ("nowhere", "nowhere", "figure = 00")


def planted(axes, margin):
    said = np.array([[f"figure = {i}{j}" for j in range(margin.shape[1])] for i in range(margin.shape[0])], dtype=object)
    return Mapped(grid.Grid("own", axes), margin, ~np.isnan(margin), np.zeros(margin.shape, dtype=bool), said)


def delay_margin_s(inertia, K_d, Lambda, filter_hz, T):
    """The loop of a rigid joint in discrete time: zero-order hold, velocity from differences, low-passed, one period until a command
    acts. python-control finds crossover and phase margin."""
    z = control.tf([1, 0], [1], T)
    theta = control.tf([T ** 2 / (2 * inertia), T ** 2 / (2 * inertia)], [1, -2, 1], T)
    share = 1 - math.exp(-2 * math.pi * filter_hz * T)
    differences = control.tf([share, -share], [T, -T * (1 - share)], T)
    loop = K_d * (differences + Lambda) * theta / z
    _, phase_deg, _, crossover = control.margin(control.frd(loop, np.geomspace(1.0, 0.9 * math.pi / T, 20000), smooth=True))
    return math.radians(phase_deg) / crossover


def test_the_border_of_stability_is_the_delay_margin_of_the_linear_loop(tmp_path):
    """Joint 1 of a5 turns about the vertical, without gravity; the other joints' loops are slow and bear more."""
    build("reed_config_tool", "reed_one_process")
    still = tmp_path / "still.toml"
    still.write_text(STILL)
    nominal = json.loads(subprocess.run([program("reed_config"), "--config", still, "--margins"], capture_output=True, text=True, check=True).stdout)
    expected_s = delay_margin_s(nominal[0]["M_ii"] + 0.2, 33.0, 15.0, 120.0, 1e-3)
    assert 2 * STEP_S < expected_s < 15 * STEP_S
    count = math.ceil(expected_s / STEP_S) + 4
    done = reed("map", still, "--axis", f"link.command_delay_s=0:{(count - 1) * STEP_S:g}:{count}", "--jobs", 1, "--json", "--out", tmp_path / "map")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found == json.loads((tmp_path / "map" / "map.json").read_text())
    first, last = border(np.array(found["stable"]))
    last_s, unstable_s = found["axes"][0]["values"][last:last + 2]
    assert first == 0 and abs((last_s + unstable_s) / 2 - expected_s) <= STEP_S, (last_s, unstable_s, expected_s)
    assert found["margin"][0] > 0.5 and found["margin"][-1] is None
    assert (tmp_path / "map" / "map.png").stat().st_size > 10_000


def test_four_maps_are_the_standard_and_each_has_a_run_with_nothing_on_the_way():
    four = grid.standard(6)
    assert list(four) == ["delay", "jitter", "loss", "rate"] and sum(math.prod(one.shape) for one in four.values()) == 3 * 36 + 30
    assert four["delay"].entries((0, 0)) == ["link.command_delay_s=0", "link.measurement_delay_s=0"]
    assert four["rate"].entries((4, 5)) == ["scenario.allow_wire_overload=true", "timing.rate_hz=4000", "link.command_delay_s=0.005"]


@pytest.mark.parametrize("argv, reason", [
    (["nowhere"], "press_known"), (["--steps", "1"], "--steps 1: allowed"), (["--axis", "delay"], "SECTION.KEY=FROM:TO:N"),
    (["--axis", "link.command_delay_s=0.01:0:5"], "FROM below TO"), (["--axis", "a.b=0:1:2"] * 1, "a.b"), (["--seed", "-1"], "--seed -1"),
    (["--axis", "link.command_loss=0:1:2"] * 3, "once or twice"), (["--only", "delya"], "delya"), (["--jobs", "0"], "--jobs 0")])
def test_bad_input_is_one_line_and_status_2(tmp_path, argv, reason):
    done = reed("map", *argv, "--out", tmp_path / "out")
    assert done.returncode == 2 and reason in done.stderr and len(done.stderr.splitlines()) == 1, done.stderr
