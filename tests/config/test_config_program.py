"""reed_config: what it refuses, in one line that names file, line, key and what is allowed; and what it writes."""

import json
import os
import pathlib
import re
import subprocess
import tomllib

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("REED_BUILD_DIR", ROOT / "build" / "release"))
PROGRAM = BUILD / "bin" / "reed_config"
DATA = pathlib.Path(__file__).resolve().parent / "data"  # sound files of the test's own: the shipped ones may change
ARM = (DATA / "a5.toml").read_text()
SCENARIO = (DATA / "press_known.toml").read_text()


def run(*arguments):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=30)
    return done.returncode, done.stderr


def refused(*arguments):
    status, error = run(*arguments)
    assert status == 2, (arguments, error)
    assert len(error.splitlines()) == 1, error
    return error


def line_of(text, part):
    """1-based number of the line that holds `part`, which stands in one line only."""
    numbers = [n for n, line in enumerate(text.splitlines(), 1) if part in line]
    assert len(numbers) == 1, (part, numbers)
    return numbers[0]


def changed(text, old, new):
    assert text.count(old) == 1, f"{old!r} stands there {text.count(old)} times"
    return text.replace(old, new)


# what is written instead, the line that is named, and words of the message
ARM_DEFECTS = {
    "a missing row": ("  [0.0, 0.35, 0.0],\n", "", "[[bodies]]", ["arm.bodies", "5 bodies for 4 joints"]),
    "a row too long": ("[0.0, 0.35, 0.0],", "[0.0, 0.35, 0.0, 0.1, 1.0],", "0.35, 0.0, 0.1", ["arm.dh[2]", "3 or 4 numbers"]),
    "an offset in degrees": ("[0.0, 0.35, 0.0],", "[0.0, 0.35, 0.0, 90.0],", "90.0", ["arm.dh[2]", "radians"]),
    "millimetres": ("[0.0, 0.35, 0.0],", "[0.0, 350.0, 0.0],", "350.0", ["arm.dh[2]", "metres"]),
    "degrees": ("[-1.5707963267948966, 0.0, 0.15],", "[-90.0, 0.0, 0.15],", "-90.0", ["arm.dh[4]", "radians"]),
    "a zero length": ("length = 0.35 ", "length = 0.0 ", "length = 0.0 ", ["arm.sections[1].length", "1e-04 ... 20 m"]),
    "a negative length": ("length = 0.35 ", "length = -0.35 ", "length = -0.35", ["arm.sections[1].length"]),
    "a length that is not the dh row's": ("length = 0.35 ", "length = 0.36 ", None, ["arm.sections[1]", "0.36", "0.35"]),
    "a negative mass": ("mass = 0.55", "mass = -0.55", "mass = -0.55", ["arm.bodies[2].mass", "0 ... 500 kg"]),
    "grams": ("mass = 0.55", "mass = 550.0", "mass = 550.0", ["arm.bodies[2].mass", "500 kg"]),
    "a unit that is not in the key": ("mass = 0.55", "mass_g = 550.0", None, ["arm.bodies[2].mass", "missing", "kg"]),
    "zero stiffness": ("joint_stiffness = [8000.0,", "joint_stiffness = [0.0,", "joint_stiffness", ["arm.joint_stiffness[0]", "N·m/rad"]),
    "negative stiffness": ("joint_stiffness = [8000.0,", "joint_stiffness = [-8000.0,", "joint_stiffness", ["arm.joint_stiffness[0]", "1 ... 1e+09 N·m/rad"]),
    "a missing section": ("length = 0.35 ", "long = 0.35 ", None, ["arm.sections[1].length", "missing", "m"]),
    "a member without mass": ("rhoA = 0.36261833204060195", "rhoA = 0.0", "rhoA = 0.0", ["arm.sections[1].rhoA", "kg/m"]),
    "a zero GJ": ("GJ = 719.2383525053651", "GJ = 0.0", "GJ = 0.0", ["arm.sections[1].GJ", "N·m²"]),
    "a rotor without inertia": ("rotor_inertia_reflected = [0.2,", "rotor_inertia_reflected = [0.0,", "rotor_inertia_reflected", ["arm.rotor_inertia_reflected[0]", "kg·m²"]),
    "an inertia in g·mm²": ("[0.0, 0.004125, 0.0]", "[0.0, 4125000.0, 0.0]", "4125000.0", ["arm.bodies[2].inertia_about_com", "kg·m²"]),
    "a negative EI": ("EI = 957.161305615505", "EI = -957.0", "EI = -957.0", ["arm.sections[1].EI", "N·m²"]),
    "an infinite EI": ("EI = 957.161305615505", "EI = inf", "EI = inf", ["arm.sections[1].EI", "finite"]),
    "an inertia against the triangle inequality": ("[0.0, 0.004125, 0.0]", "[0.0, 0.04125, 0.0]", "0.04125", ["arm.bodies[2].inertia_about_com", "triangle"]),
    "an inertia that is not symmetric": ("[0.0, 0.004125, 0.0]", "[0.1, 0.004125, 0.0]", "[0.1, 0.004125", ["not symmetric"]),
    "gravity in units of g": ("[0.0, 0.0, -9.81]", "[0.0, 0.0, -1.0]", "gravity = ", ["arm.gravity", "m/s²", "units of g"]),
    "gravity in mm": ("[0.0, 0.0, -9.81]", "[0.0, 0.0, -9810.0]", "gravity = ", ["arm.gravity[2]", "30 m/s²"]),
    "NaN": ("coulomb = [0.3, 0.3", "coulomb = [nan, 0.3", "coulomb", ["arm.coulomb[0]", "finite"]),
    "an unknown key": ("gravity = ", "gravitty = ", "gravitty", ["arm.gravitty", "unknown key", "gravity"]),
    "a missing joint": ("torque_limit = [40.0, ", "torque_limit = [", "torque_limit", ["arm.torque_limit", "4 numbers for 5 joints"]),
    "a text for numbers": ("torque_limit = [40.0, 40.0, 25.0, 12.0, 8.0]", 'torque_limit = "40 Nm"', "torque_limit", ["arm.torque_limit", "expected a number", "N·m"]),
    "an empty box": ("p_lo = [0.0,", "p_lo = [5.0,", "p_lo", ["arm.p_lo", "m2", "5 > 1.2"]),
    "an empty range": ("position_min = [-2.9,", "position_min = [2.95,", "position_min", ["arm.position_min", "joint 1"]),
    "too many joints": ("dh = [", "dh = [[0, 0, 0.1], [0, 0, 0.1], [0, 0, 0.1], [0, 0, 0.1],", "dh = [", ["9 joints", "1 ... 8"]),
    "a shape of nobody": ('param = "m3"', 'param = "m7"', 'param = "m7"', ["arm.param_shapes[3].param", "m7"]),
    "no TOML": ("dh = [", "dh = [[", None, ["not TOML"]),
}


