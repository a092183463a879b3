"""Arms and reed_inspect for the oracle tests of the model."""

import json
import os
import subprocess
import tomllib
from pathlib import Path

import numpy as np
import pytest
from made_arms import made_arm, made_chain

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
        arm = tomllib.load(file)
    truth = arm.pop("truth", {})  # beside the rest, as in files from before it had a place of its own
    return arm | {name: truth[key] for key, name in (("p", "p_true"), ("bodies", "bodies"), ("coulomb", "coulomb")) if key in truth}


MADE_ARMS = [made_arm("odd_twists", 61, [0.4, -1.1, 2.3, 0.7, -0.6, 1.9]),
             made_arm("six_square", 62, [0.0, -np.pi / 2, 0.0, np.pi / 2, -np.pi / 2, np.pi / 2])]


OFFSET_ROWS = made_arm("offset_rows", 63, [0.4, -1.1, 2.3, 0.7, -0.6, 1.9])  # joint offsets in the fourth column
OFFSET_ROWS["dh"] = [[*row, 0.3 * i - 0.8] for i, row in enumerate(OFFSET_ROWS["dh"])]
CHAINS = [made_chain(joints, 70 + joints) for joints in range(2, 9)]


@pytest.fixture(params=["a5", "a7", "p2", "odd_twists", "six_square", "offset_rows", *(chain["name"] for chain in CHAINS)])
def arm(request):
    made = {made["name"]: made for made in (*MADE_ARMS, OFFSET_ROWS, *CHAINS)}
    return made.get(request.param) or load_arm(request.param)


@pytest.fixture(params=["a5", "odd_twists", "six_square"])
def elastic_arm(request):
    made = {made["name"]: made for made in MADE_ARMS}
    return made.get(request.param) or load_arm(request.param)
