"""Instructions of each stage, counted by callgrind on recorded inputs: a run of 2N less a run of N, so set-up cancels."""

import re
import shutil
import subprocess
import tomllib

import pytest

from reed_tools.paths import BUILD, ROOT

BUDGET = tomllib.loads((ROOT / "bench" / "budget.toml").read_text())["x86_64"]
MARGIN = 1.05
STEPS = 640  # ten times through the 64 inputs

pytestmark = pytest.mark.skipif(not shutil.which("valgrind"), reason="apt install valgrind")


def instructions(stage: str, steps: int) -> int:
    done = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                           str(BUILD / "bin" / f"reed_bench_{stage}"), str(steps)], capture_output=True, text=True, timeout=600)
    return int(re.search(r"refs:\s+([\d,]+)", done.stderr).group(1).replace(",", ""))


@pytest.mark.parametrize("stage", ["step", "regressor", "codec"])
def test_a_stage_stays_within_its_budget(stage):
    each = (instructions(stage, 2 * STEPS) - instructions(stage, STEPS)) / STEPS
    assert 0 < each <= BUDGET[stage] * MARGIN, f"{stage}: {each:.0f} instructions, budget {BUDGET[stage]}"