@pytest.mark.parametrize("defect", ARM_DEFECTS)
def test_an_arm_file_with(defect, tmp_path):
    old, new, at, words = ARM_DEFECTS[defect]
    path = tmp_path / "arm.toml"
    text = changed(ARM, old, new)
    path.write_text(text)
    error = refused("--arm", str(path))
    assert error.startswith(f"{path}:"), error
    if at is not None and text.count(at) == 1:
        assert error.startswith(f"{path}:{line_of(text, at)}: "), error
    for word in words:
        assert word in error, error


SCENARIO_DEFECTS = {
    "an unknown key": ("offset_m", "offsett_m", "offsett_m", ["wall.offsett_m", "unknown key", "offset_m"]),
    "an unknown unit": ("offset_m", "offset_mm", "offset_mm", ["wall.offset_mm", "unknown key", "offset_m"]),
    "an unknown section": ("[wall]", "[walls]", "[walls]", ["walls", "unknown section", "wall,"]),
    "NaN": ("friction = 0.1", "friction = nan", "friction = nan", ["wall.friction", "finite", "0 ... 2"]),
    "a number out of range": ("friction = 0.1", "friction = 7.0", "friction = 7", ["wall.friction", "0 ... 2"]),
    "an unknown arm": ('arm = "a5"', 'arm = "b9"', 'arm = "b9"', ["'b9'", "a5, ", ".toml or .json"]),
    "an unknown leg": ('kind = "slide"', 'kind = "jump"', 'kind = "jump"', ["reference.legs[1].kind", "hold, joint"]),
    "a series that starts with a speed": ('kind = "slide"', 'kind = "fourier"\nsine_rad = [[0.1, 0, 0, 0, 0]]', "sine_rad", ["reference.legs[1].sine_rad", "joint 1", "0.314", "sum of k times"]),
    "a series that starts with an acceleration": ('kind = "slide"', 'kind = "fourier"\ncosine_rad = [[0, 0, 0.1, 0, 0]]', "cosine_rad", ["reference.legs[1].cosine_rad", "joint 3", "rad/s²"]),
    "a series that ends between periods": ('kind = "slide"                     # along the floor\nduration_s = 60.0',
                                           'kind = "fourier"\nsine_rad = [[0.2, 0, 0, 0, 0], [-0.1, 0, 0, 0, 0]]\nduration_s = 59.0', "duration_s = 59",
                                           ["reference.legs[1].duration_s", "29.5 periods", "whole ones, of 2 s"]),
    "a series without rows": ('kind = "slide"', 'kind = "fourier"', 'kind = "fourier"', ["reference.legs[1].kind", "needs sine_rad or cosine_rad"]),
    "a series for other joints": ('kind = "slide"', 'kind = "fourier"\nsine_rad = [[0.1, 0]]', "sine_rad", ["sine_rad[0]", "2 numbers for 5 joints"]),
    "a series beyond a turn": ('kind = "slide"', 'kind = "fourier"\nsine_rad = [[7.0, 0, 0, 0, 0]]', "sine_rad", ["sine_rad[0]", "-3.2 ... 3.2 rad"]),
    "an unknown law": ("Lambda = 15.0", 'Lambda = 15.0\nlaw = "magic"', "magic", ["control.law", "magic", "separated"]),
    "an unknown force source": ('source = "known"', 'source = "felt"', "felt", ["force.source", "known, unknown"]),
    "a force loop that is not stable": ("Lambda = 15.0", "Lambda = 15.0\nk_i = 3.0", "k_i = 3.0", ["control.k_i", "k_i < a_force k_p"]),
    "gains that chatter": ("K_d = [33.0, 30.0, 18.0, 5.5, 3.1]", "K_d = 400.0", "K_d", ["control.K_d", "joint 1", "120 N·m·s/rad"]),
    "too few gains": ("K_d = [33.0, 30.0, 18.0, 5.5, 3.1]", "K_d = [33.0, 30.0]", "K_d", ["control.K_d", "2 numbers for 5 joints"]),
    "a start beyond a joint limit": ("[0.0, 1.057362,", "[0.0, 2.057362,", "start_rad", ["reference.start_rad", "joint 2", "1.85"]),
    "a wall out of reach": ("[0.4, 0.0, 0.156]", "[0.4, 0.0, 3.0]", "point_m", ["wall.point_m", "reaches 1 m"]),
    "a seed with a fraction": ("seed = 1", "seed = 1.5", "seed", ["scenario.seed", "whole number"]),
    "a key twice": ("seed = 1", "seed = 1\nseed = 2", "seed = 2", ["not TOML"]),
}


