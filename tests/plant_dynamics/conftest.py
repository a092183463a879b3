import json
import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def probe():
    """Calls tests/plant_dynamics/plant_probe.cc and returns the JSON it prints."""
    path = ROOT / os.environ.get("REED_BUILD_DIR", "build/release") / "bin" / "plant_probe"
    assert path.exists(), f"{path} is missing: build it, or set REED_BUILD_DIR"

    def call(*arguments):
        result = subprocess.run([path, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=True)
        return json.loads(result.stdout)

    return call


@pytest.fixture(scope="session")
def arm(probe):
    return probe("arm")

