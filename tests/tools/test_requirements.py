"""What is installed is what was locked: every package of every set, with all that it pulls in, by the hashes of its files."""

import re
from importlib.metadata import PackageNotFoundError, requires

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from reed_tools.paths import ROOT

FILES = sorted((ROOT / "tools").glob("requirements-*.txt"))
HASH = re.compile(r"^--hash=sha256:[0-9a-f]{64}$")


def locked(file):
    """{name: (version, extras, hashes)} of a file and of those that it includes."""
    found = {}
    for line in file.read_text().replace("\\\n", " ").splitlines():
        words = line.split()
        if not words or words[0].startswith("#"):
            continue
        if words[0] == "-r":
            found |= locked(file.with_name(words[1]))
            continue
        entry = Requirement(words[0])
        (version,) = entry.specifier
        assert version.operator == "==", line
        found[canonicalize_name(entry.name)] = (version.version, entry.extras, words[1:])
    return found


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_every_package_has_one_version_and_the_hashes_of_its_files(file):
    for name, (_, _, hashes) in locked(file).items():
        assert hashes and all(map(HASH.match, hashes)), name


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_what_a_package_pulls_in_is_locked_too(file):
    """With --require-hashes pip refuses the whole set otherwise."""
    packages = locked(file)
    looked_at = 0
    for name, (_, extras, _) in packages.items():
        try:
            needed = map(Requirement, requires(name) or [])
        except PackageNotFoundError:  # of a set that is not installed here
            continue
        looked_at += 1
        for entry in needed:
            if any(entry.marker is None or entry.marker.evaluate({"extra": extra}) for extra in ("", *extras)):
                version = packages.get(canonicalize_name(entry.name), ("nothing",))[0]
                assert version != "nothing" and entry.specifier.contains(version), f"{name} needs {entry}, locked is {version}"
    assert looked_at or "run" not in file.name


def test_the_bootstrap_installs_by_hashes_and_from_wheels_alone():
    assert "--require-hashes --only-binary :all:" in (ROOT / "tools" / "reed").read_text()