@pytest.mark.parametrize("defect", SCENARIO_DEFECTS)
def test_a_scenario_with(defect, tmp_path):
    old, new, at, words = SCENARIO_DEFECTS[defect]
    path = tmp_path / "scenario.toml"
    text = changed(SCENARIO, old, new)
    path.write_text(text)
    error = refused("--config", str(path))
    assert error.startswith(f"{path}:{line_of(text, at)}: "), error
    for word in words:
        assert word in error, error


@pytest.mark.parametrize("assignment, words", [
    ("control.k_p=nan", ["--set control.k_p: ", "finite", "m/(s·N)"]),
    ("control.zz=1", ["control.zz", "unknown key", "K_d"]),
    ("wall.point_m=3", ["wall.point_m", "[x, y, z]"]),
    ("scenario.seed=-1", ["scenario.seed", "0 ... "]),
    ("nonsense", ["--set nonsense", "SECTION.KEY=VALUE"]),
    ("=3", ["SECTION.KEY=VALUE"]),
    ("nowhere.b=1", ["--set nowhere.b", "unknown section", "control"]),
    ("arm.torque_limit=0", ["arm.torque_limit", "0.001 ... 10000 N·m"]),
    ("arm.bodies.7.mass=1", ["'7'", "0 ... 4"]),
    ("arm.bodies.1.mass=-2", ["--set arm.bodies.1.mass: ", "-2", "0 ... 500 kg"]),
    ("reference.legs.x.kind=hold", ["'x'", "0 ... 1"]),
    ("timing.rate_hz=20 kHz", ["timing.rate_hz", "expected a number", "Hz"]),
    ("control.law=magic", ["control.law", "separated"]),
    ("sensors.force_range_N=50", ["limits.contact_force_N", "60 is not below 50 N", "saturates"]),
    ("control.k_p=0", ["control.k_p", "1e-06"]),
    ("control.K_d.2=6e-323", ["control.K_d: joint 3", "which no K_d has"]),  # times 0.9 it is itself, rounded
    ("limits.hold_age_cycles=10", ["limits.hold_age_cycles", "hold_age_cycles < stop_age_cycles"]),
])
def test_an_override_that_says(assignment, words):
    error = refused("--set", assignment)
    for word in words:
        assert word in error, error


@pytest.mark.parametrize("arguments, words", [
    (["--config", "nope"], ["'nope'", "press_known"]),
    (["--arm", "nope"], ["--arm nope", "a5, ", "p2"]),
    (["--config", "/no/such.toml"], ["/no/such.toml", "no such file"]),
    (["--arm", "/no/such.json"], ["/no/such.json", "no such file"]),
    (["--write", "/no/such/folder/x"], ["/no/such/folder/x"]),
    (["--colour", "red"], ["--colour"]),
])
def test_a_command_line_with(arguments, words):
    error = refused(*arguments)
    for word in words:
        assert word in error, error


def a5_as_json():
    """The arm in the other format: no limits of position and speed, and keys for people only."""
    arm = tomllib.loads(ARM)
    for key in ("position_min", "position_max", "speed_limit"):
        del arm[key]
    arm["tool_offset_in_last_frame"] = arm.pop("tool_offset")
    return arm | {"units": "SI, rad", "convention": "modified (Craig) DH", "dh_rows": ["alpha", "a", "d"], "note": "x"}


def test_a_json_arm_without_limits_runs_with_careful_ones(tmp_path):
    path, out = tmp_path / "arm.json", tmp_path / "effective.toml"
    path.write_text(json.dumps(a5_as_json(), indent=1))
    assert run("--arm", str(path), "--write", str(out)) == (0, "")
    arm = tomllib.loads(out.read_text())["arm"]
    assert arm["position_min"] == [-2.9] * 5 and arm["position_max"] == [2.9] * 5
    assert arm["speed_limit"] == [3.0] * 5
    given = tomllib.loads(ARM)
    for key in ("dh", "torque_limit", "joint_stiffness"):
        assert arm[key] == given[key]
    assert arm["truth"]["p"] == given["p_true"]


