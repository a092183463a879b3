"""The plant with stiffness x 1000 moves like Pinocchio's rigid arm: same torques, no code in common."""

import math

import numpy as np
import pinocchio as pin
import pytest


def torque(ms):
    """The motor torques of `plant_probe swing`, held for each millisecond."""
    t = 1e-3 * ms
    return np.array([4 * math.sin(3 * t), 8 * math.cos(4 * t), 3 * math.sin(5 * t), 0.8 * math.cos(2 * t), 0.2])


@pytest.fixture(scope="module")
def model(arm):
    model = pin.Model()
    model.gravity.linear = np.array(arm["gravity"])
    parent = 0
    offset = pin.SE3.Identity()
    for i, ((alpha, a, d), body) in enumerate(zip(arm["dh"], arm["bodies"])):
        mount = offset * pin.SE3(pin.utils.rotate("x", alpha), np.array([a, 0.0, 0.0]))
        parent = model.addJoint(parent, pin.JointModelRZ(), mount, f"joint{i + 1}")
        along = pin.SE3(np.eye(3), np.array([0.0, 0.0, d]))
        inertia = pin.Inertia(body["mass"], np.array(body["com"]), np.array(body["inertia"]).reshape(3, 3))
        model.appendBodyToJoint(parent, inertia, along)
        offset = along
    return model


def rigid_swing(model, arm, start, duration_ms, substeps=4):
    """Runge-Kutta 4 on Pinocchio's mass matrix plus rotors, with the arm's viscous friction."""
    data = model.createData()
    rotors = np.diag(arm["rotor_inertia"])
    viscous = arm["bv"] * np.array(arm["viscous_weights"])

    def acceleration(q, v, tau):
        M = np.triu(pin.crba(model, data, q))
        M = M + np.triu(M, 1).T + rotors
        return np.linalg.solve(M, tau - viscous * v - pin.rnea(model, data, q, v, np.zeros(model.nv)))

    q, v, h = np.array(start), np.zeros(model.nv), 1e-3 / substeps
    samples = []
    for ms in range(duration_ms):
        tau = torque(ms)
        for _ in range(substeps):
            a1 = acceleration(q, v, tau)
            a2 = acceleration(q + h / 2 * v, v + h / 2 * a1, tau)
            a3 = acceleration(q + h / 2 * v + h * h / 4 * a1, v + h / 2 * a2, tau)
            a4 = acceleration(q + h * v + h * h / 2 * a2, v + h * a3, tau)
            q = q + h * v + h * h / 6 * (a1 + a2 + a3)
            v = v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
        if ms % 10 == 9:
            samples.append(q)
    return np.array(samples)


@pytest.mark.parametrize("links_bend", [0, 1])
def test_thousandfold_stiffness_is_the_rigid_arm(probe, arm, model, links_bend):
    duration_ms = 1000
    ours = probe("swing", links_bend, 1000.0, 1e-4, duration_ms)
    rigid = rigid_swing(model, arm, ours["start"], duration_ms)
    joints = np.array([sample["q"] for sample in ours["joint"]])
    motors = np.array([sample["q"] for sample in ours["motor"]])
    assert np.ptp(rigid, axis=0).min() > 0.2, "every joint must move for this to mean anything"
    assert np.abs(joints - rigid).max() < 1e-4
    assert np.abs(motors - rigid).max() < 1e-4


def test_true_stiffness_is_not_the_rigid_arm(probe, arm, model):
    ours = probe("swing", 1, 1.0, 1e-4, 300)
    rigid = rigid_swing(model, arm, ours["start"], 300)
    assert np.abs(np.array([sample["q"] for sample in ours["joint"]]) - rigid).max() > 1e-3
