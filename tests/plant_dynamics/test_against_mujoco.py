"""Elastic joints against MuJoCo: rotors as bodies of their own, joint springs as tendons, no code in common."""

import math

import mujoco
import numpy as np


def matrix(values):
    return " ".join(f"{x:.17g}" for x in values)


def elastic_joint_model(arm):
    """MJCF of a5 with rigid links: five rotors, five joints, a spring between each pair."""
    viscous = arm["bv"] * np.array(arm["viscous_weights"])
    rotors, bodies, closing, tendons = [], "", "", []
    position = "0 0 0"
    for i, ((alpha, a, d), body) in enumerate(zip(arm["dh"], arm["bodies"])):
        rotor = arm["rotor_inertia"][i]
        rotors.append(f'<body><joint name="rotor{i}" type="hinge" axis="0 0 1" damping="{viscous[i]:.17g}"/>'
                      f'<inertial pos="0 0 0" mass="1e-9" diaginertia="{rotor:.17g} {rotor:.17g} {rotor:.17g}"/></body>')
        p = np.array(position.split(), float) + [a, 0.0, 0.0]
        bodies += f'<body pos="{matrix(p)}" quat="{math.cos(alpha / 2):.17g} {math.sin(alpha / 2):.17g} 0 0">'
        bodies += f'<joint name="joint{i}" type="hinge" axis="0 0 1"/>'
        inertia = np.array(body["inertia"]).reshape(3, 3)
        # A link of which only one inertia is stated gets the others that it cannot feel, to be a body that can exist.
        seen = inertia if body["mass"] or not inertia.any() else inertia[2, 2] * np.eye(3)
        if not seen.any():
            seen = 1e-9 * np.eye(3)
        com = np.array(body["com"]) + [0.0, 0.0, d]
        full = [seen[0, 0], seen[1, 1], seen[2, 2], seen[0, 1], seen[0, 2], seen[1, 2]]
        bodies += f'<inertial pos="{matrix(com)}" mass="{max(body["mass"], 1e-9):.17g}" fullinertia="{matrix(full)}"/>'
        closing += "</body>"
        position = f"0 0 {d:.17g}"
        tendons.append(f'<fixed name="spring{i}" stiffness="{arm["joint_stiffness"][i]:.17g}" springlength="0">'
                       f'<joint joint="rotor{i}" coef="1"/><joint joint="joint{i}" coef="-1"/></fixed>')
    motors = "".join(f'<motor joint="rotor{i}"/>' for i in range(5))
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><compiler angle="radian" boundmass="0" boundinertia="0" balanceinertia="false"/>'
        f'<option integrator="RK4" timestep="5e-5" gravity="{matrix(arm["gravity"])}"><flag contact="disable"/></option>'
        f'<worldbody>{"".join(rotors)}{bodies}{closing}</worldbody>'
        f'<tendon>{"".join(tendons)}</tendon><actuator>{motors}</actuator></mujoco>')


def test_elastic_joints_move_as_in_mujoco(probe, arm):
    duration_ms = 500
    ours = probe("swing", 0, 1.0, 2e-5, duration_ms)
    model = elastic_joint_model(arm)
    data = mujoco.MjData(model)
    order = [model.joint(f"rotor{i}").qposadr[0] for i in range(5)], [model.joint(f"joint{i}").qposadr[0] for i in range(5)]
    data.qpos[order[0]] = [0.2, 0.6, -0.9, 0.5, 0.3]
    data.qpos[order[1]] = ours["start"]
    motors, joints = [], []
    for ms in range(duration_ms):
        t = 1e-3 * ms
        data.ctrl[:] = [4 * math.sin(3 * t), 8 * math.cos(4 * t), 3 * math.sin(5 * t), 0.8 * math.cos(2 * t), 0.2]
        for _ in range(20):
            mujoco.mj_step(model, data)
        if ms % 10 == 9:
            motors.append(data.qpos[order[0]].copy())
            joints.append(data.qpos[order[1]].copy())
    twist = np.array(motors) - np.array(joints)
    our_twist = np.array([m["q"] for m in ours["motor"]]) - np.array([j["q"] for j in ours["joint"]])
    assert np.abs(twist).max() > 1e-3, "the springs must work for this to mean anything"
    assert np.abs(np.array([m["q"] for m in ours["motor"]]) - motors).max() < 1e-5
    assert np.abs(our_twist - twist).max() < 1e-6
