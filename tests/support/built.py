"""The tools with the programs that are built, as tools/reed starts them; tests/tools/conftest.py has them with stand-ins."""

import os
import subprocess

from reed_tools.paths import BUILD, PYTHON, ROOT

ENVIRONMENT = {**os.environ, "REED_BUILD_DIR": str(BUILD)}
LONGEST_S = 600


def command(*argv) -> list[str]:
    return [*PYTHON, str(ROOT / "tools" / "reed_tools" / "__main__.py"), *map(str, argv)]


def reed(*argv, cwd=None) -> subprocess.CompletedProcess:
    return subprocess.run(command(*argv), env=ENVIRONMENT, cwd=cwd, capture_output=True, text=True, timeout=LONGEST_S)
