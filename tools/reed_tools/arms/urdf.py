"""A URDF file read into links and joints. What cannot be meant is refused here, with the element's name."""

import math
import xml.etree.ElementTree as xml
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.robots.joint_frames import rotation_rpy
from reed_tools.robots.nominal import inertial
from reed_tools.text import plain

MOVING = ("revolute", "continuous", "prismatic", "planar", "floating")
LONGEST_NAME = 64
FARTHEST_m, HEAVIEST_kg = 10.0, 500.0
MARKER_kg = 1e-6  # a link below it names a frame and may be a point
ROUNDED = 1e-6  # of the largest moment: what a file's rounding may break


@dataclass
class Link:
    name: str
    body: np.ndarray | None  # ten parameters in the link's frame; None: it has no mass
    problem: str = ""        # why no body has them: refused where the link is used


@dataclass
class Joint:
    name: str
    kind: str
    parent: str
    child: str
    rotation: np.ndarray
    offset: np.ndarray
    axis: np.ndarray
    limit: dict[str, float] = field(default_factory=dict)     # lower, upper, effort, velocity
    dynamics: dict[str, float] = field(default_factory=dict)  # damping, friction
    mimic: bool = False

    @property
    def moves(self) -> bool:
        return self.kind in MOVING


@dataclass
class Robot:
    name: str
    where: str
    links: dict[str, Link]
    joints: dict[str, Joint]  # by child

    def root(self) -> str:
        roots = [name for name in self.links if name not in self.joints]
        if len(roots) != 1:
            raise UsageError(f"{self.where}: {len(roots)} links have no parent ({', '.join(roots[:4])}); allowed: one; --base LINK chooses one")
        return roots[0]

    def children(self, link: str) -> list[Joint]:
        return [joint for joint in self.joints.values() if joint.parent == link]


def read(path: Path) -> Robot:
    where = str(path)
    try:
        text = path.read_bytes()
    except OSError as error:
        raise UsageError(f"{where}: {(error.strerror or str(error)).lower()}") from None
    try:
        root = xml.fromstring(text)
    except (xml.ParseError, ValueError, LookupError) as error:
        raise UsageError(f"{where}: is no XML: {error}") from None
    refuse_xacro(root, where)
    if root.tag != "robot":
        raise UsageError(f"{where}: its root is <{plain(root.tag)}>; allowed: <robot>, a URDF")
    links = {}
    for element in root.findall("link"):
        name = name_of(element, where)
        if name in links:
            raise UsageError(f"{where}: link {name} is there twice")
        links[name] = link_of(element, name, f"{where}: link {name}")
    joints, names = {}, set()
    for element in root.findall("joint"):
        joint = joint_of(element, where)
        for link in (joint.parent, joint.child):
            if link not in links:
                raise UsageError(f"{where}: joint {joint.name}: there is no link {plain(link)}")
        if joint.child in joints:
            raise UsageError(f"{where}: link {joint.child} has two parents, joints {joints[joint.child].name} and {joint.name}: a loop; allowed: a tree")
        if joint.name in names:
            raise UsageError(f"{where}: joint {joint.name} is there twice")
        names.add(joint.name)
        joints[joint.child] = joint
    refuse_loops(links, joints, where)
    return Robot(root.get("name") or path.stem, where, links, joints)


def refuse_loops(links: dict[str, Link], joints: dict[str, Joint], where: str) -> None:
    for start in links:
        link, steps = start, 0
        while link in joints:
            link, steps = joints[link].parent, steps + 1
            if steps > len(joints):
                raise UsageError(f"{where}: the joints before link {start} form a loop; allowed: a tree")


def refuse_xacro(root: xml.Element, where: str) -> None:
    for element in root.iter():
        values = [value for value in element.attrib.values() if "${" in value or "$(" in value]
        if "xacro" in str(element.tag) or values:
            raise UsageError(f"{where}: is unexpanded xacro ({plain(values[0][:40] if values else 'xacro:' + str(element.tag).rpartition('}')[2])}); `xacro FILE > ROBOT.urdf` expands it")