def a5_of_joints():
    """Its drives and bodies on a skew chain with rigid links."""
    arm = tomllib.loads(ARM)
    for key in ("dh", "tool_offset", "sections", "param_names", "param_shapes", "p_true", "p_nom", "p_lo", "p_hi"):
        del arm[key]
    return arm | {"joint": [{"name": f"j{i + 1}", "frame": f"l{i + 1}", "xyz_m": [0.1, 0.02, 0.3], "rpy_rad": [0.4 * i, -0.2, 1.1]} for i in range(5)],
                  "base": {"xyz_m": [0.0, 0.0, 0.8], "rpy_rad": [3.141592653589793, 0.0, 0.0]}, "tool": {"xyz_m": [0.0, 0.0, 0.08], "rpy_rad": [0.0, 1.5707963267948966, 0.0]}}


def test_joints_base_and_tool_read_back_as_they_were_written(tmp_path):
    arm = a5_of_joints()
    path, first, second = tmp_path / "arm.json", tmp_path / "first.toml", tmp_path / "second.toml"
    path.write_text(json.dumps(arm))
    flat = ("--set", "wall.present=false", "--set", 'force.source="none"', "--set", "reference.legs=[]", "--set", "arm.torque_limit=100.0")
    assert run("--arm", str(path), *flat, "--write", str(first)) == (0, "")
    effective = tomllib.loads(first.read_text())["arm"]
    for key in ("joint", "base", "tool"):
        assert effective[key] == arm[key]
    assert effective["force_sensor"] == arm["tool"] | {"tool_mass_kg": 0.0, "tool_com_m": [0.0, 0.0, 0.0]}, "in the tool's frame where nothing is said"
    assert "dh" not in effective and "sections" not in effective
    assert run("--config", str(first), "--write", str(second)) == (0, "")
    assert second.read_text() == first.read_text()


def test_reach_is_measured_from_the_base():
    moved = ("--set", "arm.base.xyz_m=[0, 0, 5]")
    assert "the wall is 4.844 m away" in refused(*moved)
    assert run(*moved, "--set", "wall.point_m=[0.4, 0.0, 5.156]") == (0, "")


JOINT_DEFECTS = {
    "a prismatic joint": (lambda arm: arm["joint"][2].update(type="prismatic"), ["arm.joint[2].type", "'prismatic'", "allowed: revolute"]),
    "a joint that follows another": (lambda arm: arm["joint"][2].update(mimic="j1"), ["arm.joint[2].mimic", "unknown key", "xyz_m"]),
    "an axis of its own": (lambda arm: arm["joint"][2].update(axis=[0, 1, 0]), ["arm.joint[2].axis", "unknown key", "rpy_rad"]),
    "a frame that two joints move": (lambda arm: arm["joint"][2].update(frame="l1"), ["arm.joint[2].frame", "'l1' is given twice", "serial"]),
    "a joint's name twice": (lambda arm: arm["joint"][2].update(name="j1"), ["arm.joint[2].name", "'j1' is given twice"]),
    "a name that is not ASCII": (lambda arm: arm["joint"][2].update(frame="épaule"), ["arm.joint[2].frame", "ASCII"]),
    "millimetres": (lambda arm: arm["joint"][1].update(xyz_m=[0, 0, 425]), ["arm.joint[1].xyz_m[2]", "10 m"]),
    "degrees": (lambda arm: arm["joint"][1].update(rpy_rad=[0, 0, 90]), ["arm.joint[1].rpy_rad[2]", "rad"]),
    "too many joints": (lambda arm: arm["joint"].extend([{}] * 4), ["arm.joint", "9 joints", "1 ... 8"]),
    "no joints": (lambda arm: arm["joint"].clear(), ["arm.joint", "missing"]),
    "rows beside joints": (lambda arm: arm.update(dh=[[0, 0, 0]] * 5), ["arm.dh", "one of them"]),
    "a tool given twice": (lambda arm: arm.update(tool_offset=[0, 0, 0.1]), ["arm.tool_offset", "twice", "arm.tool.xyz_m"]),
    "a tool heavier than its link": (lambda arm: arm.update(force_sensor={"tool_mass_kg": 1.2}), ["arm.force_sensor", "tool_mass_kg 1.2", "0.9 kg"]),
    "a base that is no section": (lambda arm: arm.update(base=[0, 0, 0]), ["arm.base", "expected a section"]),
    "sections beside links that are skew": (lambda arm: arm.update(sections=tomllib.loads(ARM)["sections"]), ["arm.sections", "joint 1", "allowed"]),
}


@pytest.mark.parametrize("defect", JOINT_DEFECTS)
def test_an_arm_of_joints_with(defect, tmp_path):
    change, words = JOINT_DEFECTS[defect]
    arm = a5_of_joints()
    change(arm)
    path = tmp_path / "arm.json"
    path.write_text(json.dumps(arm, indent=1))
    error = refused("--arm", str(path))
    assert error.startswith(f"{path}:"), error
    for word in words:
        assert word in error, error


