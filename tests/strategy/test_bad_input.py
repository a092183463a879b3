"""What a controller must not start with: refused before anything moves, exit 2, one line that names the rule."""

import os
import pathlib
import subprocess

import own_address
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("REED_BUILD_DIR", ROOT / "build" / "release"))

# scenario, what is set, words of the message
REFUSED = {
    "a damping that chatters at one cycle of delay": (
        "press_known", ["control.K_d=[33, 30, 18, 5.5, 40]"], ["control.K_d", "joint 5", "rule K_d (1 + (sigma0_max + sigma1_max/phi) / 10) <= 0.6 J_m rate"]),
    "a boundary layer so thin that the sliding term chatters": (
        "fluctuating_unknown", ["control.phi=0.001"], ["rule K_d (1 + (sigma0_max + sigma1_max/phi) / 10) <= 0.6 J_m rate"]),
    "gains that are sound at 1 kHz on a slower loop": (
        "press_known", ["timing.rate_hz=200"], ["rule K_d (1 + (sigma0_max + sigma1_max/phi) / 10) <= 0.6 J_m rate"]),
    "an integral too strong for the force loop": (
        "press_known", ["control.k_i=0.25"], ["control.k_i", "rule k_i < a_force k_p", "0.25", "0.24"]),
    "a negative damping": ("press_known", ["control.K_d=-1"], ["control.K_d", "-1", "0 ... 10000 N·m·s/rad"]),
    "a negative slope of the surface": ("press_known", ["control.Lambda=-20"], ["control.Lambda", "0 ... 500 1/s"]),
    "a negative adaptation gain": ("press_known", ["control.Gamma_known=-5"], ["control.Gamma_known", "0 ... "]),
    "a negative force gain": ("press_known", ["control.k_p=-0.004"], ["control.k_p", "1e-06 ... 1 m/(s·N)"]),
    "a damping that is no number": ("press_known", ["control.K_d=nan"], ["control.K_d", "finite"]),
    "an infinite observer": ("press_known", ["control.observer_gain=inf"], ["control.observer_gain", "finite"]),
    "a start outside its box": (
        "free_motion", ["control.p_initial=[0.7, 0.15, 0.12, 0.55, 0.4, 1.5]"], ["control.p_initial", "mL", "outside the box 0", "1"]),
    "a box that does not hold the nominal value": (
        "press_known", ["arm.p_lo=[0.5, 0, 0, 0, 0, 0]"], ["p_nom", "m2", "outside the box 0.5"]),
    "a start beyond a joint limit": (
        "press_known", ["reference.start_rad=[0, 1.9, -1.764384, -2.43457, 0]"], ["reference.start_rad", "joint 2", "beyond its limit"]),
    "a wall that the arm cannot reach": ("press_known", ["wall.point_m=[0.4, 0, 2.5]"], ["wall.point_m", "2.5 m", "reaches 1 m"]),
    "a contact limit that a biased sensor cannot reach": (
        "press_known", ["sensors.force_bias_N=[0, -90, 0]", "sensors.force_range_N=140"],
        ["limits.contact_force_N", "rule contact_force_N < sensors.force_range_N - largest |sensors.force_bias_N|", "60", "50 N"]),
    "an encoder too coarse for the gains": (
        "press_known", ["sensors.encoder_bits=12"],
        ["sensors.encoder_bits", "joint 1", "rule K_d times the velocity of one mark <= 0.1 torque_limit", "4 N·m"]),
    "a force without a wall": ("press_known", ["wall.present=false"], ["wall.present", "a desired force needs a wall"]),
    "auto without a force sensor": ("press_sensor_loss", ["sensors.wrench=false"], ["force.source", "auto", "need a force sensor"]),
    "a known force without a force sensor": ("press_known", ["sensors.wrench=false"], ["force.source", "known", "need a force sensor"]),
}

# seen while the path is laid out, before the first frame
REFUSED_PATHS = {
    "beyond a joint limit": (["reference.legs.0.kind=joint", "reference.legs.0.duration_s=2", "reference.legs.0.to_rad=[0, 1.88, -1.7, -2.4, 0]"], ["joint 2", "beyond its limit"]),
    "beyond a speed limit": (["reference.legs.1.frequency_hz=20"], ["too fast", "rad/s"]),
    "a start behind the wall": (["wall.normal=[0, 0, -1]"], ["reference.start_rad", "behind the wall", "in front of it"]),
    "a leg shorter than the knots": (["reference.legs.0.duration_s=0.009"], ["reference.legs[0].duration_s", "0.05"]),
    "out of reach": (["reference.legs.0.by_m=[0.9, 0, 0]"], ["leaves the arm's reach", "tool point"]),
}


def refusal(program, scenario, entries, *more):
    command = [BUILD / "bin" / program, "--config", scenario, *more]
    for entry in entries:
        command += ["--set", entry]
    done = subprocess.run(command, capture_output=True, text=True, timeout=30)
    assert done.returncode == 2, (done.returncode, done.stderr)
    assert len(done.stderr.splitlines()) == 1, done.stderr
    return done.stderr


@pytest.mark.parametrize("case", REFUSED)
def test_refused_at_the_start_is(case):
    scenario, entries, words = REFUSED[case]
    error = refusal("reed_config", scenario, entries)
    for word in words:
        assert word in error, error


@pytest.mark.parametrize("case", REFUSED_PATHS)
def test_refused_by_the_firmware_is_a_reference(case):
    entries, words = REFUSED_PATHS[case]
    error = refusal("reed_firmware", "press_known", entries, "--no-lcm", "--bus", own_address.bus())
    for word in words:
        assert word in error, error


def test_what_is_just_inside_every_rule_is_accepted(tmp_path):
    """Otherwise the rules above could refuse everything."""
    command = [BUILD / "bin" / "reed_config", "--config", "press_known", "--write", tmp_path / "effective.toml"]
    for entry in ("control.k_i=0.23", "control.K_d=[33, 30, 18, 5.5, 9]", "wall.point_m=[0.4, 0, 0.156]"):
        command += ["--set", entry]
    done = subprocess.run(command, capture_output=True, text=True, timeout=30)
    assert done.returncode == 0, done.stderr
