"""`inspect --modes` and `--plot` as a user types them: frequencies against transcendental roots, the picture, wrong words."""

import json
import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from made_arms import made_arm

ROOT = Path(__file__).resolve().parents[2]
TIP_MASS_RATIOS = (0.0, 0.5, 1.0, 5.0)
LIMITS = (0.005, 0.02, 0.05)   # of modes 1, 2, 3 at the default discretisation
BEAM = {"length": 0.35, "EI": 957.16, "rhoA": 0.5325}


def clamped_modes_hz(length, EI, rhoA, tip_mass, count):
    """From 1 + cos β cosh β + r β (cos β sinh β - sin β cosh β) = 0, r the tip mass over the beam's, divided by cosh β."""
    r = tip_mass / (rhoA * length)
    f = lambda b: 1 / math.cosh(b) + math.cos(b) + r * b * (math.cos(b) * math.tanh(b) - math.sin(b))
    roots, low = [], 0.05
    while len(roots) < count:
        a, b = low, low + 0.01
        low = b
        if f(a) * f(b) > 0:
            continue
        for _ in range(60):
            middle = (a + b) / 2
            a, b = (a, middle) if f(a) * f(middle) <= 0 else (middle, b)
        roots.append(a)
    return np.array([b * b * math.sqrt(EI / rhoA) / length ** 2 / (2 * math.pi) for b in roots])


def inspect(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=60)


def answer(program, *arguments):
    done = inspect(program, *arguments)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def beam_hz(program, tip_mass, modes, **extra):
    text = ",".join(f"{key}={value!r}" for key, value in {**BEAM, "tip_mass": tip_mass, **extra}.items())
    return np.array(answer(program, "--beam", text, "--modes", modes)["freq_hz"])


@pytest.mark.parametrize("ratio", TIP_MASS_RATIOS)
def test_a_clamped_beam_has_the_modes_of_its_transcendental_equation(ratio, inspect_program):
    tip_mass = ratio * BEAM["rhoA"] * BEAM["length"]
    exact = clamped_modes_hz(**BEAM, tip_mass=tip_mass, count=3)
    error = np.abs(beam_hz(inspect_program, tip_mass, 3) / exact - 1)
    assert (error < LIMITS).all(), error


@pytest.mark.parametrize("ratio", TIP_MASS_RATIOS)
def test_more_elements_converge_to_the_transcendental_roots(ratio, inspect_program):
    tip_mass = ratio * BEAM["rhoA"] * BEAM["length"]
    exact = clamped_modes_hz(**BEAM, tip_mass=tip_mass, count=3)
    errors = [beam_hz(inspect_program, tip_mass, 3, elements=n) / exact - 1 for n in (1, 2, 4)]
    assert (errors[0][1:] > 1e-6).all(), "the coarse one must err for this to mean anything"
    for coarse, fine in zip(errors, errors[1:]):
        assert (fine > -1e-9).all(), "a discretised beam is never softer than the beam"
        assert (fine < np.maximum(coarse / 10, 1e-8)).all(), errors


def lone_link(ratio):
    """One upright link, its joint all but rigid: the clamped beam as an arm file."""
    length, line, EI = 0.35, 0.5325, 957.16
    rod, tip = line * length, ratio * line * length
    com = (rod / 2 + tip) * length / (rod + tip) - length   # from the link's origin, which is its tip
    across = rod * (length ** 2 / 12 + (com + length / 2) ** 2) + tip * com ** 2
    return {"name": "lone_link", "dh": [[0.0, 0.0, length]], "gravity": [0.0, 0.0, 0.0],
            "bodies": [{"mass": rod + tip, "com": [0.0, 0.0, com],
                        "inertia_about_com": [[across, 0, 0], [0, across, 0], [0, 0, 1e-6]]}],
            "sections": [{"length": length, "EA": 1e10, "EI": EI, "GJ": 1e7, "rhoA": line}],
            "rotor_inertia_reflected": [1.0], "joint_stiffness": [1e9], "torque_limit": [10.0]}


@pytest.mark.parametrize("ratio", TIP_MASS_RATIOS)
def test_an_arm_of_one_link_has_the_same_modes_in_both_planes(ratio, inspect_program, tmp_path):
    path = tmp_path / "lone_link.json"
    path.write_text(json.dumps(lone_link(ratio)))
    got = np.array(answer(inspect_program, "--arm", path, "--modes", 6)["freq_hz"])
    exact = clamped_modes_hz(**BEAM, tip_mass=ratio * BEAM["rhoA"] * BEAM["length"], count=3)
    for k, limit in enumerate(LIMITS):
        assert np.abs(got[2 * k:2 * k + 2] / exact[k] - 1).max() < limit, (k, got, exact)


