"""Keys that save computing by hand: a start by its tool point, a tube by its sizes, an arm beside its scenario."""

import os
import pathlib
import subprocess
import tomllib

import numpy as np
import pytest

from reed_tools.robots import arm_lines

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("REED_BUILD_DIR", ROOT / "build" / "release")) / "bin"
PRESS = (ROOT / "config/scenarios/press_known.toml").read_text()
A5 = (ROOT / "config/arms/a5.toml").read_text()


def run(*arguments, cwd=ROOT):
    done = subprocess.run([BIN / "reed_config", *map(str, arguments)], capture_output=True, text=True, timeout=30, cwd=cwd)
    return done.returncode, done.stderr


def refused(*arguments, cwd=ROOT):
    status, error = run(*arguments, cwd=cwd)
    assert status == 2 and len(error.splitlines()) == 1, error
    return error


def effective(tmp_path, *arguments):
    assert run(*arguments, "--write", tmp_path / "effective.toml") == (0, "")
    return tomllib.loads((tmp_path / "effective.toml").read_text())


@pytest.mark.parametrize("near", ["[]", "[0.0, 1.0, -1.7, -2.4, 0.0]"])
def test_a_start_is_found_for_its_tool_point(tmp_path, near):
    wanted = [0.4, 0.05, 0.17]
    found = effective(tmp_path, "--config", "press_known", "--set", f"reference.start_rad={near}", "--set", f"reference.start_tip_m={wanted}")
    drawn = arm_lines.centre_line(found["arm"], np.array([found["reference"]["start_rad"]]))[0]  # other code than the search's
    assert drawn[-1] == pytest.approx(wanted, abs=1e-9)
    assert "start_tip_m" not in found["reference"]  # what the programs run with are angles


def test_a_tool_point_out_of_reach_is_refused():
    assert "--set reference.start_tip_m: no joint angles" in refused("--config", "free_motion", "--set", "reference.start_tip_m=[2,0,0]")
    assert "reaches 1 m" in refused("--config", "free_motion", "--set", "reference.start_tip_m=[2,0,0]")
    assert "expected [x, y, z]" in refused("--config", "free_motion", "--set", "reference.start_tip_m=[0.4,0]")


def with_tube(text):
    """The first section of a5 by its sizes, as its comment says them."""
    lines = text.splitlines()
    at = lines.index("[[sections]]") + 2
    return "\n".join([*lines[:at], 'tube = {outer = 0.06, wall = 0.003, material = "aluminium"}', *lines[at + 4:]])


def test_a_tube_is_what_its_section_is_by_hand(tmp_path):
    (tmp_path / "tube.toml").write_text(with_tube(A5))
    by_hand = effective(tmp_path, "--config", "press_known")["arm"]["sections"][0]
    by_tube = effective(tmp_path, "--config", "press_known", "--arm", tmp_path / "tube.toml")["arm"]["sections"][0]
    assert by_tube == pytest.approx(by_hand, rel=1e-12) and set(by_tube) == {"length", "EA", "EI", "GJ", "rhoA"}


@pytest.mark.parametrize("change, told", [(('material = "aluminium"', 'material = "aluminum"'), ["material", "aluminium"]),
                                          (("wall = 0.003", "wall = 0.031"), ["sections[0].tube.wall", "half of outer"]),
                                          (("outer = 0.06, ", ""), ["sections[0].tube.outer", "missing"]),
                                          (("tube =", "EA = 1e7\ntube ="), ["sections[0].EA: given twice"]),
                                          (("tube = {", "tube = 3 # {"), ["sections[0].tube", "expected {outer"])])
def test_a_tube_that_is_none_is_refused(tmp_path, change, told):
    path = tmp_path / "tube.toml"
    path.write_text(with_tube(A5).replace(*change))
    error = refused("--config", "press_known", "--arm", path)
    for word in (f"{path}:", *told):
        assert word in error, error


def test_an_arm_is_found_beside_the_scenario_that_names_it(tmp_path):
    here, elsewhere = tmp_path / "here", tmp_path / "elsewhere"
    here.mkdir(), elsewhere.mkdir()
    scenario = here / "press.toml"
    scenario.write_text(PRESS.replace('arm = "a5"', 'arm = "own/arm.toml"'))
    at = PRESS.splitlines().index('arm = "a5"') + 1
    error = refused("--config", scenario, cwd=elsewhere)
    assert f"{scenario}:{at}: arm: {here}/own/arm.toml: no such file" in error
    (here / "own").mkdir()
    (here / "own" / "arm.toml").write_text(A5)
    assert run("--config", scenario, cwd=elsewhere) == (0, "")
    (here / "own" / "arm.toml").rename(elsewhere / "arm.toml")  # relative to the working directory, as it was
    scenario.write_text(PRESS.replace('arm = "a5"', 'arm = "./arm.toml"'))
    assert run("--config", scenario, cwd=elsewhere) == (0, "")


def test_a_pose_without_equilibrium_is_refused_with_its_line():
    scenario = ROOT / "config/scenarios/press_known.toml"
    at = next(n for n, line in enumerate(PRESS.splitlines(), 1) if line.startswith("start_rad"))
    error = refused("--config", "press_known", "--set", "arm.joint_stiffness=1")
    assert f"{scenario}:{at}: reference.start_rad: the simulated arm finds no equilibrium there" in error