def name_of(element: xml.Element, where: str) -> str:
    name = element.get("name", "")
    if not name or len(name) > LONGEST_NAME or not all("!" <= letter <= "~" for letter in name):
        raise UsageError(f"{where}: {element.tag} {plain(name)[:80]!r}: allowed as a name: 1 ... {LONGEST_NAME} printable ASCII characters, no space")
    return name


def numbers(element: xml.Element | None, key: str, where: str, default: tuple) -> np.ndarray:
    text = element.get(key) if element is not None else None
    if text is None:
        return np.array(default)
    try:
        found = [float(word) for word in text.split()]
    except ValueError:
        found = []
    if len(found) != len(default) or not all(map(math.isfinite, found)):
        raise UsageError(f"{where}: {key}={plain(text)[:40]!r}; allowed: {len(default)} finite number{'s' if len(default) > 1 else ''}")
    return np.array(found)


def origin_of(element: xml.Element, where: str) -> tuple[np.ndarray, np.ndarray]:
    origin = element.find("origin")
    xyz, rpy = numbers(origin, "xyz", where, (0.0,) * 3), numbers(origin, "rpy", where, (0.0,) * 3)
    if np.abs(xyz).max() > FARTHEST_m:
        raise UsageError(f"{where}: its origin lies {np.abs(xyz).max():g} m away; allowed: {FARTHEST_m:g} m (metres, not millimetres)")
    return rotation_rpy(rpy), xyz


def link_of(element: xml.Element, name: str, where: str) -> Link:
    given = element.find("inertial")
    if given is None:
        return Link(name, None)
    R, com = origin_of(given, where)
    mass = float(numbers(given.find("mass"), "value", where, (0.0,))[0])
    xx, xy, xz, yy, yz, zz = (float(numbers(given.find("inertia"), key, where, (0.0,))[0]) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"))
    inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    if mass == 0 and not inertia.any():
        return Link(name, None)
    least, middle, most = np.linalg.eigvalsh(inertia)
    if 0 < mass <= HEAVIEST_kg and (most > 0 or mass < MARKER_kg) and least >= -ROUNDED * most and most <= (1 + ROUNDED) * (least + middle):
        return Link(name, inertial(mass, com, R @ inertia @ R.T))
    return Link(name, None, f"{where}: no body has a mass of {mass:g} kg and the principal moments {least:.4g}, {middle:.4g}, {most:.4g} kg·m²; allowed: a mass "
                f"above 0, up to {HEAVIEST_kg:g} kg, moments above 0, none larger than the two others together")


def joint_of(element: xml.Element, where: str) -> Joint:
    name = name_of(element, where)
    here = f"{where}: joint {name}"
    kind = element.get("type", "")
    if kind not in (*MOVING, "fixed"):
        raise UsageError(f"{here}: type {plain(kind)!r}; allowed: revolute, continuous, fixed")
    ends = [element.find(end).get("link", "") if element.find(end) is not None else "" for end in ("parent", "child")]
    R, p = origin_of(element, here)
    axis = numbers(element.find("axis"), "xyz", here, (1.0, 0.0, 0.0))
    if kind in MOVING and kind != "floating":
        length = np.linalg.norm(axis)
        if length < 1e-6:
            raise UsageError(f"{here}: its axis is zero")
        axis = axis / length
    limit, dynamics = element.find("limit"), element.find("dynamics")
    read_of = lambda part, keys: {key: float(numbers(part, key, here, (0.0,))[0]) for key in keys if part is not None and part.get(key) is not None}
    return Joint(name, kind, *ends, R, p, axis, read_of(limit, ("lower", "upper", "effort", "velocity")),
                 read_of(dynamics, ("damping", "friction")), element.find("mimic") is not None)
