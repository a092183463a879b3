"""Arm files from URDFs of real robots: against Pinocchio reading the same file, back and forth, and the refusals."""

import dataclasses
import json
import re
import tomllib

import numpy as np
import pinocchio as pin
import pytest
from imported import BODY, ROBOTS, imported, pinocchio_of, text_of

from reed_tools import cli
from reed_tools.arms import arm_file, check, export_urdf, picture, serial, urdf
from reed_tools.robots import nominal, pseudo_inertia, regressor
from reed_tools.robots.chain import rpy_of, turn_of_z
from reed_tools.robots.joint_frames import rotation_rpy

STATES = 200


def rnea_and_pose(model, base, tip, states):
    data, results = model.createData(), []
    for q, qd, qdd in zip(*states):
        q = pin.integrate(model, pin.neutral(model), q)  # joints without an end have two coordinates there
        tau = pin.rnea(model, data, q, qd, qdd).copy()
        pin.framesForwardKinematics(model, data, q)
        pose = data.oMf[model.getFrameId(base, BODY)].actInv(data.oMf[model.getFrameId(tip, BODY)])
        results.append((tau, pose.rotation.copy(), pose.translation.copy()))
    return [np.array(part) for part in zip(*results)]


def own(arm, states):
    tau = regressor.inverse_dynamics(arm.chain, *states) @ arm.inertial
    poses = [picture.frames(arm.chain, q)[-1] for q in states[0]]
    return tau, np.array([R for R, _ in poses]), np.array([p for _, p in poses])


def relative(one, other):
    return np.abs(one - other).max() / max(np.abs(other).max(), 1e-3)


@pytest.mark.parametrize("disturbed", [False, True], ids=["as published", "calibrated"])
@pytest.mark.parametrize("name", ROBOTS)
def test_pose_and_dynamics_are_those_of_pinocchio(name, disturbed, tmp_path):
    path = tmp_path / f"{name}.urdf"
    path.write_text(text_of(name, disturbed))
    found, arm = imported(path, *ROBOTS[name][1:])
    states = np.random.default_rng(5).uniform(-3, 3, (3, STATES, arm.dof))
    for ours, theirs in zip(own(arm, states), rnea_and_pose(pinocchio_of(path.read_text(), found), found.base, found.tip, states)):
        assert relative(ours, theirs) < 1e-10


@pytest.mark.parametrize("name", ROBOTS)
def test_export_and_import_keep_the_model(name, tmp_path):
    path = tmp_path / "first.urdf"
    path.write_text(text_of(name, disturbed=True))
    found, arm = imported(path, *ROBOTS[name][1:])
    back = tmp_path / "second.urdf"
    back.write_text(export_urdf.urdf_of(arm, tomllib.loads(arm_file.text_of(found, "arm", "first.urdf"))))
    again, arm_again = imported(back, None, {})
    assert [(joint.name, joint.frame) for joint in again.joints] == [(joint.name, joint.frame) for joint in found.joints]
    for key in ("rotation", "offset", "tool_rotation", "tool_offset"):
        assert np.abs(getattr(arm.chain, key) - getattr(arm_again.chain, key)).max() < 1e-12
    for key in ("inertial", "torque_limit", "position_min", "position_max", "speed_limit", "rotor_inertia", "stiffness", "p", "p_lo", "p_hi", "viscous"):
        assert relative(getattr(arm_again, key), getattr(arm, key)) < 1e-12, key
    states = np.random.default_rng(6).uniform(-3, 3, (3, STATES, arm.dof))
    for ours, theirs in zip(own(arm, states), rnea_and_pose(pinocchio_of(back.read_text(), again), again.base, again.tip, states)):
        assert relative(ours, theirs) < 1e-10


def test_axes_of_every_direction_become_z():
    rng = np.random.default_rng(2)
    for axis in [*np.eye(3), *-np.eye(3), *rng.normal(size=(20, 3))]:
        R = turn_of_z(axis)
        assert np.abs(R.T @ R - np.eye(3)).max() < 1e-15 * 4 and np.linalg.det(R) > 0
        assert np.abs(R[:, 2] - axis / np.linalg.norm(axis)).max() < 1e-15 * 4


