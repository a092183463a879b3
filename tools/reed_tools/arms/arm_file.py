"""An arm file from a chain: what the URDF says, and what is assumed, marked."""

import numpy as np

from reed_tools.arms.rules import BENT_AT_LIMIT_rad, GRAVITY_mps2, MASS_BOX, PAYLOAD_RADIUS_m, Assumed, assumed, tubes
from reed_tools.arms.serial import Serial
from reed_tools.robots.chain import rpy_of
from reed_tools.robots.pseudo_inertia import body_parts

MASSLESS = "[[known_bodies]]\nmass = 0.0\n"


def number(value: float) -> str:
    """As short as it can be and still the same number."""
    return repr(float(value))


def row(values) -> str:
    return f"[{', '.join(number(value) for value in values)}]"


def matrix(values) -> str:
    return f"[{', '.join(row(line) for line in values)}]"


def frame(R: np.ndarray, p: np.ndarray) -> str:
    return f"xyz_m = {row(p)}\nrpy_rad = {row(rpy_of(R))}\n"


def text_of(serial: Serial, name: str, source: str, rigid: bool = False) -> str:
    more = assumed(serial)
    parts = [head(serial, name, source, rigid), drives(serial, more), parameters(serial, more), "[tool]\n" + frame(serial.tool_rotation, serial.tool_offset)]
    parts += [f'[[joint]]\nname = "{joint.name}"\nframe = "{joint.frame}"\n' + frame(joint.rotation, joint.offset) for joint in serial.joints]
    parts += [] if rigid else members(serial)
    parts += ["# Nothing of a link is known: each is its mass times what a unit of it has, below.\n" + "\n".join([MASSLESS] * len(serial.joints))]
    parts += shapes(serial, more)
    parts.append(f"# The simulated arm's own.\n[truth]\ncoulomb = {row(more.coulomb)}{mark(more.given[0])}\n")
    return "\n".join(parts)


def head(serial: Serial, name: str, source: str, rigid: bool) -> str:
    held = f"# Joints beside the chain, held at 0: {', '.join(serial.held)}.\n" if serial.held else ""
    return (f"# {name}: made from {source} by `tools/reed arm import`, base {serial.base}, tip {serial.tip}.{' Links are rigid.' if rigid else ''}\n{held}"
            f"# SI units, radians. Keys: config/README.md. What a URDF does not say is marked: # assumed.\n"
            f'name = "{name}"\ngravity = {row(GRAVITY_mps2)}   # base frame, z up: assumed\n')


def members(serial: Serial) -> list[str]:
    found = [f'[[member]]   # assumed: {serial.joints[tube.link].frame}\nlink = {tube.link + 1}\nto_m = {row(tube.to)}\n'
             f'tube = {{outer = {number(tube.outer)}, wall = {number(tube.wall)}, material = "aluminium"}}\n' for tube in tubes(serial)]
    rule = (f"# Links bend as tubes from joint to joint, assumed: by {1e3 * BENT_AT_LIMIT_rad:g} mrad at the end under the joint's torque limit. Rigid without\n"
            "# these tables.\n")
    return [rule + found[0], *found[1:]] if found else []


def mark(given: np.ndarray) -> str:
    """A comment for what is not all from the URDF."""
    return "" if given.all() else f"   # assumed{'' if not given.any() else f' for joint {numbers_of(~given)}'}: 1 % of torque_limit"


def numbers_of(which: np.ndarray) -> str:
    return ", ".join(str(k + 1) for k in np.flatnonzero(which))


def drives(serial: Serial, more: Assumed) -> str:
    of = lambda key: row(getattr(joint, key) for joint in serial.joints)
    return (f"torque_limit = {of('effort')}   # N·m\nposition_min = {of('lower')}   # rad\nposition_max = {of('upper')}   # rad\n"
            f"speed_limit = {of('speed')}   # rad/s\n"
            f"rotor_inertia_reflected = {row(more.rotor_inertia)}   # kg·m², assumed: 0.006 s²/rad of torque_limit\n"
            f"joint_stiffness = {row(more.stiffness)}   # N·m/rad, assumed: 5 mrad of twist at torque_limit\n"
            f"coulomb_declared = {row(more.coulomb)}{mark(more.given[0])}\n"
            + (f"coulomb_nominal = {row(np.where(more.given[0], more.coulomb, 0.0))}\n" if more.given[0].any() else ""))


def parameters(serial: Serial, more: Assumed) -> str:
    masses = np.array([joint.body[0] for joint in serial.joints])
    names = [f"m{k + 1}" for k in range(len(masses))]
    quoted = ", ".join(f'"{name}"' for name in [*names, "bv", "mL"])
    return ("# Uncertain: the mass of each link, viscous friction as a multiple of what is below, a payload at the tool point.\n"
            f"param_names = [{quoted}]\np_nom = {row([*masses, 1.0, 0.0])}\n"
            f"p_lo = {row([*MASS_BOX[0] * masses, 0.0, 0.0])}   # assumed: half the masses\n"
            f"p_hi = {row([*MASS_BOX[1] * masses, 4.0, more.payload])}   # assumed: one and a half of the masses; the payload that the joints hold\n")


def shapes(serial: Serial, more: Assumed) -> list[str]:
    found = []
    for k, joint in enumerate(serial.joints):
        unit = body_parts(joint.body / joint.body[0])
        found.append(f'[[param_shapes]]   # {joint.frame}, per kilogram\nparam = "m{k + 1}"\nbody = {k + 1}\nmass = 1.0\n'
                     f"com = {row(unit['com'])}\ninertia_com = {matrix(unit['inertia_about_com'])}\n")
    viscous = "" if more.given[1].all() else f"   # N·m·s/rad, assumed{'' if not more.given[1].any() else f' for joint {numbers_of(~more.given[1])}'}: 0.3 % of torque_limit per rad/s"
    ball = 0.4 * PAYLOAD_RADIUS_m**2 * np.eye(3)
    found.append(f'[[param_shapes]]\nparam = "bv"\nviscous_weights = {row(more.viscous)}{viscous}\n')
    found.append(f'[[param_shapes]]   # assumed: a ball of {100 * PAYLOAD_RADIUS_m:g} cm at the tool point\nparam = "mL"\nbody = {len(serial.joints)}\nmass = 1.0\n'
                 f"com = {row(serial.tool_offset)}\ninertia_com = {matrix(ball)}\n")
    return found
