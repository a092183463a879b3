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
BENT_AT_LIMIT_rad = 0.001     # a link at its end, under the torque limit of its joint: a fifth of what the joint twists
ALUMINIUM_Pa = 70e9           # as config/schema/tube.h has it
WALL_SHARE = 0.05             # of a tube's diameter
SHORTEST_m = 0.02             # between joints; nearer ones have one housing, which is rigid
MASS_BOX = (0.5, 1.5)         # of the URDF's masses
PAYLOAD_SHARE = 0.5           # of what the joints can hold beside the links
LEAST_PAYLOAD_kg, PAYLOAD_RADIUS_m = 0.05, 0.04
GRAVITY_mps2 = (0.0, 0.0, -9.81)
POSES, SEED = 400, 3


@dataclass(frozen=True)
class AssumedTube:
    """From a joint to the next one."""
    link: int           # 0-based
    to: np.ndarray      # m, link frame
    outer: float        # m
    wall: float


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


def tubes(serial: Serial) -> list[AssumedTube]:
    """What bends of an imported arm. The last link holds the tool and is rigid."""
    found = []
    for link, (joint, after) in enumerate(zip(serial.joints, serial.joints[1:])):
        length = float(np.linalg.norm(after.offset))
        if length < SHORTEST_m:
            continue
        EI = joint.effort * length / BENT_AT_LIMIT_rad
        outer = float((64 * EI / (np.pi * ALUMINIUM_Pa * (1 - (1 - 2 * WALL_SHARE) ** 4))) ** 0.25)
        found.append(AssumedTube(link, after.offset, round(outer, 5), round(WALL_SHARE * outer, 5)))
    return found


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
