"""Real robots, imported from their URDF: reed_inspect, which links the firmware's model, against Pinocchio reading that URDF."""

import json
import subprocess

import numpy as np
import pinocchio as pin
import pytest
from imported import ROBOTS, BODY, imported, pinocchio_of, text_of
from pinocchio_dynamics import dynamics

from reed_tools.arms import arm_file
from reed_tools.robots import nominal

STATES = 1000
LIMIT = 1e-10


def answers(program, path, states):
    cases = [dict(zip(("q", "qd", "qdd", "v", "vd"), map(list, state))) for state in zip(*states)]
    done = subprocess.run([program, "--arm", str(path), "--states", "-"], text=True, capture_output=True, input=json.dumps({"cases": cases}))
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)["cases"]


def expected(model, base, tip, state):
    q, qd, qdd, v, vd = state
    q = pin.integrate(model, pin.neutral(model), q)  # joints without an end have two coordinates there
    frame = model.getFrameId(tip, BODY)
    data, out = dynamics(model, frame, q, qd, qdd)
    out["T"] = data.oMf[model.getFrameId(base, BODY)].actInv(data.oMf[frame]).homogeneous
    out["Yp"] = out["M"] @ vd + pin.computeCoriolisMatrix(model, data, q, qd) @ v + out["G"]
    return out


@pytest.mark.parametrize("disturbed", [False, True], ids=["as published", "calibrated"])
@pytest.mark.parametrize("name", ROBOTS)
def test_the_firmwares_model_is_pinocchios(name, disturbed, inspect_program, tmp_path):
    path, file = tmp_path / f"{name}.urdf", tmp_path / f"{name}.toml"
    path.write_text(text_of(name, disturbed))
    found, _ = imported(path, *ROBOTS[name][1:])
    file.write_text(arm_file.text_of(found, name, path.name))
    model, arm = pinocchio_of(path.read_text(), found), nominal.load(str(file))
    rng = np.random.default_rng(7)
    states = [rng.uniform(-size, size, (STATES, arm.dof)) for size in (3.0, 2.5, 9.0, 2.5, 9.0)]
    worst = {}
    for state, answer in zip(zip(*states), answers(inspect_program, file, states)):
        answer["Yp"] = np.array(answer["f"]) - (arm.viscous @ arm.p) * state[3]
        for key, value in expected(model, found.base, found.tip, state).items():
            error = np.linalg.norm(np.array(answer[key]) - value) / max(np.linalg.norm(value), 1e-3)
            worst[key] = max(worst.get(key, 0.0), error)
    assert len(worst) == 8 and max(worst.values()) < LIMIT, worst