def test_angles_give_their_rotation_back_also_near_the_pole():
    rng = np.random.default_rng(3)
    for pitch in (0.3, np.pi / 2, -np.pi / 2, np.pi / 2 - 1e-9, np.pi / 2 - 1e-13, 1.5708, 1.57):
        for _ in range(20):
            R = rotation_rpy([*rng.uniform(-3, 3, 1), pitch, *rng.uniform(-3, 3, 1)])
            assert np.abs(rotation_rpy(rpy_of(R)) - R).max() < 1e-14


ARM = """<robot name="two"><link name="base"/>
<link name="one"><inertial><origin xyz="0.1 0 0"/><mass value="1"/><inertia ixx="0.01" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="two"><inertial><origin xyz="0.1 0 0"/><mass value="1"/><inertia ixx="0.01" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="j1" type="revolute"><parent link="base"/><child link="one"/><axis xyz="0 0 1"/><limit lower="-2" upper="2" effort="40" velocity="3"/></joint>
<joint name="j2" type="revolute"><origin xyz="0.3 0 0"/><parent link="one"/><child link="two"/><axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="20" velocity="3"/></joint>
</robot>"""
BRANCH = '<link name="camera"/><joint name="mount" type="fixed"><parent link="one"/><child link="camera"/></joint></robot>'


@pytest.fixture
def refusal(tmp_path, capsys):
    """The line that `arm import` refuses a URDF with; nothing is written."""
    def line(text, tip=None, base=None, limits=()):
        path = tmp_path / "robot.urdf"
        path.write_text(text)
        given = [word for option, value in (("--tip", tip), ("--base", base), *(("--limit", entry) for entry in limits)) if value for word in (option, value)]
        assert reed("arm", "import", path, "--out", tmp_path / "arm.toml", *given) == 2
        out, err = capsys.readouterr()
        assert out == "" and len(err.splitlines()) == 1 and not (tmp_path / "arm.toml").exists()
        return err
    return line


@pytest.mark.parametrize("old, new, said", [
    ('xyz="0.3 0 0"', 'xyz="${length} 0 0"', "is unexpanded xacro (${length} 0 0)"),
    ("</robot>", '<xacro:include xmlns:xacro="http://www.ros.org/wiki/xacro" filename="a"/></robot>', "is unexpanded xacro (xacro:include)"),
    ("</robot>", BRANCH, "2 tips (two, camera); --tip LINK chooses one"),
    ('<axis xyz="0 1 0"/>', '<mimic joint="j1"/>', "joint j2 mimics another"),
    ('"j2" type="revolute"', '"j2" type="prismatic"', "joint j2 is prismatic"),
    ('"j2" type="revolute"', '"j2" type="planar"', "joint j2 is planar"),
    ('"j2" type="revolute"', '"j2" type="continuous"', "joint j2 is continuous: lower, upper missing; --limit j2=LOWER,UPPER"),
    ('"j2" type="revolute"', '"j2" type="ball"', "joint j2: type 'ball'; allowed: revolute, continuous, fixed"),
    ('effort="20"', '', "joint j2 has no limits: effort missing"),
    ('effort="20"', 'effort="0"', "0 N·m"),
    ('lower="-2" upper="2" effort="20"', 'lower="-120" upper="120" effort="20"', "radians, not degrees"),
    ('xyz="0.3 0 0"', 'xyz="300 0 0"', "metres, not millimetres"),
    ('xyz="0.3 0 0"', 'xyz="0.3 0"', "xyz='0.3 0'; allowed: 3 finite numbers"),
    ('xyz="0.3 0 0"', 'xyz="nan 0 0"', "allowed: 3 finite numbers"),
    ('"base"/>', '"bäse"/>', "allowed as a name"),
    ('<axis xyz="0 1 0"/>', '<axis xyz="0 0 0"/>', "its axis is zero"),
    ('ixx="0.01" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>\n<joint', 'ixx="0.01" iyy="0.02" izz="0.09" ixy="0" ixz="0" iyz="0"/></inertial></link>\n<joint',
     "link two: no body has a mass of 1 kg and the principal moments 0.01, 0.02, 0.09 kg·m²"),
    ('<link name="two"><inertial>', '<link name="two"><was>', "is no XML"),
    ('child link="two"', 'child link="nobody"', "there is no link nobody"),
    ('parent link="base"', 'parent link="two"', "form a loop"),
    ('<robot name="two">', '<sdf>', "is no XML"),
])
def test_what_cannot_be_an_arm_is_refused_by_name(refusal, old, new, said):
    assert old in ARM
    assert said in refusal(ARM.replace(old, new))


