"""Arms that no file describes."""

import numpy as np


def possible_body(rng):
    """A cloud of masses."""
    points = rng.normal(size=(12, 3)) * 0.08 + rng.uniform(-0.1, 0.1, size=3)
    mass = float(rng.uniform(0.4, 3.0))
    com = points.mean(axis=0)
    spread = points - com
    second = mass / 12 * spread.T @ spread
    return {"mass": mass, "com": com.tolist(), "inertia_about_com": (np.trace(second) * np.eye(3) - second).tolist()}


def made_arm(name, seed, twists, joints=6):
    """An arm as no file describes it: odd twists, links with d and a, full inertias, tilted gravity, shifted tool."""
    rng = np.random.default_rng(seed)
    dh, sections, bodies = [], [], []
    for i in range(joints):
        a = 0.0 if i == 0 or i % 3 == 2 else float(rng.choice([-1, 1]) * rng.uniform(0.05, 0.4))
        d = 0.0 if i % 4 == 1 else float(rng.choice([-1, 1]) * rng.uniform(0.05, 0.4))
        dh.append([float(twists[i % len(twists)]), a, d])
        bodies.append(possible_body(rng))
    for i in range(joints):
        lengths = [abs(dh[i][2])] + ([abs(dh[i + 1][1])] if i + 1 < joints else [])
        for length in lengths:
            if length:
                sections.append({"length": length, "EA": 9e6, "EI": float(rng.uniform(300, 3000)),
                                 "GJ": float(rng.uniform(200, 2000)), "rhoA": float(rng.uniform(0.2, 1.0))})
    gravity = rng.normal(size=3)
    return {"name": name, "dh": dh, "bodies": bodies, "sections": sections,
            "gravity": (9.81 * gravity / np.linalg.norm(gravity)).tolist(),
            "tool_offset_in_last_frame": rng.uniform(-0.2, 0.2, size=3).tolist(),
            "joint_stiffness": rng.uniform(1500, 9000, size=joints).tolist()}


def made_chain(joints, seed):
    """An arm as a URDF has it: skew transforms between the joints, a base and a tool that are turned, tilted gravity,
    the mass of every link and viscous friction as parameters."""
    rng = np.random.default_rng(seed)
    turned = lambda reach: {"xyz_m": rng.uniform(-reach, reach, size=3).tolist(), "rpy_rad": rng.uniform(-np.pi, np.pi, size=3).tolist()}
    bodies = [possible_body(rng) for _ in range(joints)]
    weights = rng.uniform(0.1, 1.0, size=joints).tolist()
    names = [f"m{i + 1}" for i in range(joints)] + ["bv"]
    shapes = [{"param": f"m{i + 1}", "body": i + 1, "mass": 1.0, "com": body["com"],
               "inertia_com": (np.array(body["inertia_about_com"]) / body["mass"]).tolist()} for i, body in enumerate(bodies)]
    gravity = rng.normal(size=3)
    return {"name": f"chain{joints}", "base": turned(1.0), "tool": turned(0.3),
            "joint": [{"name": f"joint_{i}", "frame": f"frame_{i}", **turned(0.4)} for i in range(joints)],
            "bodies": bodies, "gravity": (9.81 * gravity / np.linalg.norm(gravity)).tolist(),
            "joint_stiffness": rng.uniform(1500, 9000, size=joints).tolist(),
            "param_names": names, "p_true": [body["mass"] for body in bodies] + [0.2], "p_hi": [10.0] * len(names),
            "param_shapes": [*shapes, {"param": "bv", "viscous_weights": weights}]}
