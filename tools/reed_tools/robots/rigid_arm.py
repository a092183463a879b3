"""The arm's rigid model for many poses at once, from the [arm] table alone: body by body with M = Σ m JᵥᵀJᵥ + JᵤᵀIJᵤ,
a route of its own beside the firmware's. q: [n, dof], rad; T_i = T(mount) Rz(θ) Tz(d)."""

import numpy as np

from reed_tools.robots.chain import Frames, chain_of, frames_of, jacobians
from reed_tools.robots.joint_frames import dof


def poses(arm: dict, q: np.ndarray) -> Frames:
    return frames_of(chain_of(arm), q)


def tip_jacobian(arm: dict, q: np.ndarray) -> np.ndarray:
    return jacobians(poses(arm, q), dof(arm) - 1, chain_of(arm).tool_offset)[0]


def tip(arm: dict, q: np.ndarray) -> np.ndarray:
    return poses(arm, q).tool(chain_of(arm))


def mass_matrix(arm: dict, q: np.ndarray) -> np.ndarray:
    """M(q) of the true bodies without rotors, [n, dof, dof], kg·m²."""
    at = poses(arm, q)
    M = np.zeros((len(q), q.shape[1], q.shape[1]))
    for number, body in enumerate(arm["bodies"]):
        J_v, J_w = jacobians(at, number, body["com"])
        local = np.swapaxes(at.R[number], 1, 2) @ J_w
        M += body["mass"] * np.swapaxes(J_v, 1, 2) @ J_v
        M += np.swapaxes(local, 1, 2) @ np.array(body["inertia_about_com"]) @ local
    return M


def true_arm(effective: dict) -> dict:
    """The [arm] table as the plant has it: with plant.p_true instead of the arm's own truth, where that is given."""
    arm, wanted = effective["arm"], effective.get("plant", {}).get("p_true")
    if not wanted:
        return arm
    more = dict(zip(arm["param_names"], np.array(wanted) - np.array(arm["p_true"])))
    totals = [np.array(moments(body["mass"], body["com"], body["inertia_about_com"]), dtype=object) for body in arm["bodies"]]
    for shape in arm["param_shapes"]:
        if "body" in shape:
            unit = np.array(moments(shape["mass"], shape["com"], shape["inertia_com"]), dtype=object)
            totals[shape["body"] - 1] = totals[shape["body"] - 1] + more[shape["param"]] * unit
    return {**arm, "p_true": list(wanted), "bodies": [body_of(*total) for total in totals]}


def steiner(mass: float, com: np.ndarray) -> np.ndarray:
    return mass * (com @ com * np.eye(3) - np.outer(com, com))


def moments(mass: float, com, inertia_about_com) -> tuple:
    """Mass, first and second moment about the frame's origin: these add up, centres of mass do not."""
    com = np.array(com)
    return mass, mass * com, np.array(inertia_about_com) + steiner(mass, com)


def body_of(mass: float, first: np.ndarray, second: np.ndarray) -> dict:
    com = first / mass if abs(mass) > 1e-12 else np.zeros(3)
    return {"mass": mass, "com": com, "inertia_about_com": second - steiner(mass, com)}


def viscous_friction(arm: dict) -> np.ndarray:
    """True F_v per joint, N·m·s/rad."""
    total = np.zeros(dof(arm))
    for shape in arm["param_shapes"]:
        if "viscous_weights" in shape:
            total += arm["p_true"][arm["param_names"].index(shape["param"])] * np.array(shape["viscous_weights"])
    return total
