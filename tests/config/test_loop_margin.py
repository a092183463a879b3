"""The margin that a scenario's gains leave, against eigenvalues of the discrete loop by another route (numpy)."""

import json
import math
import os
import pathlib
import re
import subprocess
import tomllib

import numpy as np
import pytest
from scipy.optimize import brentq

from reed_tools.record import configuration
from reed_tools.robots import rigid_arm

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / os.environ.get("REED_BUILD_DIR", "build/release") / "bin" / "reed_config"
SHIPPED = sorted(path.stem for path in (ROOT / "config/scenarios").glob("*.toml"))
DAMPING = 0.01  # of the motor-spring mode, of critical
STEPS = 400     # of the motion within a period


def config(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=60)


def nominal_inertia(effective):
    """M_ii at the start with the parameters at their start, from the arm's own tables."""
    arm = effective["arm"]
    wanted = effective["control"].get("p_initial") or arm["p_nom"]
    arm = rigid_arm.true_arm({"arm": arm, "plant": {"p_true": wanted}})
    return np.diag(rigid_arm.mass_matrix(arm, np.array([effective["reference"]["start_rad"]]))[0])


def one_period(J, M, k, K_d, Lambda, T, cutoff_hz, gain=1.0):
    """The map from one sample to the next; the motion between by small steps of the midpoint rule."""
    d = 2 * DAMPING * k / math.sqrt(k * (1 / J + 1 / M))
    A = np.array([[0, 1, 0, 0], [-k / J, -d / J, k / J, d / J], [0, 0, 0, 1], [k / M, d / M, -k / M, -d / M]])
    h, one = T / STEPS, np.eye(4)
    step = np.linalg.solve(one - 0.5 * h * A, one + 0.5 * h * A)
    push = np.linalg.solve(one - 0.5 * h * A, h * np.array([0, 1 / J, 0, 0]))
    share = 1 - math.exp(-2 * math.pi * cutoff_hz * T)

    def period(state):
        motion, speed, angle_before, torque = state[:4], state[4], state[5], state[6]
        speed = speed + share * ((motion[0] - angle_before) / T - speed)
        wanted = -gain * ((K_d + (M + J) * Lambda) * speed + K_d * Lambda * motion[0])
        angle = motion[0]
        for _ in range(STEPS):
            motion = step @ motion + push * torque
        return np.hstack([motion, speed, angle, wanted])

    return np.column_stack([period(column) for column in np.eye(7)])


def grows(*loop, gain):
    """Spectral radius of that map."""
    return np.abs(np.linalg.eigvals(one_period(*loop, gain))).max()


def phase_margin_deg(*loop):
    """Cut where the law's torque leaves: the least angle to -1 where the open loop, point by point by a solver, has the size of 1."""
    period_map, T = one_period(*loop), loop[5]
    law, rest = period_map[6].copy(), period_map.copy()
    rest[6] = 0

    def open_loop(w):
        return -law @ np.linalg.solve(np.exp(1j * w * T) * np.eye(7) - rest, np.eye(7)[6])

    w = np.geomspace(0.1, np.pi / T, 4000)
    sizes = np.abs([open_loop(each) for each in w]) - 1
    crossings = [brentq(lambda x: abs(open_loop(x)) - 1, *w[i:i + 2]) for i in np.flatnonzero(sizes[:-1] * sizes[1:] <= 0)]
    return min(abs(np.degrees(np.angle(-open_loop(each)))) for each in crossings)


def loops(effective):
    arm, control = effective["arm"], effective["control"]
    inertia = nominal_inertia(effective)
    for i, M in enumerate(inertia):
        J = arm["rotor_inertia_reflected"][i]
        yield (J, max(M, 1e-4 * J), arm["joint_stiffness"][i], control["K_d"][i], control["Lambda"][i],
               1 / effective["timing"]["rate_hz"], effective["sensors"]["velocity_filter_hz"])


@pytest.mark.parametrize("scenario", ["press_known", "free_motion", "joints2", "joints6", "joints7"])
def test_the_margins_are_those_of_eigenvalues_and_of_a_solved_response(scenario, tmp_path):
    path = tmp_path / "effective.toml"
    done = config("--config", scenario, "--margins", "--write", path)
    assert done.returncode == 0, done.stderr
    rows, effective = json.loads(done.stdout), configuration.load(path)
    assert len(rows) == len(effective["arm"]["dh"])
    for row, loop in zip(rows, loops(effective)):
        assert row["gain_margin"] >= 2 and row["phase_margin_deg"] >= 25
        assert grows(*loop, gain=0.98 * row["gain_margin"]) < 1 < grows(*loop, gain=1.02 * row["gain_margin"])
        assert row["phase_margin_deg"] == pytest.approx(phase_margin_deg(*loop), abs=0.01)


@pytest.mark.parametrize("scenario", SHIPPED)
def test_every_shipped_scenario_has_enough(scenario):
    assert config("--config", scenario).returncode == 0


UNSTABLE = {  # gains that the chatter rule lets pass and that end in a speed trip
    "two joints at 250 Hz": ("joints2", "timing.rate_hz=250", "control.K_d=[11,5.6]"),
    "six joints at 250 Hz": ("joints6", "timing.rate_hz=250", "control.K_d=[17.0,19.9,11.3,4.5,3.4,2.2]"),
    "light rotors": ("free_motion", "arm.rotor_inertia_reflected=[0.02,0.025,0.015,0.008,0.005]", "control.K_d=[4.5,5.6,3.4,1.8,1.1]"),
    **{f"{rate} Hz": ("press_known", f"timing.rate_hz={rate}",
                      f"control.K_d={[0.999 * 0.6 * J * rate / (1 + (3 + 0.4 / 0.03) / 10) for J in (0.2, 0.25, 0.15, 0.08, 0.05)]}")
       for rate in (125, 200, 250, 333)},
}


@pytest.mark.parametrize("case", UNSTABLE)
def test_an_unstable_loop_is_refused_with_its_margin(case):
    scenario, *entries = UNSTABLE[case]
    done = config("--config", scenario, *(f"--set={entry}" for entry in entries))
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1
    found = re.search(r"control.K_d: joint (\d): \S+(?: with the parameters at p_hi)? leaves a gain margin of (\S+) and a phase margin", done.stderr)
    assert found and float(found[2]) < 1, done.stderr


def test_the_refusal_names_a_damping_that_passes(tmp_path):
    entries = ["control.sigma0_max=0", "control.sigma1_max=0"]
    sets = [f"--set={entry}" for entry in entries]
    refused = config("--config", "press_known", *sets, "--set", "control.K_d=[60,30,18,5.5,3.1]")
    assert refused.returncode == 2
    allowed = float(re.search(r"so up to (\S+) N·m·s/rad at this rate and Lambda", refused.stderr)[1])
    assert 33 < allowed < 60
    for K_d, status in ((0.999 * allowed, 0), (1.02 * allowed, 2)):
        assert config("--config", "press_known", *sets, "--set", f"control.K_d=[{K_d},30,18,5.5,3.1]").returncode == status


@pytest.mark.parametrize("law", ["pd", "paper_printed", "paper_corrected"])
def test_laws_with_the_papers_own_gains_run_as_they_are(law):
    """They are there to be compared with, the one that diverges, too."""
    done = config("--config", "press_known", "--set", f"control.law={law}", "--margins")
    assert (done.returncode, done.stdout) == (0, "[]\n")
