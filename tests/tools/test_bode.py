"""tools/reed bode: margins of a planted loop, and of a rigid joint with a known delay against the closed form."""

import json
import math
import subprocess

import numpy as np
import pytest
import rigid_joint
from built import reed

from reed_tools.bode import multisine
from reed_tools.bode.loop_gain import LoopGain, estimate, margins
from reed_tools.paths import program

STILL = rigid_joint.scenario(2.0, "[33.0, 30.0, 18.0, 5.5, 3.1]")


def planted(f, gain, delay_s):
    """gain / (jω) · e^(-jωτ): phase margin 90° - ω_c τ with ω_c = gain, gain margin where ω τ = 90°."""
    s = 2j * math.pi * f
    return gain / s * np.exp(-s * delay_s)


def test_margins_of_an_integrator_with_delay():
    f = np.geomspace(1, 400, 400)
    found = margins(LoopGain(f, planted(f, 100.0, 3e-3), np.ones_like(f)))
    assert found.phase_deg == pytest.approx(90 - math.degrees(100 * 3e-3), abs=0.1)
    assert found.delay_s == pytest.approx((math.pi / 2 - 0.3) / 100, rel=1e-2)
    assert found.gain == pytest.approx(math.pi / 2 / 3e-3 / 100, rel=1e-2)
    assert margins(LoopGain(f, 1e-3 * planted(f, 1.0, 0.0), np.ones_like(f))).phase_deg is None


def test_the_loop_is_read_at_its_break_point():
    """u = -L x in the time domain, x = u + w: the estimate is L, not L / (1 + L)."""
    rate, periods, lines = 1000.0, 3, multisine.frequencies(1000.0)
    t = np.arange(round(rate * (periods + 2))) / rate
    w, u = multisine.sum_at(t, 0.1, lines), np.zeros(len(t))
    for k in range(2, len(t)):
        u[k] = 0.7 * u[k - 1] - 0.2 * (u[k - 2] + w[k - 2])   # L(z) = 0.2 z^-2 / (1 - 0.7 z^-1)
    keep = slice(round(2 * rate), None)
    found = estimate(u[keep], w[keep], rate, lines, periods)
    z = np.exp(2j * math.pi * np.array(lines) / rate)
    assert np.allclose(found.L, 0.2 * z ** -2 / (1 - 0.7 * z ** -1), rtol=1e-6)
    assert np.all(found.coherence > 1 - 1e-9)


def test_lines_are_odd_and_below_half_of_the_rate():
    for rate in (125.0, 1000.0, 4000.0):
        lines = multisine.frequencies(rate)
        assert lines == sorted(set(lines)) and all(f % 2 == 1 for f in lines) and lines[-1] < 0.45 * rate


def closed_form(inertia, K_d, Lambda, filter_hz, T, f):
    """Rigid joint, torque held for T and applied one period after the measurement; velocity from differences, low-passed."""
    z = np.exp(2j * math.pi * f * T)
    theta = T ** 2 / (2 * inertia) * (z + 1) / (z - 1) ** 2        # zero-order hold of 1 / (J s²)
    share = 1 - math.exp(-2 * math.pi * filter_hz * T)
    speed = share / (1 - (1 - share) / z) * (1 - 1 / z) / T * theta
    return K_d * (speed + Lambda * theta) / z


def test_a_rigid_joint_with_a_known_delay_has_the_closed_form_s_margins(tmp_path):
    """Joint 1 of a5 turns about the vertical: no gravity, and no coupling with the joints that bend the arm. M_ii by reed_config."""
    still = tmp_path / "still.toml"
    still.write_text(STILL)
    nominal = json.loads(subprocess.run([program("reed_config"), "--config", still, "--margins"], capture_output=True, text=True, check=True).stdout)
    done = reed("bode", still, "--joint", 1, "--periods", 6, "--json", "--out", tmp_path / "bode")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    f = np.array(found["frequency_hz"])
    measured = np.array(found["gain"]) * np.exp(1j * np.radians(found["phase_deg"]))
    inertia = nominal[0]["M_ii"] + 0.2
    fine = np.geomspace(f[0], f[-1], 4000)
    expected = margins(LoopGain(fine, closed_form(inertia, 33.0, 15.0, 120.0, 1e-3, fine), np.ones_like(fine)))
    assert found["phase_margin_deg"] == pytest.approx(expected.phase_deg, abs=2.0)
    assert found["delay_margin_s"] == pytest.approx(expected.delay_s, rel=0.05)
    assert found["gain_margin"] == pytest.approx(expected.gain, rel=0.05)
    solid = np.array(found["coherence"]) > 0.99
    assert solid.sum() > 20
    ratio = measured[solid] / closed_form(inertia, 33.0, 15.0, 120.0, 1e-3, f[solid])
    assert np.all(np.abs(np.log(np.abs(ratio))) < 0.08) and np.all(np.abs(np.degrees(np.angle(ratio))) < 4.0)
    assert (tmp_path / "bode" / "bode.png").stat().st_size > 10_000


def test_an_amplitude_that_saturates_is_refused_with_one_that_does_not(tmp_path):
    done = reed("bode", "free_motion", "--joint", 4, "--amplitude", 8, "--out", tmp_path / "bode")
    assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr
    assert "reaches its limit" in done.stderr or "stopped under the excitation" in done.stderr


def test_bad_input_is_one_line(tmp_path):
    for words in (["free_motion", "--joint", 6], ["free_motion", "--joint", 0], ["free_motion", "--joint", 1, "--periods", 0],
                  ["free_motion", "--joint", 1, "--amplitude", -1], ["nothing", "--joint", 1]):
        done = reed("bode", *words, "--out", tmp_path / "x")
        assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr


def test_excitation_keys_are_checked():
    for entries, said in ((["drives.excitation_joint=1"], "without each other"), (["drives.excitation_joint=9"], "excitation_joint"),
                          (["drives.excitation_joint=1", "drives.excitation_Nm=0.1", "drives.excitation_hz=[600]"], "half of timing.rate_hz")):
        done = subprocess.run([program("reed_config"), "--config", "free_motion", *(word for entry in entries for word in ("--set", entry))],
                              capture_output=True, text=True)
        assert done.returncode == 2 and said in done.stderr
