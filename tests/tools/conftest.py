"""A build directory whose programs are stand-ins (fake_program.py); configuration and message types are real."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from reed_tools.paths import BUILD, PYTHON, ROOT

HERE = Path(__file__).parent


@pytest.fixture(scope="session")
def fake_build(tmp_path_factory):
    build = tmp_path_factory.mktemp("build")
    (build / "bin").mkdir()
    (build / "lcmtypes").symlink_to(BUILD / "lcmtypes")
    (build / "bin" / "reed_config").symlink_to(BUILD / "bin" / "reed_config")
    for name in ("reed_firmware", "reed_plant_sim", "reed_one_process"):
        path = build / "bin" / name
        path.write_text(f"#!{sys.executable}\nimport sys\nsys.path[:0] = {[str(ROOT / 'tools'), str(HERE)]!r}\n"
                        "import fake_program\nsys.exit(fake_program.main())\n")
        path.chmod(0o755)
    return build


@pytest.fixture
def reed(fake_build):
    """reed(*argv, **environment) runs the tools against the stand-ins; reed.start(...) does not wait."""

    def environment(extra):
        return {**os.environ, "REED_BUILD_DIR": str(fake_build), **extra}

    def command(argv):
        return [*PYTHON, str(ROOT / "tools" / "reed_tools" / "__main__.py"), *map(str, argv)]  # as tools/reed does

    def call(*argv, cwd=None, **extra):
        return subprocess.run(command(argv), env=environment(extra), cwd=cwd, capture_output=True, text=True, timeout=120)

    def start(*argv, **extra):
        return subprocess.Popen(command(argv), env=environment(extra), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    call.start = start
    call.command, call.environment = command, environment
    return call
