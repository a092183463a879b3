"""Arms that no file describes."""

import numpy as np


def made_arm(name, seed, twists, joints=6):
    """An arm as no file describes it: odd twists, links with d and a, full inertias, tilted gravity, shifted tool."""
    rng = np.random.default_rng(seed)
    dh, sections, bodies = [], [], []
    for i in range(joints):
        a = 0.0 if i == 0 or i % 3 == 2 else float(rng.choice([-1, 1]) * rng.uniform(0.05, 0.4))
        d = 0.0 if i % 4 == 1 else float(rng.choice([-1, 1]) * rng.uniform(0.05, 0.4))
        dh.append([float(twists[i % len(twists)]), a, d])
        points = rng.normal(size=(12, 3)) * 0.08 + rng.uniform(-0.1, 0.1, size=3)  # a cloud of masses is a possible body
        mass = float(rng.uniform(0.4, 3.0))
        com = points.mean(axis=0)
        spread = points - com
        second = mass / 12 * spread.T @ spread
        inertia = np.trace(second) * np.eye(3) - second
        bodies.append({"mass": mass, "com": com.tolist(), "inertia_about_com": inertia.tolist()})
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
