"""From sampled angles and torques to rows of an equation that is linear in what is sought: smooth derivatives, friction and
spring accounted for, and one low pass over every column and the torque alike, so that the equation stays true."""

from dataclasses import dataclass

import numpy as np

from reed_tools.identify.samples import Stretch
from reed_tools.robots.nominal import NominalArm
from reed_tools.robots.regressor import inverse_dynamics

REST_radps = 0.01      # slower: the direction of Coulomb friction is not sure
LARGEST_REST = 0.03    # share of a row's window at rest that is tolerated
WIDTH = 4.0            # the first smoothing passes this multiple of the cutoff
SIGMA_AT_3dB = 0.2335  # of the smoothing, times the frequency at which it halves the power
INNER_PER_CUTOFF = 20  # samples of the regressor per period of the cutoff


@dataclass
class Rows:
    """Per joint the same columns: inertial parameters of all links, then viscous, then Coulomb friction of all joints."""

    Y: np.ndarray       # [n, dof, 12 dof]
    torque: np.ndarray  # N·m, without what the rotors take, [n, dof]
    used: np.ndarray    # which joints' friction is sure, [n, dof]


def smoothing(sigma: float) -> list[np.ndarray]:
    """Kernels for value, first and second derivative per sample, of one smoothing: a Gaussian of fourth order, which keeps cubic
    polynomials. One of second order would bend an angle by sigma^2/2 of its acceleration, which gravity's torque shows.
    sigma: samples."""
    k = np.arange(-int(np.ceil(5 * sigma)), int(np.ceil(5 * sigma)) + 1)
    x = k / sigma
    g = np.exp(-0.5 * x * x)
    value, first, second = (1.5 - 0.5 * x**2) * g, (2.5 - 0.5 * x**2) * x * g, (4 * x**2 - 2.5 - 0.5 * x**4) * g
    second = second - second.sum() / g.sum() * g
    return [value / value.sum(), first / (first @ k), 2 * second / (second @ (k * k))]


def correlate(x: np.ndarray, kernel: np.ndarray) -> np.ndarray:
    """Along the first axis, where the kernel fits in."""
    return np.stack([np.convolve(column, kernel[::-1], mode="valid") for column in x.T], axis=1)


def low_pass(cutoff: float) -> np.ndarray:
    """Windowed sinc; cutoff: share of the sample rate."""
    half = int(np.ceil(1.5 / cutoff))
    k = np.arange(-half, half + 1)
    h = np.sinc(2 * cutoff * k) * np.blackman(len(k) + 2)[1:-1]
    return h / h.sum()


def rows_of(stretch: Stretch, arm: NominalArm, friction: np.ndarray, cutoff_hz: float) -> Rows | None:
    """None where the stretch is too short. friction: [2, dof], viscous and Coulomb as far as they are known, for the springs."""
    h = stretch.period_s
    kernels = smoothing(max(SIGMA_AT_3dB / (WIDTH * cutoff_hz) / h, 1.5))
    if len(stretch.angle) < 4 * len(kernels[0]):
        return None
    theta, theta_d, theta_dd = (correlate(stretch.angle, kernel) / h**order for order, kernel in enumerate(kernels))
    torque = correlate(stretch.torque, kernels[0])
    # What the spring of the joint carries bends it: q = theta - tau_s / k_q.
    tau_s = torque - arm.rotor_inertia * theta_dd - friction[0] * theta_d - friction[1] * direction(theta_d)
    every = max(1, int(1 / (INNER_PER_CUTOFF * cutoff_hz * h)))
    q, qd, qdd = (correlate(theta - tau_s / arm.stiffness, kernel)[::every] / h**order for order, kernel in enumerate(kernels))
    motor_d, motor_dd = (correlate(theta, kernels[order])[::every] / h**order for order in (1, 2))
    torque = correlate(torque, kernels[0])[::every] - arm.rotor_inertia * motor_dd
    resting = (np.abs(motor_d) < REST_radps).astype(float)

    filtered = low_pass(cutoff_hz * h * every)
    if len(q) < len(filtered):
        return None
    step = max(1, int(0.5 / (cutoff_hz * h * every)))
    Y = np.concatenate([inverse_dynamics(arm.chain, q, qd, qdd), diagonal(motor_d), diagonal(direction(motor_d))], axis=2)
    thin = lambda x, by=filtered: np.tensordot(np.lib.stride_tricks.sliding_window_view(x, len(by), axis=0)[::step], by, axes=1)
    return Rows(thin(Y), thin(torque), thin(resting, np.abs(filtered)) < LARGEST_REST)


def direction(speed: np.ndarray) -> np.ndarray:
    """Of Coulomb friction."""
    return np.clip(speed / (0.5 * REST_radps), -1.0, 1.0)


def diagonal(x: np.ndarray) -> np.ndarray:
    return x[:, :, None] * np.eye(x.shape[1])
