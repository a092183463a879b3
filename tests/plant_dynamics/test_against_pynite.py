"""Tip displacement of the bending links against a finite-element frame of PyNite."""

import numpy as np
import pytest
from Pynite import FEModel3D


def frame_points(arm, q):
    """Ends of the members, base to tip, and the local z axis of each."""
    R, p = np.eye(3), np.zeros(3)
    points, up = [p], []
    for i, (alpha, a, d) in enumerate(arm["dh"]):
        c, s = np.cos(alpha), np.sin(alpha)
        R = R @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
        c, s = np.cos(q[i]), np.sin(q[i])
        R = R @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        following = arm["dh"][i + 1][1] if i + 1 < len(arm["dh"]) else 0.0
        for step in (d * R[:, 2], following * R[:, 0]):
            if np.any(step):
                p = p + step
                points.append(p)
    return points


def pynite_tip(arm, q, force):
    model = FEModel3D()
    points = frame_points(arm, q)
    for i, point in enumerate(points):
        model.add_node(f"N{i}", *point)
    for i, section in enumerate(arm["sections"]):
        model.add_material(f"M{i}", 1.0, 1.0, 0.0, 1.0)  # unit moduli: the stiffnesses themselves are the section
        model.add_section(f"S{i}", section["EA"], section["EI"], section["EI"], section["GJ"])
        model.add_member(f"B{i}", f"N{i}", f"N{i + 1}", f"M{i}", f"S{i}")
    model.def_support("N0", True, True, True, True, True, True)
    tip = f"N{len(points) - 1}"
    for direction, value in zip(("FX", "FY", "FZ"), force):
        model.add_node_load(tip, direction, value)
    model.analyze_linear()
    node = model.nodes[tip]
    return points[-1], np.array([node.DX["Combo 1"], node.DY["Combo 1"], node.DZ["Combo 1"]])


@pytest.mark.parametrize("q", [[0.2, 0.6, -0.9, 0.5, 0.3], [0.0, 0.0, 0.0, 0.0, 0.0], [-1.2, 1.3, -2.0, -0.6, 1.0]])
@pytest.mark.parametrize("force", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-2.0, 1.0, 3.0]])
def test_tip_moves_as_in_pynite(probe, arm, q, force):
    small = 1e-3  # the plant is not linear, the frame is
    tip, moved = pynite_tip(arm, q, force)
    ours = probe("load", *q, *(small * f for f in force))
    assert np.abs(np.array(ours["tip"]) - tip).max() < 1e-12
    assert np.linalg.norm(np.array(ours["moved"]) / small - moved) < 1e-4 * np.linalg.norm(moved)
