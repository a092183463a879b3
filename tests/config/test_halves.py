"""A program cannot even include the half that it may not know: its include roots do not hold it."""

import json
import os
import pathlib
import shlex
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / os.environ.get("REED_BUILD_DIR", "build/release")


def compiles(source: str, header: str, tmp_path) -> tuple[bool, str]:
    """Whether a file of the same target as `source` could include the header."""
    entries = json.loads((BUILD / "compile_commands.json").read_text())
    entry = next(entry for entry in entries if entry["file"] == str(ROOT / source))
    words = shlex.split(entry["command"])
    flags = [word for word in words if word.startswith(("-I", "-D", "-std"))]
    flags += ["-isystem" + words[i + 1] for i, word in enumerate(words) if word == "-isystem"]
    probe = tmp_path / "probe.cc"
    probe.write_text(f'#include "{header}"\n')
    done = subprocess.run(["c++", *flags, "-fsyntax-only", str(probe)], cwd=entry["directory"], capture_output=True, text=True)
    return done.returncode == 0, done.stderr


@pytest.mark.parametrize(("source", "own", "other"), [
    ("firmware/main.cc", "reed/config/controller/controller_config.h", "reed/config/plant/plant_config.h"),
    ("plant_sim/main.cc", "reed/config/plant/plant_config.h", "reed/config/controller/controller_config.h"),
    ("firmware/main.cc", "reed/config/controller/load_controller_config.h", "reed/config/schema/scenario.h"),
    ("plant_sim/main.cc", "reed/config/plant/load_plant_config.h", "reed/config/schema/scenario_file.h"),
])
def test_a_program_includes_its_own_half_only(source, own, other, tmp_path):
    assert compiles(source, own, tmp_path) == (True, "")
    fits, why = compiles(source, other, tmp_path)
    assert not fits and "No such file or directory" in why
