"""Flexible members in any direction: the tip's compliance against PyNite and against the unit-load integral, modes against closed
forms. Several members on a link, skew ones, flat sections, rigid pieces between them, members without mass."""

import json
import math
import subprocess

import numpy as np
import pytest
from Pynite import FEModel3D

LIMIT = 1e-8
E, G = 7.0e10, 2.63e10
STIFF = ("EA", "EI_y", "EI_z", "GJ")


def rotation(rpy):
    (sx, sy, sz), (cx, cy, cz) = np.sin(rpy), np.cos(rpy)
    return (np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]]) @ np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
            @ np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]]))


def member(link, start, end, y=None, stiff=(9e6, 900.0, 250.0, 600.0), **more):
    return {"link": link, "from_m": start, "to_m": end, **dict(zip(STIFF, stiff)), **({"y_axis": y} if y else {}), **more}


def arm_of(name, joints, members, tool, **more):
    return {"name": name, "joint": [{"xyz_m": xyz, "rpy_rad": rpy} for xyz, rpy in joints], "tool": {"xyz_m": tool}, "member": members,
            "bodies": [{"mass": 1.0, "com": [0.0, 0.0, 0.1], "inertia_about_com": (1e-2 * np.eye(3)).tolist()} for _ in joints],
            "joint_stiffness": [5e3] * len(joints), **more}


JOINTS = [([0.1, 0.0, 0.2], [0.3, -0.2, 0.1]), ([0.3, 0.1, 0.25], [1.2, 0.4, -0.5]), ([0.2, -0.1, 0.3], [-0.7, 0.9, 0.2])]
CONNECTED = arm_of("connected", JOINTS, [
    member(1, [0.0, 0.0, 0.0], [0.0, 0.0, 0.25]), member(1, [0.0, 0.0, 0.25], [0.3, 0.1, 0.25], [0.2, 0.1, 1.0], rhoA=0.4),  # an L
    member(2, [0.0, 0.0, 0.0], [0.2, -0.1, 0.3], [0.0, 1.0, 0.0]),                                                          # skew, flat
    member(3, [0.0, 0.0, 0.0], [0.1, 0.2, 0.1], stiff=(9e6, 500.0, 500.0, 400.0)), member(3, [0.1, 0.2, 0.1], [0.3, 0.2, 0.0])],
    [0.3, 0.2, 0.0])
APART = arm_of("apart", JOINTS, [
    member(1, [0.05, 0.0, 0.02], [0.1, 0.1, 0.2], [1.0, 0.0, 0.5]), member(1, [0.1, -0.05, 0.2], [0.25, 0.1, 0.25]),
    member(3, [0.0, 0.02, 0.0], [-0.2, 0.05, 0.1], [0.0, 1.0, 1.0])], [-0.25, 0.1, 0.2])


def axes_of(item, R=np.eye(3)):
    """Columns along the member, y and z of its section."""
    x = np.subtract(item["to_m"], item["from_m"])
    x = x / np.linalg.norm(x)
    y = np.array(item.get("y_axis", np.eye(3)[(int(np.argmax(np.abs(x))) + 1) % 3]), float)
    y = y - x * (x @ y)
    y /= np.linalg.norm(y)
    return R @ np.column_stack([x, y, np.cross(x, y)])


def placed(arm, q):
    """Start, end and axes of every member, and the tool point, in the world."""
    R, p, found = np.eye(3), np.zeros(3), []
    for link, (joint, angle) in enumerate(zip(arm["joint"], q), start=1):
        p = p + R @ np.array(joint["xyz_m"])
        R = R @ rotation(np.array(joint["rpy_rad"])) @ rotation(np.array([0.0, 0.0, angle]))
        found += [(p + R @ np.array(item["from_m"]), p + R @ np.array(item["to_m"]), axes_of(item, R), item) for item in arm["member"] if item["link"] == link]
    return found, p + R @ np.array(arm["tool"]["xyz_m"])


def unit_load(arm, q):
    """C = Σ ∫ Aᵀ f A ds, with A the wrench at a section, in its axes, of a wrench at the tool point."""
    members, tool = placed(arm, q)
    C = np.zeros((6, 6))
    for start, end, axes, item in members:
        EA, EI_y, EI_z, GJ = (item[key] for key in STIFF)
        f, L = np.diag([1 / EA, 0, 0, 1 / GJ, 1 / EI_y, 1 / EI_z]), np.linalg.norm(end - start)
        for xi, weight in zip(*np.polynomial.legendre.leggauss(3)):
            r = tool - (start + (1 + xi) / 2 * (end - start))
            arm_of_force = np.array([[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]])
            A = np.block([[axes.T, np.zeros((3, 3))], [axes.T @ arm_of_force, axes.T]])
            C += weight * L / 2 * A.T @ f @ A
    return C


def turn_of(model, name, axes):
    """Degrees about the member that bring PyNite's own y axis to ours."""
    T = model.members[name].T()[:3, :3]
    return math.degrees(math.atan2(axes[:, 1] @ T[2], axes[:, 1] @ T[1]))


