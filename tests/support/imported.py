"""URDFs of real robots from wheels, imported, and as Pinocchio reads them."""

import tomllib
import xml.etree.ElementTree as xml

import numpy as np
import pinocchio as pin
from robot_files import urdf as urdf_text

from reed_tools.arms import arm_file, serial, urdf
from reed_tools.robots import nominal

BODY = pin.FrameType.BODY
ENDLESS = [-3.0, 3.0]  # limits for joints that turn without end
JACO = {f"j2s6s200_joint_{k}": ENDLESS for k in (1, 4, 5, 6)}
ROBOTS = {  # file, tip, limits
    "ur3": ("ur_description/urdf/ur3_robot.urdf", "tool0", {}),
    "ur5": ("ur_description/urdf/ur5_robot.urdf", "tool0", {}),
    "ur10": ("ur_description/urdf/ur10_robot.urdf", "tool0", {}),
    "panda": ("panda_description/urdf/panda.urdf", "panda_hand_tcp", {}),
    "xarm7": ("xarm_description/urdf/xarm7.urdf", None, {}),
    "z1": ("z1_description/urdf/z1.urdf", None, {}),
    "jaco": ("kinova_description/robots/kinova.urdf", "j2s6s200_end_effector", JACO),
    "so100": ("so_arm_description/urdf/so100.urdf", None, {}),
    "so101": ("so_arm_description/urdf/so101.urdf", "gripper_frame_link", {}),
}


def text_of(name, disturbed=False):
    text = urdf_text(ROBOTS[name][0])
    if not disturbed:
        return text
    rng, root = np.random.default_rng(11), xml.fromstring(text)
    for joint in root.findall("joint"):  # as a calibration finds it: up to 0.1° and 1 mm
        origin = joint.find("origin") if joint.find("origin") is not None else xml.SubElement(joint, "origin")
        for key, size in (("xyz", 1e-3), ("rpy", np.radians(0.1))):
            old = np.array(list(map(float, origin.get(key, "0 0 0").split())))
            origin.set(key, " ".join(map(repr, map(float, old + rng.uniform(-size, size, 3)))))
    return xml.tostring(root, encoding="unicode")


def imported(path, tip, limits):
    robot = urdf.read(path)
    found = serial.serial_of(robot, None, tip, limits)
    return found, nominal.of_table(tomllib.loads(arm_file.text_of(found, robot.name, path.name)), path.name)


def pinocchio_of(text, found):
    """The model of the chain: every other joint at rest."""
    model = pin.buildModelFromXML(text)
    names = [joint.name for joint in found.joints]
    if others := [k for k in range(1, model.njoints) if model.names[k] not in names]:
        model = pin.buildReducedModel(model, others, pin.neutral(model))
    assert list(model.names)[1:] == names
    return model