def test_links_without_mass_and_wrong_names_are_refused(refusal):
    bare = re.sub(r'(<link name="two">).*?(</link>)', r"\1\2", ARM)
    assert "link two and what is fixed to it have no mass" in refusal(bare)
    assert "--tip nobody: " in refusal(ARM, tip="nobody")
    assert "link one is not behind link two" in refusal(ARM, tip="one", base="two")
    assert "--limit j3: no joint of the chain; allowed: j1, j2" in refusal(ARM, limits=["j3=-3,3"])
    assert "no tip" in refusal('<robot name="one"><link name="base"/></robot>')
    many = "".join(f'<link name="l{k}"/><joint name="x{k}" type="revolute"><parent link="{"two" if k == 0 else f"l{k - 1}"}"/><child link="l{k}"/>'
                   '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>' for k in range(7))
    assert "9 joints between base and tip; allowed: 1 ... 8" in refusal(ARM.replace("</robot>", many + "</robot>"))


def test_masses_of_what_is_fixed_or_held_are_not_lost(tmp_path):
    path = tmp_path / "robot.urdf"
    finger = ('<link name="finger"><inertial><mass value="0.5"/><inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0" iyz="0"/></inertial></link>'
              '<joint name="grip" type="prismatic"><origin xyz="0.2 0 0"/><parent link="two"/><child link="finger"/><limit lower="0" upper="0.04" effort="1" velocity="1"/></joint></robot>')
    path.write_text(ARM.replace("</robot>", finger))
    found, arm = imported(path, "two", {})
    assert found.held == ["grip"] and arm.inertial[regressor.PER_LINK] == pytest.approx(1.5)
    assert "held at 0: grip" in arm_file.text_of(found, "x", "y")


