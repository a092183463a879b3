"""Kinematics and rigid dynamics against Pinocchio: 1000 random states per arm, 1e-10 relative."""

import numpy as np
import pinocchio as pin
import pytest
from pinocchio_dynamics import dynamics

STATES = 1000
LIMIT = 1e-10


def turn(axis, angle):
    return pin.SE3(pin.AngleAxis(angle, np.array(axis, float)).toRotationMatrix(), np.zeros(3))


def placed(frame):
    """xyz and rpy as a URDF has them."""
    return pin.SE3(pin.rpy.rpyToMatrix(*frame["rpy_rad"]), np.array(frame["xyz_m"], float)) if frame else pin.SE3.Identity()


def placements(arm):
    """Of every link at joint angle 0 in the one before: from the table's joints, or from Craig rows."""
    along = lambda x, z: pin.SE3(np.eye(3), np.array([x, 0.0, z]))
    found = [placed(joint) for joint in arm["joint"]] if "joint" in arm else [
        turn([1, 0, 0], alpha) * along(a, 0.0) * turn([0, 0, 1], offset[0] if offset else 0.0) * along(0.0, d) for alpha, a, d, *offset in arm["dh"]]
    return [placed(arm.get("base")) * found[0], *found[1:]]


def model_of(arm, parameter=None):
    """With `parameter` only that parameter's unit shapes have mass."""
    model = pin.Model()
    model.gravity.linear = np.array(arm["gravity"], float)
    parent = 0
    for i, (placement, body) in enumerate(zip(placements(arm), arm["bodies"])):
        parent = model.addJoint(parent, pin.JointModelRZ(), placement, f"joint{i + 1}")
        inertia = pin.Inertia(body["mass"], np.array(body["com"], float), np.array(body["inertia_about_com"], float))
        if parameter is not None:
            inertia = pin.Inertia.Zero()
            for shape in parameter:
                if shape["body"] == i + 1:
                    inertia += pin.Inertia(float(shape["mass"]), np.array(shape["com"], float), np.array(shape["inertia_com"], float))
        model.appendBodyToJoint(parent, inertia, pin.SE3.Identity())
    tool = placed(arm.get("tool"))
    for older in ("tool_offset_in_last_frame", "tool_offset"):
        tool.translation = np.array(arm.get(older, tool.translation), float)
    frame = model.addFrame(pin.Frame("tool", parent, 0, tool, pin.FrameType.OP_FRAME))
    return model, frame


def random_states(arm, seed):
    rng = np.random.default_rng(seed)
    n = len(arm["bodies"])
    draw = lambda size: rng.uniform(-size, size, n).tolist()
    return [{"q": draw(np.pi), "qd": draw(2.5), "qdd": draw(9.0), "v": draw(2.5), "vd": draw(9.0)} for _ in range(STATES)]


@pytest.fixture
def states_and_results(arm, inspect, tmp_path):
    states = random_states(arm, 17)
    source = arm["name"].lower() if arm["name"].lower() in ("a5", "a7", "p2") else arm
    return states, inspect(source, states, tmp_path)


def expected(model, frame, state):
    q, qd, qdd = (np.array(state[k]) for k in ("q", "qd", "qdd"))
    data, out = dynamics(model, frame, q, qd, qdd)
    out["kinetic"] = pin.computeKineticEnergy(model, data, q, qd)
    out["potential"] = pin.computePotentialEnergy(model, data, q)
    return out


def test_pose_jacobian_dynamics_and_energies_are_those_of_pinocchio(arm, states_and_results):
    model, frame = model_of(arm)
    worst = {}
    for state, result in zip(*states_and_results):
        for name, value in expected(model, frame, state).items():
            error = np.linalg.norm(np.array(result[name]) - value) / max(np.linalg.norm(value), 1e-3)
            worst[name] = max(worst.get(name, 0.0), error)
    assert len(worst) == 9
    assert max(worst.values()) < LIMIT, worst


def test_euler_angles_rebuild_the_rotation(arm, states_and_results):
    for _, result in zip(*states_and_results):
        alpha, beta, gamma = result["euler_alpha_beta_gamma"]
        R = pin.rpy.rpyToMatrix(alpha, beta, gamma)
        assert np.allclose(R, np.array(result["T"])[:3, :3], rtol=0, atol=1e-12)


def shapes_of(arm):
    """As in the file; parameters that are named without shapes are the masses of the links, in order."""
    if "param_shapes" in arm:
        return arm["param_shapes"]
    return [{"param": name, "body": i + 1, "mass": 1.0, "com": body["com"],
             "inertia_com": np.array(body["inertia_about_com"]) / body["mass"]}
            for i, (name, body) in enumerate(zip(arm.get("param_names", []), arm["bodies"]))]


def christoffel_times_v(model, data, q, qd, v):
    """C(q, q̇) v by polarisation: ¼ [C(q̇+v)(q̇+v) - C(q̇-v)(q̇-v)]."""
    zero = np.zeros(model.nv)
    gravity = pin.rnea(model, data, q, zero, zero)
    quadratic = lambda w: pin.rnea(model, data, q, w, zero) - gravity
    return 0.25 * (quadratic(qd + v) - quadratic(qd - v))


def test_f_and_every_column_of_the_regressor_are_those_of_pinocchio(arm, states_and_results):
    model, _ = model_of(arm)
    data = model.createData()
    names = arm.get("param_names", [])
    shapes = {name: [s for s in shapes_of(arm) if s["param"] == name] for name in names}
    units = {name: model_of(arm, parts)[0] for name, parts in shapes.items() if any("body" in s for s in parts)}
    worst = 0.0
    for state, result in zip(*states_and_results):
        q, qd, v, vd = (np.array(state[k]) for k in ("q", "qd", "v", "vd"))
        zero = np.zeros(model.nv)
        f = pin.rnea(model, data, q, zero, vd) + christoffel_times_v(model, data, q, qd, v)
        for name, parts in shapes.items():
            column = np.zeros(model.nv)
            if name in units:
                unit, unit_data = units[name], units[name].createData()
                column += pin.rnea(unit, unit_data, q, zero, vd) + christoffel_times_v(unit, unit_data, q, qd, v)
            for part in parts:
                column += np.array(part.get("viscous_weights", zero)) * v
                f += arm["p_true"][names.index(name)] * np.array(part.get("viscous_weights", zero)) * v
            got = np.array(result["Y"])[:, names.index(name)]
            worst = max(worst, np.linalg.norm(got - column) / max(np.linalg.norm(column), 1e-3))
        for key in ("f", "f_from_Yp"):
            worst = max(worst, np.linalg.norm(np.array(result[key]) - f) / max(np.linalg.norm(f), 1e-3))
    assert worst < LIMIT


def test_cartesian_compliance_of_the_springs_is_the_jacobians(elastic_arm, inspect, tmp_path):
    model, frame = model_of(elastic_arm)
    data = model.createData()
    states = [{"q": s["q"]} for s in random_states(elastic_arm, 18)[:50]]
    source = "a5" if elastic_arm["name"].lower() == "a5" else elastic_arm
    for state, result in zip(states, inspect(source, states, tmp_path)):
        J = pin.computeFrameJacobian(model, data, np.array(state["q"]), frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
        C = J @ np.diag(1.0 / np.array(elastic_arm["joint_stiffness"])) @ J.T
        assert np.linalg.norm(np.array(result["C_joints"]) - C) < LIMIT * np.linalg.norm(C)
        assert result["rank_C_joints"] == np.linalg.matrix_rank(J, tol=1e-9)