@pytest.mark.parametrize("key", ["rotor_inertia_reflected", "joint_stiffness", "torque_limit"])
def test_an_arm_that_does_not_say_what_its_drives_are_made_of_is_refused_by_key(key, tmp_path):
    arm = a5_as_json()
    del arm[key]
    path = tmp_path / "arm.json"
    path.write_text(json.dumps(arm, indent=1))
    error = refused("--arm", str(path))
    assert f"arm.{key}" in error and "missing" in error and str(path) in error


def test_a_defect_in_a_json_arm_is_named_with_its_line(tmp_path):
    arm = a5_as_json()
    arm["torque_limit"] = [40.0, 40.0]
    path = tmp_path / "arm.json"
    text = json.dumps(arm, indent=1)
    path.write_text(text)
    assert refused("--arm", str(path)).startswith(f"{path}:{line_of(text, 'torque_limit')}: arm.torque_limit")
    path.write_text(text[:-20])
    assert "not JSON" in refused("--arm", str(path))


def digits(number):
    """How many significant ones."""
    return len(number.split("e")[0].replace(".", "").replace("-", "").strip("0"))


def test_effective_numbers_are_as_short_as_typed_and_read_back_unchanged(tmp_path):
    first, second = tmp_path / "first.toml", tmp_path / "second.toml"
    numbers = "[0.3, 0.1, 1e-05, 123456789.125, 100.0]"
    assert run("--set", "control.Lambda=0.1", "--set", "arm.joint_hardening=" + numbers, "--write", str(first)) == (0, "")
    text = first.read_text()
    assert "Lambda = [0.1, 0.1, 0.1, 0.1, 0.1]" in text
    for number in re.findall(r"-?\d+\.\d+(?:e[+-]\d+)?", text):
        assert digits(number) <= digits(repr(float(number))), number
    effective = tomllib.loads(text)
    assert effective["arm"]["joint_hardening"] == json.loads(numbers)
    assert isinstance(effective["arm"]["joint_hardening"][4], float)
    assert effective["arm"]["dh"] == tomllib.loads(ARM)["dh"]
    assert run("--config", str(first), "--write", str(second)) == (0, "")
    assert second.read_text() == text


@pytest.mark.parametrize("arguments, meant", [
    (("--config", "press_knwon"), "press_known"),
    (("--arm", "a55"), "a5"),
    (("--set", "wall.stifness_Npm=1"), "stiffness_Npm"),
    (("--set", "wal.friction=1"), "wall"),
    (("--set", "arm.couloumb=[0.1]"), "coulomb"),
    (("--set", 'control.law="seperated"'), "separated"),
    (("--set", 'force.source="unkonwn"'), "unknown"),
])
def test_a_slip_of_the_fingers_gets_the_word_that_was_meant(arguments, meant):
    assert f"; did you mean '{meant}'? allowed: " in refused(*arguments)


@pytest.mark.parametrize("word", ["zzzzzzz", "x", "stiffness_Npm" * 1000])
def test_what_is_near_to_nothing_gets_the_list_alone(word):
    told = refused("--set", f"wall.{word}=1")
    assert "unknown key; allowed: present" in told and "mean" not in told


def test_the_readme_holds_the_table_of_every_key():
    keys = subprocess.run([PROGRAM, "--keys"], capture_output=True, text=True, check=True).stdout
    assert keys in (ROOT / "config/README.md").read_text(), "build/venv/bin/python3 docs/make_reference.py"
    arm_keys = subprocess.run([PROGRAM, "--arm-keys"], capture_output=True, text=True, check=True).stdout
    assert arm_keys in (ROOT / "config/README.md").read_text(), "build/venv/bin/python3 docs/make_reference.py"


def test_the_readme_names_every_key_of_the_arm_and_every_check():
    readme = (ROOT / "config/README.md").read_text()
    known = refused("--set", "arm.zz=1").split("allowed: ")[1].strip().split(", ")
    assert len(known) > 20
    for key in known:
        assert key in readme, key
    from reed_tools.figures import checks
    for name, figure in checks.FIGURES.items():
        assert f"| {name} | {figure.__doc__} |" in readme, name


def test_another_truth_moves_the_bodies_and_nothing_that_the_controller_knows(tmp_path):
    """By hand: the hand is m4 at z = -0.075 m and mL at the tip; m2 is a rod of 0.35 m; bodies without a parameter stay."""
    def effective(*options, config="press_known"):
        path = tmp_path / f"{len(list(tmp_path.iterdir()))}.toml"
        assert run("--config", str(config), "--write", str(path), *options) == (0, "")
        return path, tomllib.loads(path.read_text())

    _, before = effective()
    path, after = effective("--set", "plant.p_true=[1.0,0.2,0.06,0.55,0.6,0.25]")
    bodies, old = after["arm"]["truth"]["bodies"], before["arm"]["truth"]["bodies"]
    assert bodies[1]["mass"] == pytest.approx(1.0) and bodies[1]["com"] == pytest.approx([0.175, 0, 0])
    assert bodies[1]["inertia_about_com"][2][2] == pytest.approx(1.0 * 0.35**2 / 12)
    assert bodies[0]["inertia_about_com"][2][2] == pytest.approx(0.2) and bodies[0]["mass"] == 0
    assert bodies[2] == old[2] and bodies[3] == old[3]
    m, c = 0.6 + 0.25, -0.075 * 0.6 / (0.6 + 0.25)
    assert bodies[4]["mass"] == pytest.approx(m) and bodies[4]["com"] == pytest.approx([0, 0, c])
    # about the centre of mass: both parts' own inertia and their distances from it
    own = 0.6 * 0.0021 + 0.25 * 0.00064
    assert bodies[4]["inertia_about_com"][0][0] == pytest.approx(own + 0.6 * (0.075 + c)**2 + 0.25 * c**2)
    assert after["arm"]["truth"]["p"] == [1.0, 0.2, 0.06, 0.55, 0.6, 0.25]
    assert {key for key in before["arm"] if after["arm"][key] != before["arm"][key]} == {"truth"}
    assert {key for key in before["arm"]["truth"] if after["arm"]["truth"][key] != before["arm"]["truth"][key]} == {"bodies", "p"}
    assert effective(config=path)[1] == after  # read back as it was written