def test_friction_of_the_urdf_is_taken_and_the_rest_is_marked(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text(ARM.replace('effort="20" velocity="3"/>', 'effort="20" velocity="3"/><dynamics damping="0.7" friction="0.4"/>'))
    found, arm = imported(path, None, {})
    text = arm_file.text_of(found, "x", "y")
    assert arm.coulomb.tolist() == [0.0, 0.4] and arm.coulomb_declared.tolist() == [0.4, 0.4] and (arm.viscous @ arm.p).tolist() == [0.12, 0.7]
    assert "assumed for joint 1: 1 % of torque_limit" in text and text.count("# ") > 8
    for key in ("rotor_inertia_reflected", "joint_stiffness", "p_lo", "p_hi"):
        assert re.search(rf"^{key} = .*assumed", text, re.M), key


def test_links_bend_by_the_rule_unless_they_are_to_be_rigid(tmp_path):
    """Slope at the end of a cantilever under a moment, T L / E I: 1 mrad at the torque limit of the joint that moves the link."""
    path = tmp_path / "robot.urdf"
    path.write_text(ARM.replace("</robot>", """<link name="three"><inertial><mass value="1"/><inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="j3" type="revolute"><origin xyz="0.01 0 0"/><parent link="two"/><child link="three"/><limit lower="-2" upper="2" effort="9" velocity="3"/></joint></robot>"""))
    found, arm = imported(path, None, {})
    text = arm_file.text_of(found, "x", "y")
    member, = tomllib.loads(text)["member"]  # from joint 2 to joint 3 is no more than a housing; the last link holds the tool
    assert arm.bends and member["link"] == 1 and member["to_m"] == found.joints[1].offset.tolist() and text.count("[[member]]   # assumed") == 1
    outer, wall = member["tube"]["outer"], member["tube"]["wall"]
    assert 40 * 0.3 / (70e9 * np.pi / 64 * (outer**4 - (outer - 2 * wall) ** 4)) == pytest.approx(1e-3, rel=2e-3)
    rigid = arm_file.text_of(found, "x", "y", rigid=True)
    assert "member" not in tomllib.loads(rigid) and "Links are rigid." in rigid and not nominal.of_table(tomllib.loads(rigid), "y").bends


def reed(*argv):
    return cli.main([str(word) for word in argv])


def test_the_commands_write_once_and_say_what(tmp_path, capsys):
    (tmp_path / "robot.urdf").write_text(ARM)
    assert reed("arm", "import", tmp_path / "robot.urdf", "--out", tmp_path / "a.toml", "--json") == 0
    assert json.loads(capsys.readouterr().out) == {"arm": "two", "file": str(tmp_path / "a.toml"), "dof": 2, "base": "base", "tip": "two", "held": []}
    assert reed("arm", "import", tmp_path / "robot.urdf", "--out", tmp_path / "a.toml") == 2
    assert "nothing was overwritten" in capsys.readouterr().err
    assert reed("arm", "export", tmp_path / "a.toml", "--out", tmp_path / "b.urdf") == 0
    assert reed("arm", "export", tmp_path / "a.toml", "--out", tmp_path / "b.urdf") == 2
    assert reed("arm", "import", tmp_path / "robot.urdf", "--out", tmp_path / "r.toml", "--rigid") == 0
    assert "[[member]]" in (tmp_path / "a.toml").read_text() and "[[member]]" not in (tmp_path / "r.toml").read_text()
    capsys.readouterr()
    assert reed("arm", "import", tmp_path / "robot.urdf", "--out", tmp_path / "c.toml", "--limit", "j1=1") == 2
    assert "--limit j1=1: allowed: JOINT=LOWER,UPPER" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["a5", "a7", "p2"])
def test_arms_of_ours_are_sound_and_drawn(name, tmp_path, capsys):
    assert reed("arm", "check", name, "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert set(found) == {"arm", "dof", "mass_kg", "reach_m", "warnings", "modes_hz"} and found["warnings"] == [] and len(found["modes_hz"]) == 4
    assert reed("arm", "show", name, "--out", tmp_path / "arm.png") == 0
    assert (tmp_path / "arm.png").read_bytes()[:4] == b"\x89PNG"
    assert reed("arm", "show", name, "--at", "1,2,x") == 2


def test_an_arm_is_judged():
    arm = nominal.load("a7")

    def judged(part, **changes):
        return " ".join(part(dataclasses.replace(arm, **changes)))

    millimetres = dataclasses.replace(arm.chain, offset=1000 * arm.chain.offset)
    assert "lengths in metres?" in judged(check.units, chain=millimetres)
    assert "masses in kilograms?" in judged(check.units, known=1000 * arm.known, shapes=1000 * arm.shapes)
    heavy = arm.known.copy()
    heavy[4:10] += 100
    assert "inertia in kg·m²" in judged(check.units, known=heavy)
    assert "limits in radians?" in judged(check.units, position_max=arm.position_min + 0.01)
    assert "holds the arm's weight in" in judged(check.limits, torque_limit=0.01 * arm.torque_limit)
    body = arm.known.copy()
    body[7] += 5.0
    assert "link 1: no body has its nominal mass" in judged(check.bodies, known=body)
    assert check.resonances([2.0, 9.0], 1000.0) and check.resonances([60.0], 1000.0) and not check.resonances([20.0], 1000.0)
    assert all(pseudo_inertia.possible(body) for body in arm.inertial.reshape(7, 10))
