"""The two exchanges between threads, over all interleavings (spin): the right ones hold, each wrong one fails."""

import shutil
import subprocess
from pathlib import Path

import pytest

MODELS = Path(__file__).parent / "models"
needs_spin = pytest.mark.skipif(not shutil.which("spin") or not shutil.which("gcc"), reason="apt install spin gcc")


def verify(model: str, tmp_path, *defines: str) -> str:
    (tmp_path / model).write_bytes((MODELS / model).read_bytes())
    for command in (["spin", *defines, "-a", model], ["gcc", "-O1", "-DSAFETY", "-o", "pan", "pan.c"], ["./pan", "-m100000"]):
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120)
        output = done.stdout + done.stderr
    assert "errors:" in output, output
    return output


@needs_spin
@pytest.mark.parametrize("model", ["ring.pml", "latest_value.pml"])
def test_every_interleaving_holds(model, tmp_path):
    output = verify(model, tmp_path)
    assert "errors: 0" in output, output
    assert "max search depth too small" not in output


@needs_spin
@pytest.mark.parametrize("model, wrong", [("ring.pml", "-DWRONG_PUBLISH"), ("ring.pml", "-DWRONG_FULL"),
                                          ("latest_value.pml", "-DWRONG_EXCHANGE"), ("latest_value.pml", "-DWRONG_BUFFERS")])
def test_the_wrong_variant_fails(model, wrong, tmp_path):
    assert "assertion violated" in verify(model, tmp_path, wrong)
