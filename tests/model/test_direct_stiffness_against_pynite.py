"""Nodal displacements (5), (6) against PyNite: end wrench and self-weight, rigid joints, 1e-8 relative."""

import numpy as np
from Pynite import FEModel3D

LIMIT = 1e-8
E, G = 7.0e10, 2.63e10


def frames(arm, q):
    T = np.eye(4)
    for (alpha, a, d), theta in zip(arm["dh"], q):
        ca, sa, c, s = np.cos(alpha), np.sin(alpha), np.cos(theta), np.sin(theta)
        T = T @ np.array([[c, -s, 0, a], [s * ca, c * ca, -sa, -d * sa], [s * sa, c * sa, ca, d * ca], [0, 0, 0, 1]])
        yield T


def nodes_of(arm, q):
    """Ends of the members from base to tip: up to each origin along z, then to the next joint along x; and the tool."""
    Ts = list(frames(arm, q))
    points = []
    for i, T in enumerate(Ts):
        if arm["dh"][i][2]:
            points.append(T[:3, 3])
        if i + 1 < len(Ts) and arm["dh"][i + 1][1]:
            points.append(T[:3, 3] + arm["dh"][i + 1][1] * T[:3, 0])
    tool = np.array(arm.get("tool_offset_in_last_frame", [0, 0, 0]), float)
    return points, Ts[-1][:3, :3] @ tool + Ts[-1][:3, 3]


def pynite(arm, q, wrench, self_weight):
    points, tool = nodes_of(arm, q)
    start = points[0] - arm["dh"][0][2] * np.array([0, -np.sin(arm["dh"][0][0]), np.cos(arm["dh"][0][0])])
    model = FEModel3D()
    model.add_material("m", E, G, 0.3, 0.0)
    for k, p in enumerate([start, *points]):
        model.add_node(f"n{k}", *p)
    model.def_support("n0", *[True] * 6)
    gravity = np.array(arm["gravity"], float)
    for k, section in enumerate(arm["sections"]):
        model.add_section(f"s{k}", section["EA"] / E, section["EI"] / E, section["EI"] / E, section["GJ"] / G)
        model.add_member(f"b{k}", f"n{k}", f"n{k + 1}", "m", f"s{k}")
        if self_weight:
            for axis, g in zip(("FX", "FY", "FZ"), gravity):
                model.add_member_dist_load(f"b{k}", axis, section["rhoA"] * g, section["rhoA"] * g)
    end = f"n{len(points)}"
    F, M = np.array(wrench[:3]), np.array(wrench[3:])
    M = M + np.cross(tool - points[-1], F)
    for axis, value in zip(("FX", "FY", "FZ", "MX", "MY", "MZ"), [*F, *M]):
        model.add_node_load(end, axis, value)
    model.analyze_linear(check_stability=False)
    read = lambda n: [getattr(n, k)["Combo 1"] for k in ("DX", "DY", "DZ", "RX", "RY", "RZ")]
    return np.array([read(model.nodes[f"n{k + 1}"]) for k in range(len(points))])


def test_node_displacements_are_those_of_pynite(elastic_arm, inspect, tmp_path):
    rng = np.random.default_rng(5)
    n = len(elastic_arm["dh"])
    cases = [{"q": rng.uniform(-np.pi, np.pi, n).tolist(), "wrench_world_tip": rng.uniform(-10, 10, 6).tolist()}
             for _ in range(10)]
    source = "a5" if elastic_arm["name"].lower() == "a5" else elastic_arm
    for case, result in zip(cases, inspect(source, cases, tmp_path)):
        for case_of in ("rigid_joints", "self_weight"):
            oracle = pynite(elastic_arm, case["q"], case["wrench_world_tip"], case_of == "self_weight")
            for route in ("", "_by_matrix"):  # the serial form of the loop, and the aggregated system (5)
                got = np.array(result[f"node_deflections_{case_of}{route}"])
                assert got.shape == oracle.shape
                for a, b in zip(got, oracle):
                    assert np.linalg.norm(a - b) < LIMIT * np.linalg.norm(b)
