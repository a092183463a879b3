"""reed_inspect on recorded cases: reads them as they are, answers under the same names."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

CASES = Path(__file__).resolve().parents[1] / "data" / "cases"
LIMITS = {"static": 1e-8}  # PyNite solves a system with short stiff members; everything else agrees to 1e-10
INPUTS = {"q", "qd", "qdd", "dq", "q_d", "dq_d", "ddq_d", "vd", "F_d_normal", "p_hat", "eta_hat", "sigma0", "sigma1",
          "normal", "e_f", "int_e_f", "kp", "ki", "wrench_world_tip", "wrench_world_at_tip", "self_weight_N_per_m",
          "tip_deflection_with_joint_springs_pynite_short_member"}


@pytest.mark.parametrize("path", sorted(CASES.glob("*.json")), ids=lambda path: path.stem)
def test_every_answer_of_a_case_file_is_reproduced(path, inspect_program):
    file = json.loads(path.read_text())
    done = subprocess.run([inspect_program, "--arm", file["arm"].lower(), "--states", str(path)], text=True,
                          capture_output=True, check=True)
    results = json.loads(done.stdout)["cases"]
    assert len(results) == len(file["cases"]) > 0
    limit = LIMITS.get(path.stem.split("_")[0], 1e-10)
    compared = 0
    for case, result in zip(file["cases"], results):
        inputs = INPUTS if path.stem.startswith("ctrl") else INPUTS | {"v"}
        for name in case.keys() - inputs:
            want, got = np.array(case[name], float), np.array(result[name], float)
            assert got.shape == want.shape, name
            assert np.linalg.norm(got - want) <= limit * max(np.linalg.norm(want), 1e-3), name
            compared += 1
    assert compared >= 2 * len(results)


def run(inspect_program, *arguments, text=""):
    return subprocess.run([inspect_program, *arguments], text=True, capture_output=True, input=text)


@pytest.mark.parametrize("text, says", [
    ("{", "not JSON"),
    ("[]", 'list "cases"'),
    ('{"cases": [3]}', "cases[0]"),
    ('{"cases": [{"q": [1, 2]}]}', "cases[0].q: expected a list of 5 numbers"),
    ('{"cases": [{"q": [0,0,0,0,0]}, {"q": [0,0,0,0,0], "qd": 1}]}', "cases[1].qd"),
    ('{"cases": [{"q": [0,0,0,0,0], "dq": [0,0,0,0,0], "q_d": [0,0,0,0,0], "dq_d": [0,0,0,0,0], "ddq_d": [0,0,0,0,0]}]}',
     "Kd: missing"),
    ('{"cases": [{"q": [0,0,0,0,0], "qdot": [0,0,0,0,0]}]}', "cases[0].qdot: nothing reads it; allowed: q, qd, "),
    ('{"cases": [{"Q": [0,0,0,0,0]}]}', "cases[0].Q: nothing reads it"),
    ('{"cases": [{"q": [0,0,0,0,0]}, {"qd": [0,0,0,0,0]}]}', "cases[1].q: missing"),
])
def test_a_wrong_case_is_one_line_that_says_where(inspect_program, text, says):
    done = run(inspect_program, "--arm", "a5", "--states", "-", text=text)
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.count("\n") == 1 and says in done.stderr


def test_an_unknown_arm_and_an_unreadable_file_exit_2(inspect_program, tmp_path):
    assert run(inspect_program, "--arm", "no_such_arm", "--states", "-", text='{"cases": []}').returncode == 2
    assert run(inspect_program, "--arm", "a5", "--states", str(tmp_path / "none.json")).returncode == 2
    assert run(inspect_program, "--what").returncode == 2


@pytest.mark.parametrize("old, new, says", [
    ("  [0.0, 0.35, 0.0],\n", "", "bodies: 5 bodies for 4 joints"),
    ("joint_stiffness = [8000.0,", "joint_stiffness = [-8000.0,", "joint_stiffness[0]: "),
    ("[0.0, 0.004125, 0.0]", "[0.0, 0.04125, 0.0]", "bodies[2].inertia_about_com: "),
    ("length = 0.35 ", "length = 350.0 ", "sections[1].length: "),
    ("[0.0, 0.0, -9.81]", "[0.0, 0.0, -1.0]", "gravity: "),
])
@pytest.mark.parametrize("question", [["--states", "-"], ["--modes", "3"]])
def test_a_wrong_arm_file_is_one_line_with_file_line_and_key(inspect_program, tmp_path, question, old, new, says):
    sound = (CASES.parents[1] / "config" / "data" / "a5.toml").read_text()
    assert sound.count(old) == 1
    path = tmp_path / "arm.toml"
    path.write_text(sound.replace(old, new))
    done = run(inspect_program, "--arm", str(path), *question, text='{"cases": []}')
    assert done.returncode == 2 and done.stdout == "" and done.stderr.count("\n") == 1, done.stderr
    where, line, rest = done.stderr.split(":", 2)
    assert (where, line.isdigit()) == (str(path), True) and says in rest, done.stderr


def test_inputs_alone_and_reference_cases_with_numbers_of_their_own_are_answered(inspect):
    q = [0.1, 0.6, -1.0, -0.7, 0.2]
    bare = inspect("a5", [{"q": q, "note": "a pose"}], note="of no number", rel_err=1e-9)[0]
    assert inspect("a5", [{"q": q, "T": np.eye(4).tolist(), "rel_err_of_T": 1e-9}])[0] == bare
    for path in CASES.glob("*_A5.json"):
        file = json.loads(path.read_text())
        shared = {name: value for name, value in file.items() if name not in ("arm", "cases")}
        inputs = [{name: value for name, value in case.items() if name in INPUTS | {"v"}} for case in file["cases"]]
        assert all(inspect("a5", inputs, **shared)), path.stem


def test_the_tool_offset_beside_the_cases_replaces_the_arms(inspect):
    case = {"q": [0.3, -0.4]}
    with_arms, moved = inspect("p2", [case])[0], inspect("p2", [case], tool_offset=[0.1, 0.2, 0.3])[0]
    T = np.array(with_arms["T"])
    last_origin = T[:3, 3] - T[:3, :3] @ [0.4, 0.0, 0.0]
    assert np.allclose(np.array(moved["T"])[:3, 3], last_origin + T[:3, :3] @ [0.1, 0.2, 0.3], atol=1e-14)


def test_more_parameters_than_the_loop_has_room_for_are_inspected_without_the_law(inspect, inspect_program, tmp_path):
    body = {"mass": 1.0, "com": [0, 0.1, 0], "inertia_about_com": np.diag([0.01, 0.01, 0.01]).tolist()}
    names = [f"m{k}" for k in range(8)]
    arm = {"name": "eight", "dh": [[0.3, 0.1, 0.2], [0.3, 0.1, 0.2]], "gravity": [0, 0, -9.81], "bodies": [body] * 2, "p_true": [1.0] * 8,
           "param_names": names,
           "param_shapes": [{"param": name, "body": 1, "mass": 1.0, "com": [0, 0.1, 0]} for name in names]}
    state = {"q": [0.1, 0.2], "qd": [0.0, 0.1], "v": [0.0, 0.1], "vd": [0.1, 0.1]}
    assert np.array(inspect(arm, [state], tmp_path)[0]["Y"]).shape == (2, 8)
    law = {**state, **dict.fromkeys(("dq", "q_d", "dq_d", "ddq_d"), [0.0, 0.0]), "Kd": [1.0, 1.0], "Lambda": [1.0, 1.0]}
    done = run(inspect_program, "--arm", str(tmp_path / "eight.json"), "--states", "-", text=json.dumps({"cases": [law]}))
    assert done.returncode == 2 and "Kd: the arm has 8 parameters; the loop of 2 joints allows 0 ... 7" in done.stderr


@pytest.mark.parametrize("joints", range(1, 9))
def test_every_number_of_joints_is_answered(joints, inspect, tmp_path):
    arm = {"name": f"chain{joints}", "dh": [[0.3, 0.1 if i else 0.0, 0.2] for i in range(joints)],
           "gravity": [0, 0, -9.81],
           "bodies": [{"mass": 1.0, "com": [0, 0.1, 0], "inertia_about_com": np.diag([0.01, 0.01, 0.01]).tolist()}] * joints}
    result = inspect(arm, [{"q": [0.1] * joints, "qd": [0.2] * joints}], tmp_path)[0]
    assert np.array(result["M"]).shape == (joints, joints)
    assert "C_links" not in result and "C_joints" not in result
