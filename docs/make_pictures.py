"""Draws the pictures of README.md from one run: docs/press_known*.png.

    build/venv/bin/python3 docs/make_pictures.py"""

import shutil
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tools"))

import reed_tools  # noqa: E402

PICTURES = {"force.png": "press_known.png", "arm.png": "press_known_arm.png"}  # of the run folder, in docs


def make(target: Path) -> None:
    with tempfile.TemporaryDirectory() as scratch:
        run = reed_tools.run_scenario("press_known", seed=77, out=Path(scratch, "run"))
        for drawn, name in PICTURES.items():
            shutil.copyfile(run.folder / drawn, target / name)


if __name__ == "__main__":
    make(ROOT / "docs")
