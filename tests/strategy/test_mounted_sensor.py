"""What the force sensor reads of a hanging tool: the plant against Pinocchio, in every pose of a free motion, at rest and moving."""

import tomllib

import numpy as np
import pinocchio as pin
import pytest

from reed_tools.record import telemetry_log
from reed_tools.run import hil, plans, scenario

MASS_kg, COM_m = 0.5, [0.02, -0.03, 0.06]
ENTRIES = [
    "plant.flexible_links=false", "sensors.force_noise_N=0", "sensors.force_quantum_N=0", "sensors.moment_noise_Nm=0",
    "sensors.moment_quantum_Nm=0", "sensors.force_bias_N=[3, -2, 4]", "sensors.moment_bias_Nm=[0.3, 0.2, -0.4]", "scenario.duration_s=1",
    "arm.base.xyz_m=[0.1, 0.2, 0.3]", "arm.base.rpy_rad=[0.3, -0.2, 0.5]", "arm.force_sensor.xyz_m=[0.01, 0.02, -0.07]",
    "arm.force_sensor.rpy_rad=[0.4, -1.1, 2.0]", f"arm.force_sensor.tool_mass_kg={MASS_kg}", f"arm.force_sensor.tool_com_m={COM_m}"]
BIAS = np.array([3, -2, 4, 0.3, 0.2, -0.4])


def placement(frame) -> pin.SE3:
    return pin.SE3(pin.rpy.rpyToMatrix(np.array(frame["rpy_rad"])), np.array(frame["xyz_m"]))


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sensor")
    effective = scenario.write_effective("free_motion", None, ENTRIES, folder / "effective.toml")
    plan = plans.make(effective, folder / "effective.toml", hil.MEMORY, "lockstep", folder)
    assert hil.run(plan, lambda mode, t_s: None).statuses == {"one_process": 0}
    arm = tomllib.loads((folder / "effective.toml").read_text())["arm"]
    return arm, telemetry_log.load(plan.log("firmware"), plan.log("plant")).tables


def sensor_of(arm):
    """Pinocchio's model with the tool alone, as one body fixed to the sensor, and the sensor's frame."""
    model, parent, mount = pin.Model(), 0, placement(arm["base"])
    model.gravity.linear = np.array(arm["gravity"])
    for alpha, a, d, *_ in arm["dh"]:
        mount = mount * pin.SE3(pin.utils.rotate("x", alpha), np.array([a, 0.0, 0.0]))
        parent = model.addJoint(parent, pin.JointModelRZ(), mount, f"joint{parent + 1}")
        mount = pin.SE3(np.eye(3), np.array([0.0, 0.0, d]))
    at = mount * placement(arm["force_sensor"])
    tool = pin.Inertia(MASS_kg, np.array(COM_m), np.zeros((3, 3)))
    return model, model.addFrame(pin.Frame("sensor", parent, 0, at, pin.FrameType.OP_FRAME)), tool


def tool_wrench(model, frame, tool, q, v, a):
    """Force and moment that the tool puts on the sensor, in its frame."""
    data = model.createData()
    pin.forwardKinematics(model, data, q, v, a)
    pin.updateFramePlacements(model, data)
    acceleration = pin.getFrameAcceleration(model, data, frame, pin.LOCAL)
    acceleration.linear -= data.oMf[frame].rotation.T @ model.gravity.linear
    velocity = pin.getFrameVelocity(model, data, frame, pin.LOCAL)
    return -(tool * acceleration + velocity.cross(tool * velocity)).vector


def test_it_is_the_tools_weight_and_inertia_in_its_own_axes(recording):
    arm, tables = recording
    plant, measured = tables["REED_PLANT"], tables["REED_MEASURED"]
    q, h = plant["joint_angle"], 1e-3
    model, frame, tool = sensor_of(arm)
    assert (plant["cycle"] == measured["cycle"]).all() and not measured["wrench_age"].any()
    moving = 0
    for k in range(2, len(q) - 1, 3):
        read = np.concatenate([measured["force"][k], measured["moment"][k]]) - BIAS
        v, a = (q[k + 1] - q[k - 1]) / (2 * h), (q[k + 1] - q[k] - q[k - 1] + q[k - 2]) / (2 * h**2)  # the mean over the last step
        expected = tool_wrench(model, frame, tool, q[k], v, a)
        assert read[:3] == pytest.approx(expected[:3], abs=0.015)
        assert read[3:] == pytest.approx(expected[3:], abs=0.001)
        moving += np.abs(expected - tool_wrench(model, frame, tool, q[k], 0 * v, 0 * a))[:3].max() > 0.2
    assert moving >= 50, "its inertia is felt in many of them"


def test_the_controller_takes_weight_and_bias_off_in_every_pose(recording):
    _, tables = recording
    control, measured = tables["REED_CONTROL"], tables["REED_MEASURED"]
    active = control["mode"] == 2
    assert np.ptp(measured["force"][active], axis=0).max() > 0.5, "the weight turns in the sensor for this to mean anything"
    assert np.abs(control["tip_force"][active]).max() < 1.0, "what is left is the tool's inertia, 0.5 kg"
    assert np.abs(control["tip_force"][active].mean(axis=0)).max() < 0.1
