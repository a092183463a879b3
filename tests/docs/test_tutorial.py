"""The tutorial is run: its commands and its Python, one after the other. The reference is what its sources say."""

import importlib.util
import os
import re
import shlex
import subprocess

import pytest
from built import reed
from PIL import Image

from reed_tools.paths import PYTHON, ROOT
from reed_tools.run import bus_choice

TUTORIAL = (ROOT / "docs" / "tutorial.md").read_text()
COMMANDS = re.findall(r"^    tools/reed (.*)$", TUTORIAL, re.M)
STATUS = {"doctor": {0}, "run": {0, 1}, "replay": {0}, "compare": {0}, "campaign": {0, 1}}  # 1: a figure beyond its limit
QUICK = {"campaign": ["--draws", "2", "--jobs", "1", "--repeat", "0"]}  # instead of twenty


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """The folders that stand for out/RUN and out/OTHER."""
    folder = tmp_path_factory.mktemp("out")
    for name, stiffness in (("RUN", 10000), ("OTHER", 12000)):
        done = reed("run", "press_known", "--bus", "memory", "--duration", "1.2", "--set", f"wall.stiffness_Npm={stiffness}", "--out", str(folder / name), cwd=ROOT)
        assert done.returncode in (0, 1), done.stderr
    return folder


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_of_the_tutorial_runs(command, runs, tmp_path):
    words = [str(runs / word.removeprefix("out/")) if word.startswith("out/") else word for word in shlex.split(command)]
    if "socketcan:vcan0" in words and not bus_choice.interface_exists("vcan0"):
        words[words.index("socketcan:vcan0")] = "memory"  # a kernel without CAN
    if words[0] == "run" and "--bus" not in words:
        words += ["--bus", "memory"]  # a bus of its own: tests run side by side
    if words[0] == "campaign":
        words = [*words[:2], *QUICK["campaign"]]
    if words[0] in ("run", "campaign", "compare"):
        words += ["--out", str(tmp_path / "out")]
    done = reed(*words, cwd=ROOT)
    assert done.returncode in STATUS[words[0]], (words, done.stdout[-500:], done.stderr)


def test_the_python_of_the_tutorial_runs(tmp_path):
    (code,) = re.findall(r"^```python\n(.*?)^```$", TUTORIAL, re.M | re.S)
    done = subprocess.run([PYTHON[0], "-c", code], cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(ROOT / "tools")}, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert "N·m" in done.stdout and done.stdout.count("wall.stiffness_Npm") == 2 and (tmp_path / "out" / "first" / "force_again.png").exists()


def script(name):
    spec = importlib.util.spec_from_file_location(name, ROOT / "docs" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_pictures_of_the_readme_are_made_by_a_command(tmp_path):
    """Of the same size; what they show follows the controller."""
    pictures = script("make_pictures")
    shown = re.findall(r'<img src="docs/([^"]+)"', (ROOT / "README.md").read_text())
    assert sorted(shown) == sorted(pictures.PICTURES.values())
    pictures.make(tmp_path)
    for name in shown:
        assert Image.open(tmp_path / name).size == Image.open(ROOT / "docs" / name).size


def test_the_reference_is_what_its_sources_say():
    module = script("make_reference")
    assert module.text() == module.TARGET.read_text(), "build/venv/bin/python3 docs/make_reference.py"
    for section in ("SYNC", "REED_CONTROL", "joint_position", "JOINT_STATE_1", "host_pause"):
        assert section in module.text()