def test_a_truth_outside_its_box_is_refused():
    assert "m2: truth 1.3 lies outside the box 0 ... 1.2" in refused("--config", "press_known", "--set",
                                                                     "plant.p_true=[1.3,0.15,0.12,0.55,0.4,0.5]")
    assert "3 numbers for 6 parameters" in refused("--config", "press_known", "--set", "plant.p_true=[0.7,0.15,0.12]")


TRUTHS = ("plant", "drives", "disturbance")  # sections of the plant alone


def halves(folder, *options):
    controller, plant = folder / "controller.toml", folder / "plant.toml"
    assert run(*options, "--write-controller", str(controller), "--write-plant", str(plant)) == (0, "")
    return controller, plant


def test_the_controllers_half_does_not_change_with_the_truth(tmp_path):
    """Every true value is moved; what is written for the controller stays the same text."""
    moved = {"arm.truth.p": "[1.0,0.2,0.06,0.5,0.6,0.25]", "arm.truth.coulomb": "0.01", "plant.stiffness_scale": "0.9",
             "plant.friction_scale": "2", "plant.payload_step_kg": "0.3", "drives.torque_bits": "12", "sensors.force_bias_N": "[0,0,3]",
             "sensors.moment_noise_Nm": "0.2", "sensors.moment_bias_Nm": "[0.1,0,0]", "sensors.wrench_lost_from_s": "1.0", "sensors.wrench_lost_to_s": "2.0",
             "wall.offset_m": "0.004", "wall.stiffness_Npm": "2e4", "wall.friction": "0.4", "disturbance.bias_N": "[1,2,3]"}
    arm = tmp_path / "a5.toml"  # says what is known of the links by itself: nothing but the parameters
    known = "[[known_bodies]]\nmass = 0.0\n" * 5
    arm.write_text((ROOT / "config/arms/a5.toml").read_text().replace("[truth]\n", f"{known}\n[truth]\n"))
    (tmp_path / "one").mkdir(), (tmp_path / "other").mkdir()
    common = ("--config", "press_known", "--arm", str(arm), "--set", "control.coulomb_known=0.9")
    one, plant_one = halves(tmp_path / "one", *common)
    other, plant_other = halves(tmp_path / "other", *common, *(f"--set={key}={value}" for key, value in moved.items()))
    assert one.read_text() == other.read_text()
    assert plant_one.read_text() != plant_other.read_text()


def test_the_halves_hold_nothing_of_each_other_and_are_read_back_unchanged(tmp_path):
    controller, plant = halves(tmp_path, "--config", "press_known", "--set", "control.coulomb_known=0.5")
    knows, is_so = tomllib.loads(controller.read_text()), tomllib.loads(plant.read_text())
    assert not set(TRUTHS) & set(knows) and not {"truth", "bodies", "coulomb", "p_true"} & set(knows["arm"])
    assert set(knows["wall"]) == {"present", "point_m", "normal"}
    assert set(knows["sensors"]) == {"wrench", "encoder_bits", "velocity_filter_hz", "force_range_N", "force_noise_N", "force_quantum_N", "moment_range_Nm"}
    assert knows["arm"]["coulomb_nominal"] == [0.15, 0.15, 0.1, 0.05, 0.025]  # the share that is declared as known
    assert knows["arm"]["coulomb_declared"] == [0.3, 0.3, 0.2, 0.1, 0.05]
    assert not {"control", "force", "limits", "checks"} & set(is_so) and "legs" not in is_so["reference"]
    assert not {"p_nom", "p_lo", "p_hi", "param_names"} & set(is_so["arm"])
    again = tmp_path / "again.toml"
    assert run("--config", str(controller), "--write-controller", str(again)) == (0, "")
    assert again.read_text() == controller.read_text()


def test_the_shipped_arms_mean_what_they_meant_before_the_truth_had_its_place(tmp_path):
    """tests/config/data/a5.toml is the old form, keys of the truth among the others."""
    old, new = tmp_path / "old.toml", tmp_path / "new.toml"
    assert run("--arm", str(DATA / "a5.toml"), "--write", str(old)) == run("--arm", "a5", "--write", str(new)) == (0, "")
    assert old.read_text() == new.read_text()


