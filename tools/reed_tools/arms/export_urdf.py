"""An arm file as a URDF: nominal links, joints about z, the tool point as a last fixed link."""

import xml.etree.ElementTree as xml

import numpy as np

from reed_tools.robots.chain import rpy_of
from reed_tools.robots.joint_frames import transform_of
from reed_tools.robots.nominal import NominalArm
from reed_tools.robots.pseudo_inertia import body_parts
from reed_tools.robots.regressor import PER_LINK

BASE, TOOL, WORLD = "base", "tool", "world"
SMALLEST_kg = 1e-9


def words(values) -> str:
    return " ".join(repr(float(value)) for value in values)


def urdf_of(arm: NominalArm, table: dict) -> str:
    """table: the arm file, for names of joints and frames."""
    root = xml.Element("robot", name=arm.name)
    root.append(xml.Comment(" Written by tools/reed arm export. A URDF has no rotor inertia, joint stiffness, members and boxes of parameters. "))
    joints = table.get("joint", [{}] * arm.dof)
    frames = [joint.get("frame") or f"link_{k + 1}" for k, joint in enumerate(joints)]
    frame_of = names_beside(frames)
    base, tool, world = frame_of(BASE), frame_of(TOOL), frame_of(WORLD)
    R, p = np.array(arm.chain.rotation), np.array(arm.chain.offset)
    if "base" in table:  # the chain holds it in its first step
        base_R, base_p = transform_of(table["base"])
        link(root, world)
        fixed(root, "base_mount", world, base, base_R, base_p)
        R[0], p[0] = base_R.T @ R[0], base_R.T @ (p[0] - base_p)
    link(root, base)
    parent = base
    for k, joint in enumerate(joints):
        element = xml.SubElement(root, "joint", name=joint.get("name") or f"joint_{k + 1}", type="revolute")
        placed(element, parent, frames[k], R[k], p[k])
        xml.SubElement(element, "axis", xyz="0 0 1")
        xml.SubElement(element, "limit", lower=words([arm.position_min[k]]), upper=words([arm.position_max[k]]),
                       effort=words([arm.torque_limit[k]]), velocity=words([arm.speed_limit[k]]))
        friction = {"damping": (arm.viscous @ arm.p)[k], "friction": arm.coulomb_declared[k]}
        if any(friction.values()):
            xml.SubElement(element, "dynamics", {key: words([value]) for key, value in friction.items()})
        link(root, frames[k], arm.inertial[PER_LINK * k:PER_LINK * (k + 1)])
        parent = frames[k]
    link(root, tool)
    fixed(root, "tool_mount", parent, tool, arm.chain.tool_rotation, arm.chain.tool_offset)
    xml.indent(root)
    return '<?xml version="1.0"?>\n' + xml.tostring(root, encoding="unicode") + "\n"


def names_beside(frames: list[str]):
    """A name that no frame of the arm has."""
    def free(name: str) -> str:
        while name in frames:
            name = f"{name}_"
        return name
    return free


def link(root: xml.Element, name: str, body: np.ndarray | None = None) -> None:
    element = xml.SubElement(root, "link", name=name)
    if body is None or body[0] < SMALLEST_kg:
        return
    parts = body_parts(body)
    inertia = np.array(parts["inertia_about_com"])
    given = xml.SubElement(element, "inertial")
    xml.SubElement(given, "origin", xyz=words(parts["com"]), rpy="0 0 0")
    xml.SubElement(given, "mass", value=words([parts["mass"]]))
    xml.SubElement(given, "inertia", {f"i{'xyz'[i]}{'xyz'[j]}": words([inertia[i, j]]) for i in range(3) for j in range(i, 3)})


def placed(element: xml.Element, parent: str, child: str, R: np.ndarray, p: np.ndarray) -> None:
    xml.SubElement(element, "parent", link=parent)
    xml.SubElement(element, "child", link=child)
    xml.SubElement(element, "origin", xyz=words(p), rpy=words(rpy_of(R)))


def fixed(root: xml.Element, name: str, parent: str, child: str, R: np.ndarray, p: np.ndarray) -> None:
    placed(xml.SubElement(root, "joint", name=name, type="fixed"), parent, child, R, p)
