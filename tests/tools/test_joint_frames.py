"""The tools' own kinematics for arms of `[[joint]]` tables and of rows with offsets, against Pinocchio."""

import numpy as np
import pinocchio as pin
import pytest
from made_arms import made_arm, made_chain

from reed_tools.robots import arm_lines, joint_frames, rigid_arm

ROWS = made_arm("rows", 61, [0.4, -1.1, 2.3])
ROWS["dh"] = [[*row, 0.3 * i - 0.8] for i, row in enumerate(ROWS["dh"])]
OLDER = {**ROWS, "tool_offset": ROWS["tool_offset_in_last_frame"]}  # as effective.toml of older runs calls it
del OLDER["tool_offset_in_last_frame"]
ARMS = {"chain": made_chain(5, 3), "rows": ROWS, "older": OLDER}


def placement(xyz, rpy):
    return pin.SE3(pin.rpy.rpyToMatrix(*rpy), np.array(xyz, float))


def model_of(arm):
    model, parent = pin.Model(), 0
    links = [placement(joint["xyz_m"], joint["rpy_rad"]) for joint in arm["joint"]] if "joint" in arm else [
        placement([a, 0, 0], [alpha, 0, 0]) * placement([0, 0, d], [0, 0, offset]) for alpha, a, d, offset in arm["dh"]]
    if "base" in arm:
        links[0] = placement(arm["base"]["xyz_m"], arm["base"]["rpy_rad"]) * links[0]
    for i, (link, body) in enumerate(zip(links, arm["bodies"])):
        parent = model.addJoint(parent, pin.JointModelRZ(), link, f"joint{i}")
        model.appendBodyToJoint(parent, pin.Inertia(body["mass"], np.array(body["com"]), np.array(body["inertia_about_com"])), pin.SE3.Identity())
    tool = pin.SE3(np.eye(3), np.array(arm["tool"]["xyz_m"] if "tool" in arm else ROWS["tool_offset_in_last_frame"]))
    return model, model.addFrame(pin.Frame("tool", parent, 0, tool, pin.FrameType.OP_FRAME))


@pytest.mark.parametrize("name", ARMS)
def test_poses_masses_and_link_frames_are_those_of_pinocchio(name):
    arm = ARMS[name]
    model, tool = model_of(arm)
    data = model.createData()
    q = np.random.default_rng(1).uniform(-3, 3, (20, model.nv))
    tips, M, lines = rigid_arm.tip(arm, q), rigid_arm.mass_matrix(arm, q), arm_lines.centre_line(arm, q)
    assert joint_frames.dof(arm) == model.nv
    for k, angles in enumerate(q):
        pin.framesForwardKinematics(model, data, angles)
        np.testing.assert_allclose(tips[k], data.oMf[tool].translation, atol=1e-12)
        np.testing.assert_allclose(lines[k][-1], tips[k], atol=1e-12)
        upper = np.triu(pin.crba(model, data, angles))
        np.testing.assert_allclose(M[k], upper + np.triu(upper, 1).T, atol=1e-11)
        last = pin.SE3.Identity()
        for _, p, (w, x, y, z) in arm_lines.joint_transforms(arm, angles):
            last = last * pin.SE3(pin.Quaternion(w, x, y, z).toRotationMatrix(), np.array(p))
        np.testing.assert_allclose(last.homogeneous, data.oMi[model.njoints - 1].homogeneous, atol=1e-12)


def test_frames_keep_their_names_and_others_are_numbered():
    zeros = np.zeros(6)
    assert [name for name, *_ in arm_lines.joint_transforms(ARMS["chain"], zeros)] == [f"frame_{i}" for i in range(5)]
    assert [name for name, *_ in arm_lines.joint_transforms(ROWS, zeros)] == [f"link_{i}" for i in range(1, 7)]
