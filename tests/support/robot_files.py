"""URDFs of real robots, out of a wheel of the package index: none is committed. The wheel is kept in build/wheels."""

import functools
import subprocess
import sys
import zipfile
from pathlib import Path

from reed_tools.paths import ROOT

WHEELS = ROOT / "build" / "wheels"
WHEEL = "example_robot_data-6.0.0-0-py3-none-any.whl"
REQUIREMENT = "example-robot-data==6.0.0 --hash=sha256:424092a8093411ac2cd4ccc0572382bfc6b5eb4833aa984ef5e671dd67cd0a6e\n"
INSIDE = "cmeel.prefix/share/example-robot-data/robots"


@functools.cache
def wheel() -> Path:
    path = WHEELS / WHEEL
    if not path.is_file():
        WHEELS.mkdir(parents=True, exist_ok=True)
        wanted = WHEELS / "requirements.txt"
        wanted.write_text(REQUIREMENT)
        done = subprocess.run([sys.executable, "-m", "pip", "download", "-q", "--no-deps", "--require-hashes", "-r", str(wanted), "-d", str(WHEELS)],
                              capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
    return path


def urdf(name: str) -> str:
    """The text of one of its files."""
    with zipfile.ZipFile(wheel()) as archive:
        return archive.read(f"{INSIDE}/{name}").decode()
