"""Every command of docs/your_robot.md, in its order, as a reader types them: with a UR5 as the robot."""

import re
import shlex

import pytest
from built import reed
from robot_files import urdf

from reed_tools.paths import ROOT

RECORDED = "bus.candump"  # of a real arm; here that of the run before


def commands():
    text = (ROOT / "docs" / "your_robot.md").read_text()
    return [shlex.split(line) for line in re.findall(r"^    tools/reed (.*)$", text, re.M)]


@pytest.fixture(scope="module")
def desk(tmp_path_factory):
    folder = tmp_path_factory.mktemp("desk")
    (folder / "ROBOT.urdf").write_text(urdf("ur_description/urdf/ur5_robot.urdf"))
    return folder


def test_the_tutorial_has_a_command_of_each_kind():
    assert {words[0] for words in commands()} == {"arm", "scenario", "tune", "identify", "run"}


@pytest.mark.parametrize("words", commands(), ids=" ".join)
def test_a_command_of_the_tutorial_does_what_it_says(words, desk):
    if RECORDED in words:
        (desk / RECORDED).write_bytes((desk / "out" / "excite" / RECORDED).read_bytes())
    before = set(desk.rglob("*"))
    done = reed(*words, cwd=desk)
    assert done.returncode == 0, done.stdout + done.stderr
    written = [words[k + 1] for k, word in enumerate(words) if word in ("--out", "--write")]
    assert all((desk / name).exists() for name in written) and (not written or set(desk.rglob("*")) > before)