def test_the_arms_modes_come_with_its_shape(inspect_program):
    result = answer(inspect_program, "--arm", "a5", "--modes", 5, "--at", "0.2,0.6,-0.9,0.5,0.3")
    assert 10 < result["freq_hz"][0] < 16 and result["freq_hz"] == sorted(result["freq_hz"]) and len(result["freq_hz"]) == 5
    rest, bent = np.array(result["undeformed_m"]), np.array(result["deformed_m"])
    tip = answer_tip(inspect_program, [0.2, 0.6, -0.9, 0.5, 0.3])
    assert np.allclose(rest[-1], tip, atol=1e-12)
    assert 1e-4 < np.linalg.norm(bent[-1] - rest[-1]) < 2e-3
    nodes = np.array(result["nodes_m"])
    assert all(np.abs(rest - node).sum(axis=1).min() < 1e-12 for node in nodes)
    for shape in result["mode_shapes"]:
        assert np.linalg.norm(shape, axis=1).max() == pytest.approx(1.0, abs=1e-9) and not np.any(shape[0])


def answer_tip(program, q):
    done = subprocess.run([program, "--arm", "a5", "--states", "-"], input=json.dumps({"cases": [{"q": q}]}), text=True,
                          capture_output=True, check=True)
    return json.loads(done.stdout)["cases"][0]["tip_xyz"]


def any_arm(joints):
    return made_arm("any", 70 + joints, [0.4, -1.1, 2.3, 0.7, -0.6, 1.9], joints)


def modes_of(arm, program, tmp_path, modes):
    path = tmp_path / "any.json"
    path.write_text(json.dumps(arm))
    return np.array(answer(program, "--arm", path, "--modes", modes)["freq_hz"])


@pytest.mark.parametrize("joints", [1, 2, 6, 8])
def test_arms_of_any_size_and_twist_have_modes(joints, inspect_program, tmp_path):
    frequencies = modes_of(any_arm(joints), inspect_program, tmp_path, 8)
    assert len(frequencies) == 8 and frequencies[0] > 0.1 and (np.diff(frequencies) >= 0).all()


def test_locked_rotors_do_not_count(inspect_program, tmp_path):
    heavy = any_arm(6) | {"rotor_inertia_reflected": [50.0] * 6}
    assert (modes_of(heavy, inspect_program, tmp_path, 6) == modes_of(any_arm(6), inspect_program, tmp_path, 6)).all()


def test_springs_or_sections_that_are_not_stated_are_rigid(inspect_program, tmp_path):
    both = modes_of(any_arm(6), inspect_program, tmp_path, 6)
    for key in ("joint_stiffness", "sections"):
        arm = any_arm(6)
        del arm[key]
        stiffer = modes_of(arm, inspect_program, tmp_path, 6)
        assert (stiffer > both * (1 - 1e-9)).all() and stiffer[0] > 1.05 * both[0]


def test_an_arm_of_which_nothing_bends_says_so(inspect_program, tmp_path):
    arm = any_arm(6)
    del arm["joint_stiffness"], arm["sections"]
    path = tmp_path / "any.json"
    path.write_text(json.dumps(arm))
    done = inspect(inspect_program, "--arm", path, "--modes", 3)
    assert done.returncode == 2 and done.stderr == "arm any: nothing bends, it has neither joint_stiffness nor members\n"


@pytest.mark.parametrize("arguments, words", [
    (["--beam", "length=1,EI=1", "--modes", "3"], ["--beam", "rhoA"]),
    (["--beam", "length=0,EI=1,rhoA=1", "--modes", "3"], ["--beam", "positive"]),
    (["--beam", "length=1,EI=1,rhoA=1,tip_mass=-1", "--modes", "3"], ["tip_mass"]),
    (["--beam", "length=1,EI=1,rhoA=1,mass=2", "--modes", "3"], ["'mass'", "tip_mass"]),
    (["--beam", "length=one,EI=1,rhoA=1", "--modes", "3"], ["length", "'one'"]),
    (["--beam", "length=1,EI=1,rhoA=1,elements=1.5", "--modes", "3"], ["elements", "whole"]),
    (["--beam", "length=1,EI=1,rhoA=1"], ["--modes"]),
    (["--arm", "a5", "--beam", "length=1,EI=1,rhoA=1", "--modes", "3"], ["--arm", "--beam"]),
    (["--arm", "a5", "--modes", "3", "--at", "0.1,0.2"], ["--at", "5 angles"]),
    (["--arm", "p2", "--modes", "3", "--at", "0.1", "nan"], ["--at", "finite"]),
    (["--arm", "p2", "--at", "0.1", "0.2"], ["--at", "--modes"]),
])
def test_a_wrong_question_is_one_line(arguments, words, inspect_program):
    done = inspect(inspect_program, *arguments)
    assert done.returncode == 2 and done.stdout == "" and done.stderr.count("\n") == 1, done.stderr
    assert all(word in done.stderr for word in words), done.stderr