@pytest.mark.parametrize(("key", "place", "value"), [("p_true", "p", [0.6, 0.1, 0.1, 0.5, 0.3, 0.4]),
                                                     ("coulomb", "coulomb", [0.1, 0.2, 0.1, 0.2, 0.1])])
def test_the_old_keys_of_the_truth_are_still_set(key, place, value, tmp_path):
    out = tmp_path / "effective.toml"
    for arm in ("a5", str(DATA / "a5.toml")):
        assert run("--arm", arm, "--set", f"arm.{key}={value}", "--write", str(out)) == (0, "")
        assert tomllib.loads(out.read_text())["arm"]["truth"][place] == value


def test_a_truth_in_both_places_is_refused(tmp_path):
    arm = tmp_path / "a5.toml"
    arm.write_text(ARM + "\n[truth]\np = [0.7, 0.15, 0.12, 0.55, 0.4, 0.5]\n")
    assert "arm.p_true: given twice; it is truth.p now" in refused("--arm", str(arm))
    arm.write_text(ARM + "\n[truth]\ncoulomb = 0.1\n")
    assert f"{arm}:{line_of(ARM, 'coulomb = ')}: arm.coulomb: given twice" in refused("--arm", str(arm))


def test_bodies_beside_nominal_values_move_with_the_truth(tmp_path):
    """A file that says what one knows, and a truth that is all that differs: m2 is a rod of 0.35 m."""
    arm, out = tmp_path / "arm.toml", tmp_path / "effective.toml"
    text = changed(ARM, "p_true = [0.7, 0.15, 0.12, 0.55, 0.4, 0.5]", "").split("[[bodies]]")
    assert "p_true" not in "".join(text)
    arm.write_text("[[bodies]]".join(text))  # the bodies are those at p_nom now
    assert run("--arm", str(arm), "--write", str(out)) == (0, "")
    nominal = tomllib.loads(out.read_text())["arm"]
    assert nominal["truth"]["p"] == nominal["p_nom"]
    arm.write_text("[[bodies]]".join(text) + "\n[truth]\np = [0.9, 0.05, 0.05, 0.3, 0.2, 0.0]\n")
    assert run("--arm", str(arm), "--write", str(out)) == (0, "")
    true = tomllib.loads(out.read_text())["arm"]
    assert true["truth"]["bodies"][1]["mass"] == pytest.approx(nominal["truth"]["bodies"][1]["mass"] + 0.5)
    assert true["truth"]["bodies"][2] == nominal["truth"]["bodies"][2]
    assert true["p_nom"] == nominal["p_nom"]


DEEP = {"json": "[" * 30000 + "]" * 30000, "toml": "a" + ".a" * 40000 + " = 1\n"}


@pytest.mark.parametrize("kind", DEEP)
def test_depth_has_a_limit(kind, tmp_path):
    path = tmp_path / f"deep.{kind}"
    path.write_text('{"dh": ' + DEEP[kind] + "}" if kind == "json" else "# one\n" + DEEP[kind])
    error = refused("--arm", str(path))
    assert str(path) in error and "nested deeper than 64 levels" in error
    assert kind == "json" or f"{path}:2: " in error
    scenario = tmp_path / "deep2.toml"
    scenario.write_text(SCENARIO + "\n[x]\ny = {" + DEEP["toml"].strip() + "}\n")
    assert "nested deeper than 64 levels" in refused("--config", str(scenario))
    assert "nested deeper than 64 levels" in refused("--set", "arm" + ".a" * 40000 + "=1")
    assert "nested deeper" in refused("--set", "wall.x={" + "a." * 40000 + "a=1}")


def test_dots_in_texts_and_comments_are_no_depth(tmp_path):
    path = tmp_path / "dots.toml"
    path.write_text("# " + "." * 500 + "\n" + changed(SCENARIO, "[scenario]\n", "[scenario]\n# \"\n").replace(
        'description = "', 'description = "' + "." * 200))
    assert run("--config", str(path)) == (0, "")


@pytest.mark.parametrize("text", ['{"dh": 1e999}', '{"dh": 18446744073709551616000000}', "[1, 2]", "3", '{"dh": "\ud800"}', '{"\u0000": 1}'])
def test_odd_json_is_refused_in_one_line(text, tmp_path):
    path = tmp_path / "odd.json"
    path.write_bytes(text.encode(errors="surrogatepass"))
    assert str(path) in refused("--arm", str(path))


def test_long_names_and_files_are_refused(tmp_path):
    assert "no arm" in refused("--arm", "a" * 300) and "no scenario" in refused("--config", "a" * 300)
    assert "longer than 100" in refused("--set", f"scenario.name='{'a' * 101}'")
    assert "longer than 1000" in refused("--set", f"scenario.description='{'a' * 1001}'")
    assert run("--set", f"scenario.name='{'a' * 100}'") == (0, "")
    assert "control character" in refused("--set", 'scenario.name="one\\ntwo"')
    assert len(refused("--set", "control.law=" + "x" * 100_000)) < 1100
    path = tmp_path / "large.toml"
    path.write_text("# " + "x" * (5 << 20))
    assert "larger than 4 MiB" in refused("--config", str(path))


