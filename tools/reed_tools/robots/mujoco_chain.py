"""The arm a5 as a MuJoCo model: motors, elastic joints (tendons), members cut into rigid pieces that elastic hinges
join. With C cuts in each of the three members that have mass there are 10 + 6 C coordinates; two bending hinges per
cut, EI over the length of a piece; the column stays rigid, since without mass it would only shorten the steps. The motors hold their pose by a servo and the tool presses on a floor."""

import math

import mujoco
import numpy as np

POSE = (0.2, 0.6, -0.9, 0.5, 0.3)
SERVO = 100.0, 1500.0                # 1/s, 1/s², times the rotor: damping and stiffness of the servo, as plant_probe has it
DAMPING_S = {"RK4": 1e-5, "implicit": 1.3e-4, "implicitfast": 1.3e-4}   # of every spring, times its stiffness: the
# plant's; it makes the implicit steps longer and Runge-Kutta's shorter, which is spared it
LEAST_MASS_KG, LINK_INERTIA = 0.05, 5e-4   # of every link, beside the rods' own: a5's wrist has it



def text(values) -> str:
    return " ".join(f"{x:.17g}" for x in values)


class Chain:
    """The XML of base to tip, one body inside the other."""

    def __init__(self, arm: dict, cuts: int, integrator: str):
        self.arm, self.cuts, self.integrator = arm, cuts, integrator
        self.damping_s = DAMPING_S[integrator]
        self.rotors, self.bodies, self.tendons, self.servos = "", "", "", ""
        self.depth, section, at = 0, 0, np.zeros(3)
        for i, (alpha, a, d) in enumerate(arm["dh"]):
            self.drive(i, alpha, at)
            following = arm["dh"][i + 1][1] if i + 1 < len(arm["dh"]) else 0.0
            length, along = (d, np.array([0.0, 0.0, 1.0])) if d else (following, np.array([1.0, 0.0, 0.0]))
            mass = max(arm["bodies"][i]["mass"], LEAST_MASS_KG)
            if not length:
                self.piece(mass, 0.0, along)
                at = np.zeros(3)
                continue
            cuts = self.cuts if arm["bodies"][i]["mass"] else 0
            at = self.member(f"bend{i}", mass, length, along, arm["sections"][section]["EI"], cuts)
            section += 1
        self.bodies += (f'<geom name="tip" type="sphere" size="0.002" pos="{text(at)}" mass="0.0001"/>'
                        f'<site name="tip" pos="{text(at)}"/>')

    def drive(self, i: int, alpha: float, at) -> None:
        arm = self.arm
        viscous = arm["bv"] * arm["viscous_weights"][i]
        rotor, stiffness = arm["rotor_inertia"][i], arm["joint_stiffness"][i]
        self.rotors += (f'<body><joint name="rotor{i}" type="hinge" axis="0 0 1" damping="{viscous:.17g}"/>'
                        f'<inertial pos="0 0 0" mass="1e-3" diaginertia="{text([rotor] * 3)}"/></body>')
        self.bodies += (f'<body pos="{text(at)}" quat="{text([math.cos(alpha / 2), math.sin(alpha / 2), 0, 0])}">'
                        f'<joint name="joint{i}" type="hinge" axis="0 0 1"/>')
        self.depth += 1
        self.tendons += (f'<fixed name="spring{i}" stiffness="{stiffness:.17g}" damping="{self.damping_s * stiffness:.17g}" '
                         f'springlength="0"><joint joint="rotor{i}" coef="1"/><joint joint="joint{i}" coef="-1"/></fixed>')
        self.servos += f'<position joint="rotor{i}" kp="{SERVO[1] * rotor:.17g}" kv="{SERVO[0] * rotor:.17g}"/>'

    def piece(self, mass: float, length: float, along, pieces: int = 1) -> None:
        """A rod of `mass`, the inertial of the body that is open."""
        inertia = mass * length ** 2 / 12 + LINK_INERTIA / pieces
        self.bodies += (f'<inertial pos="{text(along * length / 2)}" mass="{mass:.17g}" diaginertia="{text([inertia] * 3)}"/>')

    def member(self, name: str, mass: float, length: float, along, EI: float, cuts: int):
        """Pieces joined by two hinges each; returns where the last one ends."""
        pieces = cuts + 1
        piece, stiffness = length / pieces, EI * pieces / length
        axes = [axis for axis in np.eye(3) if not axis @ along]
        self.piece(mass / pieces, piece, along, pieces)
        for cut in range(1, pieces):
            self.bodies += f'<body pos="{text(along * piece)}">'
            self.depth += 1
            for k, axis in enumerate(axes):
                self.bodies += (f'<joint name="{name}_{cut}_{k}" type="hinge" axis="{text(axis)}" '
                                f'stiffness="{stiffness:.17g}" damping="{self.damping_s * stiffness:.17g}"/>')
            self.piece(mass / pieces, piece, along, pieces)
        return along * piece

    def model(self, step_s: float, floor_m: float | None) -> mujoco.MjModel:
        floor = "" if floor_m is None else f'<geom type="plane" size="1 1 0.1" pos="0 0 {floor_m:.17g}" solref="-10000 -20"/>'
        return mujoco.MjModel.from_xml_string(
            f'<mujoco><compiler angle="radian" balanceinertia="true"/>'
            f'<option integrator="{self.integrator}" timestep="{step_s:.17g}"><flag autoreset="disable"/></option>'
            f'<worldbody>{self.rotors}{self.bodies}{"</body>" * self.depth}{floor}</worldbody>'
            f'<tendon>{self.tendons}</tendon><actuator>{self.servos}</actuator></mujoco>')


def at_pose(model: mujoco.MjModel) -> mujoco.MjData:
    """At rest in the pose, which the servos hold."""
    data = mujoco.MjData(model)
    for i, angle in enumerate(POSE):
        for part in ("rotor", "joint"):
            data.qpos[model.joint(f"{part}{i}").qposadr[0]] = angle
    data.ctrl[:] = POSE
    mujoco.mj_forward(model, data)
    return data