@pytest.mark.parametrize("words", [["0.2", "-0.6", "-0.9", "0.5", "0.3"], ["0.2,-0.6,-0.9,0.5,0.3"], ["-0.2,0.6", "0.9", "-0.5,.3"]])
def test_a_pose_is_given_as_the_help_says(words, inspect_program, tmp_path):
    wanted = [float(number) for word in words for number in word.split(",")]
    assert answer(inspect_program, "--arm", "a5", "--modes", 2, "--at", *words)["q"] == wanted
    assert answer(inspect_program, "--at", *words, "--arm", "a5", "--modes", 2)["q"] == wanted
    done = reed("--plot", "p.svg", "--at", *words, "--arm", "a5", cwd=tmp_path)
    assert done.returncode == 0 and (tmp_path / "p.svg").exists(), done.stderr


def reed(*arguments, cwd):
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "tools")}
    return subprocess.run([sys.executable, "-m", "reed_tools", "inspect", *map(str, arguments)], cwd=cwd, env=environment,
                          capture_output=True, text=True, timeout=120)


def test_plot_draws_the_arm_and_says_where(inspect_program, tmp_path):
    done = reed("--arm", "a5", "--plot", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "") and "inspect-a5.png" in done.stdout
    assert (tmp_path / "inspect-a5.png").read_bytes().startswith(b"\x89PNG")
    done = reed("--plot", "drawn.svg", "--arm", "a7", "--modes", 2, "--at", "0.1,0.5,0,-1,0,0.4,0", cwd=tmp_path)
    svg = (tmp_path / "drawn.svg").read_text() if done.returncode == 0 else done.stderr
    assert "<svg" in svg, done.stderr


@pytest.mark.parametrize("pose", [["-0.1,0.5,0,-1,0"], ["-0.1", "0.5", "0", "-1", "0"], ["-.1,", "0.5,0", "-1e0", "0"]])
def test_a_pose_may_have_commas_or_blanks_and_begin_with_a_minus(inspect_program, tmp_path, pose):
    asked = reed("--arm", "a5", "--modes", "1", "--at", *pose, cwd=tmp_path)
    assert asked.returncode == 0, asked.stderr
    assert asked.stdout == inspect(inspect_program, "--arm", "a5", "--modes", "1", "--at=-0.1,0.5,0,-1,0").stdout
    drawn = reed("--arm", "a5", "--at", *pose, "--plot", "arm.png", cwd=tmp_path)
    assert drawn.returncode == 0 and (tmp_path / "arm.png").exists(), drawn.stderr


def test_the_help_names_every_option(inspect_program, tmp_path):
    told = reed("--help", cwd=tmp_path)
    assert (told.returncode, told.stderr) == (0, "")
    for option in ("--arm", "--states", "--modes", "--at", "--beam", "--plot [FILE]", "Usage: tools/reed inspect"):
        assert option in told.stdout


@pytest.mark.parametrize("arguments, words", [
    (["--plot"], ["--arm"]),
    (["--plot", "--arm", "nobody"], ["nobody", "a5"]),
    (["--plot", "arm.nonsense", "--arm", "a5"], ["arm.nonsense"]),
    (["--plot", "no/folder/arm.png", "--arm", "a5"], ["no/folder/arm.png"]),
    (["--plot", "--arm", "a5", "--states", "x"], ["--states"]),
    (["--plot", "--arm", "a5", "--modes", "many"], ["many"]),
])
def test_a_plot_that_cannot_be_is_one_line(arguments, words, inspect_program, tmp_path):
    done = reed(*arguments, cwd=tmp_path)
    assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr
    assert all(word in done.stderr for word in words), done.stderr