def test_an_index_into_an_empty_list_is_named_so(tmp_path):
    path = tmp_path / "none.toml"
    path.write_text("checks = []\n" + SCENARIO.split("[[checks]]")[0])
    assert "no entry '0'; the list is empty" in refused("--config", str(path), "--set", "checks.0.limit=1")


DOES_NOTHING_OR_CANNOT_BE = {
    "a force that trips": (["force.desired_N=60"], ["force.desired_N: 60 N is not below limits.contact_force_N = 60 N"]),
    "an end before the start": (["force.end_s=0.2"], ["force.end_s: 0.2 s is not after force.start_s = 0.3 s"]),
    "a slide without a frequency": (["reference.legs.1.frequency_hz=0"], ["reference.legs.1.frequency_hz", "stands still"]),
    "amplitudes without frequencies": (["disturbance.amplitude_N=[1,0,0]"], ["does nothing without disturbance.frequencies_hz"]),
    "frequencies without amplitudes": (["disturbance.frequencies_hz=[1]"], ["do nothing without disturbance.amplitude_N"]),
    "a known share of no friction": (["control.coulomb_known=0.9", "arm.coulomb_declared=[]"],
                                     ["control.coulomb_known: 0.9 of no friction", "arm.coulomb_declared or arm.coulomb_nominal"]),
    "a step at no time": (["disturbance.step_N=[1,0,0]"], ["does nothing without disturbance.step_s"]),
    "a sensor back before it is lost": (["sensors.wrench_lost_from_s=2", "sensors.wrench_lost_to_s=1"],
                                        ["sensors.wrench_lost_to_s: 1 s is not after wrench_lost_from_s = 2 s", "-1 for never"]),
    "a sensor back that never left": (["sensors.wrench_lost_to_s=1"], ["does nothing without sensors.wrench_lost_from_s"]),
    "a wall that is never met": (["wall.point_m=[0.4,0,0.06]"], ["wall.point_m: the wall is never met", "0.027 m"]),
    "masses in grams": (["arm.bodies.4.mass=120"], ["reference.start_rad: joint 2", "473", "its limit is 40 N·m (masses are in kg)"]),
    "a torque that no command carries": (["arm.torque_limit=2048"], ["arm.torque_limit: joint 1: 2048 N·m is not below the 2048 N·m"]),
    "a speed that no frame carries": (["arm.speed_limit=64"], ["arm.speed_limit: joint 1: 64 rad/s is not below the 64 rad/s"]),
    "a force that no frame carries": (["limits.contact_force_N=4097"], ["limits.contact_force_N", "0.1 ... 4096 N"]),
    "a sensor whose range no frame carries": (["sensors.force_range_N=4097"], ["sensors.force_range_N", "1 ... 4096 N"]),
}


@pytest.mark.parametrize("case", DOES_NOTHING_OR_CANNOT_BE)
def test_what_does_nothing_or_cannot_be_is_refused(case):
    entries, words = DOES_NOTHING_OR_CANNOT_BE[case]
    error = refused("--config", "press_known", *(f"--set={entry}" for entry in entries))
    for word in words:
        assert word.replace("legs.1", "legs") in error.replace("legs.1", "legs").replace("legs[1]", "legs"), error


def test_just_inside_is_accepted():
    for entry in ("force.desired_N=59", "force.end_s=0.4", "wall.point_m=[0.4,0,0.14]", "arm.torque_limit=2047", "arm.speed_limit=63",
                  "limits.contact_force_N=190", "sensors.force_range_N=4096", "sensors.wrench_lost_from_s=2", "arm.position_max=6.2832"):
        assert run("--config", "press_known", "--set", entry) == (0, ""), entry


def test_a_wall_beside_the_plane_of_a_planar_arm_is_refused():
    press = ["--set=force.source='unknown'", "--set=force.desired_N=5", "--set=wall.present=true", "--set=wall.point_m=[0.8,0,0.1]"]
    assert "wall.normal: no joint of this arm moves the tool point along it" in refused(
        "--config", "joints2", *press, "--set=wall.normal=[0,1,0]")


def test_a_mass_too_small_for_its_inertia_is_refused_before_it_is_written():
    assert "body 7: mass 1e-09 kg is too small for its inertia" in refused("--config", "joints7", "--set", "arm.bodies.6.mass=1e-9")


def test_what_has_no_name_has_its_files(tmp_path):
    (tmp_path / "my_arm.toml").write_text(changed(ARM, 'name = "a5"\n', ""))
    for stem, name in (("my_press", "my_press"), ("é" * 80, "é" * 50)):  # as long as a name may be, in bytes
        nameless = tmp_path / f"{stem}.toml"
        nameless.write_text(re.sub(r'^(name|arm) = .*\n', "", SCENARIO, count=2, flags=re.M).replace("[scenario]", 'arm = "my_arm.toml"\n\n[scenario]', 1))
        out = tmp_path / "effective.toml"
        assert run("--config", str(nameless), "--write", str(out)) == (0, "")
        effective = tomllib.loads(out.read_text())
        assert (effective["scenario"]["name"], effective["arm"]["name"]) == (name, "my_arm")
