"""Arms and reed_inspect for the oracle tests of the model."""

import json
import os
import subprocess
import tomllib
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def inspect_program():
    path = ROOT / os.environ.get("REED_BUILD_DIR", "build/release") / "bin" / "reed_inspect"
    assert path.exists(), f"{path} is missing: build it, or set REED_BUILD_DIR"
    return str(path)


@pytest.fixture(scope="session")
def inspect(inspect_program):
    """inspect(arm, cases, **shared) -> results; arm is a name or a dict in the form of an arm file."""

    def run(arm, cases, tmp_dir=None, **shared):
        name = arm
        if isinstance(arm, dict):
            path = Path(tmp_dir) / f"{arm['name']}.json"
            path.write_text(json.dumps(arm))
            name = str(path)
        done = subprocess.run([inspect_program, "--arm", name, "--states", "-"], text=True, capture_output=True,
                              input=json.dumps({"cases": cases, **shared}))
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)["cases"]

    return run


def load_arm(name):
    with open(ROOT / "config" / "arms" / f"{name}.toml", "rb") as file:
        return tomllib.load(file)


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


MADE_ARMS = [made_arm("odd_twists", 61, [0.4, -1.1, 2.3, 0.7, -0.6, 1.9]),
             made_arm("six_square", 62, [0.0, -np.pi / 2, 0.0, np.pi / 2, -np.pi / 2, np.pi / 2])]


@pytest.fixture(params=["a5", "a7", "p2", "odd_twists", "six_square"])
def arm(request):
    made = {made["name"]: made for made in MADE_ARMS}
    return made.get(request.param) or load_arm(request.param)


@pytest.fixture(params=["a5", "odd_twists", "six_square"])
def elastic_arm(request):
    made = {made["name"]: made for made in MADE_ARMS}
    return made.get(request.param) or load_arm(request.param)
