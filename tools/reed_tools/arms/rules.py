"""What a URDF does not say of an arm, by rule from what it says. Every value made here is marked `# assumed` in the file."""

from dataclasses import dataclass

import numpy as np

from reed_tools.arms.serial import Serial
from reed_tools.robots.chain import Chain
from reed_tools.robots.regressor import inverse_dynamics

ROTOR_kgm2_PER_Nm = 0.006     # reflected inertia per torque limit: 170 rad/s² of the free rotor at its limit
STIFFNESS_PER_rad = 200.0     # per torque limit: 5 mrad of twist at the limit
COULOMB_SHARE = 0.01          # of the torque limit
VISCOUS_SHARE_s = 0.003       # of the torque limit, per rad/s
MASS_BOX = (0.5, 1.5)         # of the URDF's masses
PAYLOAD_SHARE = 0.5           # of what the joints can hold beside the links
LEAST_PAYLOAD_kg, PAYLOAD_RADIUS_m = 0.05, 0.04
GRAVITY_mps2 = (0.0, 0.0, -9.81)
POSES, SEED = 400, 3


@dataclass(frozen=True)
class Assumed:
    rotor_inertia: np.ndarray
    stiffness: np.ndarray
    coulomb: np.ndarray     # the URDF's where it says one
    viscous: np.ndarray     # likewise
    payload: float          # kg, upper end of its box
    given: np.ndarray       # [2, dof]: whether the URDF says friction and damping


def assumed(serial: Serial) -> Assumed:
    limit = np.array([joint.effort for joint in serial.joints])
    given = np.array([[(joint.friction or 0.0) > 0 for joint in serial.joints], [(joint.damping or 0.0) > 0 for joint in serial.joints]])
    coulomb = [joint.friction if known else COULOMB_SHARE * joint.effort for joint, known in zip(serial.joints, given[0])]
    viscous = [joint.damping if known else VISCOUS_SHARE_s * joint.effort for joint, known in zip(serial.joints, given[1])]
    return Assumed(ROTOR_kgm2_PER_Nm * limit, STIFFNESS_PER_rad * limit, np.array(coulomb), np.array(viscous), payload(serial), given)


def chain_of(serial: Serial) -> Chain:
    return Chain(np.array([joint.rotation for joint in serial.joints]), np.array([joint.offset for joint in serial.joints]),
                 serial.tool_rotation, serial.tool_offset, np.array(GRAVITY_mps2))


def payload(serial: Serial) -> float:
    """A mass at the tool point that every joint holds in every pose, with a share to spare."""
    chain = chain_of(serial)
    lower, upper = (np.array([getattr(joint, end) for joint in serial.joints]) for end in ("lower", "upper"))
    q = np.random.default_rng(SEED).uniform(lower, upper, (POSES, chain.dof))
    held = np.abs(inverse_dynamics(chain, q, 0 * q, 0 * q) @ np.concatenate([joint.body for joint in serial.joints])).max(axis=0)
    lengths = np.linalg.norm([*chain.offset[1:], chain.tool_offset], axis=1)
    arms = np.cumsum(lengths[::-1])[::-1]
    spare = np.array([joint.effort for joint in serial.joints]) - held
    return max(LEAST_PAYLOAD_kg, float(PAYLOAD_SHARE * np.min(spare / (9.81 * np.maximum(arms, 0.05)))))
