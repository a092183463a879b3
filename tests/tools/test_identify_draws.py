"""Identification over draws of noise and truth: the standard deviations say how far the estimates are off. The data are those of rigid
links behind springs, by formula, along a periodic motion: torques by Pinocchio, derivatives of the springs' torques by Fourier
transform. `REED_IDENTIFY_DRAWS=100` for more than a few."""

import dataclasses
import os

import numpy as np
import pinocchio as pin
import pytest
from pinocchio_chain import chain_model

from reed_tools.identify import least_squares, samples
from reed_tools.identify.base import base_of
from reed_tools.robots import nominal

DRAWS = int(os.environ.get("REED_IDENTIFY_DRAWS", 6))
PERIOD_s, HARMONICS, STEP_s = 12.0, 5, 1e-3
NOISE_rad, ENCODER_rad = 1e-5, 2 * np.pi / 2**20
HIGHEST_Hz = 60.0  # of the springs' torque; what is above it is rounding


class Recorded:
    """A motion of a5 with rigid links, and a truth drawn within the box of p."""

    def __init__(self, arm, seed):
        rng = np.random.default_rng(seed)
        self.arm, self.noise = arm, rng
        p = arm.p_lo + rng.uniform(0.2, 0.8, len(arm.p)) * (arm.p_hi - arm.p_lo)
        self.inertial, self.viscous, self.coulomb = arm.known + arm.shapes @ p, arm.viscous @ p, 0.3 * rng.uniform(0.5, 1.5, arm.dof)

    def motion(self):
        k = np.arange(1, HARMONICS + 1)
        sine, cosine = (0.5 * self.noise.normal(size=(HARMONICS, self.arm.dof)) / k[:, None] for _ in range(2))
        w = 2 * np.pi / PERIOD_s * k
        turn = np.outer(np.arange(0, PERIOD_s, STEP_s), w)
        S, C = np.sin(turn), np.cos(turn)
        return S @ sine + C @ cosine, (C * w) @ sine - (S * w) @ cosine, -(S * w * w) @ sine - (C * w * w) @ cosine

    def stretch(self):
        q, qd, qdd = self.motion()
        model = chain_model(self.arm.chain)
        data = model.createData()
        spring = np.array([pin.computeJointTorqueRegressor(model, data, *state) @ self.inertial for state in zip(q, qd, qdd)])
        shares, w = np.fft.rfft(spring, axis=0), 2 * np.pi * np.fft.rfftfreq(len(q), STEP_s)[:, None]
        shares[w[:, 0] > 2 * np.pi * HIGHEST_Hz] = 0
        torque, torque_d, torque_dd = (np.fft.irfft(shares * (1j * w) ** order, len(q), axis=0) for order in range(3))
        theta, theta_d, theta_dd = (x + y / self.arm.stiffness for x, y in ((q, torque), (qd, torque_d), (qdd, torque_dd)))
        read = np.round((theta + NOISE_rad * self.noise.normal(size=theta.shape)) / ENCODER_rad) * ENCODER_rad
        applied = torque + self.arm.rotor_inertia * theta_dd + self.viscous * theta_d + self.coulomb * np.tanh(theta_d / 2e-3)
        return samples.Stretch(STEP_s, read, applied)


@pytest.fixture(scope="module")
def draws():
    """Errors and standard deviations, [draw, parameter]."""
    arm = nominal.load("a5")
    rigid = dataclasses.replace(arm, bends=False)
    base, found = base_of(rigid), []
    for seed in range(DRAWS):
        recorded = Recorded(rigid, seed)
        fit = least_squares.solve([recorded.stretch()], rigid, base, 8.0)
        true = base.B @ np.concatenate([recorded.inertial, recorded.viscous, recorded.coulomb])
        found.append((fit.estimate - true, fit.sigma, true, fit.residual))
    return [np.array(part) for part in zip(*found)]


def test_base_parameters_are_within_three_standard_deviations(draws):
    error, sigma, _, _ = draws
    assert (np.abs(error) < 3 * sigma).mean() > 0.95
    assert (np.abs(error) < 3 * sigma).mean(axis=0).min() > 0.8


def test_the_standard_deviations_say_something(draws):
    """They are small against what matters, and not beyond what the errors are by more than a few times."""
    error, sigma, true, residual = draws
    matters = np.abs(true).mean(axis=0) > 0.03
    assert matters.sum() > 12 and (sigma < 0.05 * np.abs(true).mean(axis=0))[:, matters].all()
    assert np.sqrt(np.mean((error / sigma) ** 2)) > 0.1
    assert residual.max() < 1.0