def pynite_tip(arm, q, wrench, self_weight):
    members, tool = placed(arm, q)
    model, gravity = FEModel3D(), np.array([0.0, 0.0, -9.81])
    model.add_material("m", E, G, 0.3, 0.0)
    for k, point in enumerate([members[0][0], *(end for _, end, _, _ in members)]):
        model.add_node(f"n{k}", *point)
    model.def_support("n0", *[True] * 6)
    for k, (_, _, axes, item) in enumerate(members):
        EA, EI_y, EI_z, GJ = (item[key] for key in STIFF)
        model.add_section(f"s{k}", EA / E, EI_y / E, EI_z / E, GJ / G)
        model.add_member(f"b{k}", f"n{k}", f"n{k + 1}", "m", f"s{k}")
        turn = turn_of(model, f"b{k}", axes)
        model.delete_member(f"b{k}")
        model.add_member(f"b{k}", f"n{k}", f"n{k + 1}", "m", f"s{k}", rotation=turn)
        assert abs(turn_of(model, f"b{k}", axes)) < 1e-9
        if self_weight:
            for axis, g in zip(("FX", "FY", "FZ"), gravity):
                model.add_member_dist_load(f"b{k}", axis, item.get("rhoA", 0.0) * g, item.get("rhoA", 0.0) * g)
    last = f"n{len(members)}"
    assert np.allclose(tool, members[-1][1], atol=1e-12)
    for axis, value in zip(("FX", "FY", "FZ", "MX", "MY", "MZ"), wrench):
        model.add_node_load(last, axis, value)
    model.analyze_linear(check_stability=False)
    return np.array([getattr(model.nodes[last], key)["Combo 1"] for key in ("DX", "DY", "DZ", "RX", "RY", "RZ")])


@pytest.fixture(scope="module")
def cases():
    rng = np.random.default_rng(8)
    return [{"q": rng.uniform(-np.pi, np.pi, 3).tolist(), "wrench_world_tip": rng.uniform(-10, 10, 6).tolist()} for _ in range(6)]


def test_the_tip_moves_as_in_pynite(inspect, cases, tmp_path):
    for case, result in zip(cases, inspect(CONNECTED, cases, tmp_path)):
        for name, self_weight in (("", False), ("_self_weight", True)):
            expected = pynite_tip(CONNECTED, case["q"], case["wrench_world_tip"], self_weight)
            got = np.array(result[f"tip_deflection_rigid_joints{name}"])
            assert np.linalg.norm(got - expected) < LIMIT * np.linalg.norm(expected)


@pytest.mark.parametrize("arm", [CONNECTED, APART], ids=lambda arm: arm["name"])
def test_the_compliance_is_the_unit_load_integral(arm, inspect, cases, tmp_path):
    for case, result in zip(cases, inspect(arm, cases, tmp_path)):
        expected = unit_load(arm, case["q"])
        assert np.linalg.norm(np.array(result["C_links"]) - expected) < LIMIT * np.linalg.norm(expected)


def modes_hz(program, tmp_path, arm, count):
    path = tmp_path / "arm.json"
    path.write_text(json.dumps(arm))
    done = subprocess.run([program, "--arm", str(path), "--modes", str(count)], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return np.array(json.loads(done.stdout)["freq_hz"])


def lone(members, body, tool):
    """One link behind a joint that is all but rigid."""
    return {**arm_of("lone", [([0.0] * 3, [0.0] * 3)], members, tool), "bodies": [body], "joint_stiffness": [1e9], "gravity": [0.0, 0.0, 0.0]}


def test_a_box_swings_in_each_plane_with_its_own_stiffness(inspect_program, tmp_path):
    end, width, height, wall = np.array([0.3, 0.2, 0.35]), 0.03, 0.05, 0.002
    length = np.linalg.norm(end)
    area = width * height - (width - 2 * wall) * (height - 2 * wall)
    EI_y = 7e10 * (width * height**3 - (width - 2 * wall) * (height - 2 * wall) ** 3) / 12
    EI_z = 7e10 * (height * width**3 - (height - 2 * wall) * (width - 2 * wall) ** 3) / 12
    rod = 2700 * area * length
    across = np.eye(3) - np.outer(end, end) / length**2
    body = {"mass": rod, "com": (end / 2).tolist(), "inertia_about_com": (rod * length**2 / 12 * across + 1e-9 * np.eye(3)).tolist()}
    box = {"link": 1, "to_m": end.tolist(), "box": {"width": width, "height": height, "wall": wall, "material": "aluminium"}}
    got = modes_hz(inspect_program, tmp_path, lone([box], body, end.tolist()), 2)
    first = 1.8751040687119611**2 / (2 * math.pi * length**2)
    assert got == pytest.approx([first * math.sqrt(EI / (2700 * area)) for EI in sorted((EI_y, EI_z))], rel=2e-5)


def test_a_frame_without_mass_carries_a_mass_on_springs(inspect_program, tmp_path):
    """The three modes of a point mass at the end of an L: C and m alone."""
    mass, end = 2.0, [0.2, 0.3, 0.3]
    frame = [member(1, [0.0, 0.0, 0.0], [0.0, 0.0, 0.3]), member(1, [0.0, 0.0, 0.3], end, [0.0, 0.0, 1.0])]
    arm = lone(frame, {"mass": mass, "com": end, "inertia_about_com": np.zeros((3, 3)).tolist()}, end)
    exact = 1 / (2 * np.pi * np.sqrt(mass * np.linalg.eigvalsh(unit_load(arm, [0.0])[:3, :3])[::-1]))
    assert modes_hz(inspect_program, tmp_path, arm, 3) == pytest.approx(exact, rel=1e-5)
