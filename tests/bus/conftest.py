import os
import pathlib
import subprocess

import cantools
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def build_dir():
    return ROOT / os.environ.get("REED_BUILD_DIR", "build/release")


@pytest.fixture(scope="session")
def dbc():
    return ROOT / "bus" / "reed.dbc"


@pytest.fixture(scope="session")
def database(dbc):
    return cantools.database.load_file(dbc)


@pytest.fixture(scope="session")
def peer(build_dir):
    """Path of the C++ side of the comparisons (tests/bus/bus_peer.cc)."""
    path = build_dir / "bin" / "bus_peer"
    assert path.exists(), f"{path} is missing: build it, or set REED_BUILD_DIR"
    return str(path)


class Codec:
    """The C++ encoder and decoder, one line of text per message."""

    def __init__(self, peer):
        self.process = subprocess.Popen([peer, "codec"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()
        return self.process.stdout.readline().strip()

    def encode(self, kind, *numbers):
        identifier, data = self.ask("encode " + " ".join([kind, *map(repr, numbers)])).split("#")
        return int(identifier, 16), bytes.fromhex(data)

    def decode(self, identifier, data):
        kind, *numbers = self.ask(f"decode {identifier:03X} {data.hex()}").split()
        return kind, [float(n) for n in numbers]


@pytest.fixture
def codec(peer):
    codec = Codec(peer)
    yield codec
    codec.process.stdin.close()
    assert codec.process.wait(10) == 0
