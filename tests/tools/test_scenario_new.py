"""tools/reed scenario new: what it writes runs at once and passes its checks; poses and slides keep their distance."""

import json

import numpy as np
import pinocchio as pin
import pytest
from built import reed
from imported import BODY, ROBOTS, imported, pinocchio_of, text_of

from reed_tools.robots import nominal, rigid_arm
from reed_tools.scenarios import gains, pose


@pytest.mark.parametrize("arm, what", [("a5", ["--press", "8"]), ("p2", ["--press", "8"]), ("a6", ["--press", "8"]), ("a5", ["--free"]), ("p2", ["--free"])])
def test_what_it_writes_passes_at_once(arm, what, tmp_path):
    path = tmp_path / "new.toml"
    assert reed("scenario", "new", "--arm", arm, *what, "--out", path).returncode == 0
    done = reed("run", path, "--bus", "memory", "--out", tmp_path / "run")
    assert done.returncode == 0, done.stdout + done.stderr
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert summary["verdict"] == "pass"
    if what[0] == "--press":
        assert summary["windows"][2]["force_rms_N"] < 0.03 * 8


@pytest.mark.parametrize("name, allows", [("so100", True), ("ur3", False)])
def test_a_wall_that_a_light_arm_meets_early_stops_nothing(name, allows, tmp_path):
    """The joint that the wall stops is as fast as a tenth of its limit."""
    (tmp_path / "robot.urdf").write_text(text_of(name))
    tip = ["--tip", ROBOTS[name][1]] if ROBOTS[name][1] else []
    assert reed("arm", "import", tmp_path / "robot.urdf", *tip, "--out", tmp_path / "robot.toml").returncode == 0
    assert reed("scenario", "new", "--arm", tmp_path / "robot.toml", "--press", "8", "--out", tmp_path / "press.toml").returncode == 0
    assert ("following_error_share" in (tmp_path / "press.toml").read_text()) == allows
    done = reed("run", tmp_path / "press.toml", "--bus", "memory", "--set", "wall.offset_m=0.001", "--out", tmp_path / "run")
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("argv, said", [
    (["--arm", "a5", "--press", "0"], "--press 0: allowed: 0.5 ... 500 N"),
    (["--arm", "a5", "--press", "400"], "in none of 3000 poses is it clear of singularities and limits while it presses 400 N"),
    (["--arm", "nobody", "--free"], "no such arm"),
    (["--arm", "a5"], "one of the arguments --press --free is required"),
])
def test_wrong_input_is_one_line(argv, said, tmp_path):
    done = reed("scenario", "new", *argv, "--out", tmp_path / "new.toml")
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1 and said in done.stderr, done.stderr
    assert not list(tmp_path.iterdir())


def test_nothing_is_overwritten(tmp_path):
    (tmp_path / "mine.toml").write_text("mine")
    done = reed("scenario", "new", "--arm", "p2", "--free", "--out", tmp_path / "mine.toml")
    assert done.returncode == 2 and "nothing was overwritten" in done.stderr and (tmp_path / "mine.toml").read_text() == "mine"


@pytest.mark.parametrize("name", ["a5", "a7", "p2"])
def test_inertia_and_jacobian_are_those_of_the_rigid_arm(name):
    """Two routes of the tools to the same numbers."""
    arm, table = nominal.load(name), nominal.read(nominal.path_of(name))
    q = np.random.default_rng(1).uniform(-1, 1, (20, arm.dof))
    points, J = pose.origins(arm.chain, q)
    assert np.allclose(J, rigid_arm.tip_jacobian(table, q), atol=1e-12) and np.allclose(points[:, -1], rigid_arm.tip(table, q), atol=1e-12)
    truth = {"bodies": nominal_bodies(arm), "dh": table["dh"]}
    assert np.allclose(gains.inertia(arm, q), rigid_arm.mass_matrix(truth, q) + np.diag(arm.rotor_inertia), atol=1e-10)


def nominal_bodies(arm):
    return [rigid_arm.body_of(body[0], body[1:4], np.array([[body[4], body[5], body[7]], [body[5], body[6], body[8]], [body[7], body[8], body[9]]]))
            for body in arm.inertial.reshape(arm.dof, -1)]


def test_the_start_keeps_its_distance(tmp_path):
    arm = nominal.load("a5")
    found = pose.find(arm, np.array([0.0, 0.0, 1.0]), 8.0, 0.02)
    room = arm.position_max - arm.position_min
    assert (np.minimum(found.q - arm.position_min, arm.position_max - found.q) > 0.149 * room).all()
    weight = np.abs(gains.gravity_torque(arm, found.q[None])[0])
    assert (weight < 0.5 * arm.torque_limit).all()
    assert np.abs(found.slide[2]) < 1e-9 and max(map(abs, found.slide)) > 0.005
    there = pose.follow(arm.chain, found.q, np.array(found.slide), found.q)
    assert np.allclose(pose.origins(arm.chain, there[None])[0][0, -1], found.tip + found.slide, atol=1e-6)


@pytest.mark.parametrize("name, force_N", [("jaco", 0.0), ("so100", 8.0)])
def test_a_slide_keeps_the_speed_limits_of_joints_that_hold_the_orientation(name, force_N, tmp_path):
    """A step along the slide's path by Pinocchio's Jacobian of all six directions; these wrists were too fast for a slide that was
    judged by its positions alone."""
    path = tmp_path / f"{name}.urdf"
    path.write_text(text_of(name))
    chain, arm = imported(path, *ROBOTS[name][1:])
    found = pose.find(arm, np.array([0.0, 0.0, 1.0]), force_N, 0.02)
    model = pinocchio_of(path.read_text(), chain)
    data, frame = model.createData(), model.getFrameId(chain.tip, BODY)
    for share in np.linspace(-1, 1, 5):
        q = pose.follow(arm.chain, found.q, share * np.array(found.slide), found.q)
        J = pin.computeFrameJacobian(model, data, pin.integrate(model, pin.neutral(model), q), frame, pin.LOCAL_WORLD_ALIGNED)
        along = pin.SE3(data.oMf[model.getFrameId(chain.base, BODY)]).rotation @ np.array(found.slide)
        speed = np.linalg.solve(J, [*(2 * np.pi * pose.FREQUENCY_HZ * along), 0, 0, 0])
        assert (np.abs(speed) < 1.1 * pose.SPEED * arm.speed_limit).all()
