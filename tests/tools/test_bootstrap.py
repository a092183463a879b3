"""tools/reed itself, in a checkout of its own with stand-ins for cmake and ninja."""

import os
import re
import shutil
import subprocess
import sys

import pytest

from reed_tools.cli import COMMANDS
from reed_tools.paths import ROOT

STAND_IN = """#!/bin/sh
echo "${0##*/} $*" >>"$CALLS"
case "${0##*/} $*" in *" -n "*) exit 0;; cmake*) mkdir -p "$MADE"; : >"$MADE/build.ninja";; esac
"""


class Checkout:
    def __init__(self, folder):
        self.folder, self.calls = folder, folder / "calls"
        (folder / "tools").mkdir(parents=True)
        shutil.copy(ROOT / "tools" / "reed", folder / "tools" / "reed")
        (folder / "tools" / "reed_tools").symlink_to(ROOT / "tools" / "reed_tools")
        stamps = folder / "build" / ".stamps"
        stamps.mkdir(parents=True)
        (folder / "build" / "venv").symlink_to(sys.prefix)
        text = (ROOT / "tools" / "apt-packages.txt").read_text()
        (folder / "tools" / "apt-packages.txt").write_text(text)
        for group in ("build", "vm"):
            listed = [line.split()[1] for line in text.splitlines() if line.split()[0] == group]
            (stamps / f"apt-{group}").write_text("\n".join(listed))
        requirements = (ROOT / "tools" / "requirements-run.txt").read_text()
        (folder / "tools" / "requirements-run.txt").write_text(requirements)
        (stamps / "python-run").write_text(requirements.rstrip("\n"))
        (folder / "bin").mkdir()
        for name in ("cmake", "ninja"):
            (folder / "bin" / name).write_text(STAND_IN)
            (folder / "bin" / name).chmod(0o755)

    def cache(self, name, home, place):
        (self.folder / "build" / name / "CMakeFiles").mkdir(parents=True)
        (self.folder / "build" / name / "build.ninja").write_text("")
        (self.folder / "build" / name / "CMakeCache.txt").write_text(
            f"CMAKE_CACHEFILE_DIR:INTERNAL={place}\nCMAKE_HOME_DIRECTORY:INTERNAL={home}\n")

    def reed(self, *argv, prefix=(), **variables):
        environment = {**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}", "CALLS": str(self.calls),
                       "MADE": str(self.folder / "build" / "release"), **variables}
        environment.pop("REED_BUILD_DIR", None)
        environment |= {name: value for name, value in variables.items() if name == "REED_BUILD_DIR"}
        return subprocess.run([*prefix, self.folder / "tools" / "reed", *argv], env=environment, capture_output=True, text=True)

    def called(self):
        return self.calls.read_text() if self.calls.exists() else ""


@pytest.fixture
def checkout(tmp_path):
    return Checkout(tmp_path / "check out")  # a blank in its path


def test_every_command_waits_for_its_turn_and_gets_what_it_needs():
    """tools/reed has two lists of commands: those that lock and look at the build, and what each of them needs."""
    text = (ROOT / "tools" / "reed").read_text()
    locked, needs = (part.partition("\nesac")[0] for part in text.split('case "$command" in')[1:])
    for command in COMMANDS:
        assert re.search(rf"^  (.* \| )?{command} \|", locked, re.MULTILINE), command
        assert re.search(rf"^  (.* \| )?{command}( \|.*)?\)", needs, re.MULTILINE), command


def ended_in_the_tools(done):
    return done.returncode == 2 and "is not a run folder" in done.stderr


def test_a_build_at_its_place_is_used_as_it_is(checkout):
    checkout.cache("release", checkout.folder, checkout.folder / "build" / "release")
    done = checkout.reed("report", "/nowhere")
    assert ended_in_the_tools(done) and "anew" not in done.stderr, done.stderr
    assert "cmake" not in checkout.called()


@pytest.mark.parametrize("there", [True, False])
def test_a_checkout_that_was_copied_or_moved_is_configured_anew(checkout, tmp_path, there):
    """There: it was copied, and the other one still has its scenarios; else it was moved."""
    other = tmp_path / "other"
    if there:
        (other / "build" / "release").mkdir(parents=True)
    checkout.cache("release", other, other / "build" / "release")
    checkout.cache("asan", other, other / "build" / "asan")
    done = checkout.reed("report", "/nowhere")
    assert ended_in_the_tools(done), done.stderr
    assert f"build/release was made at {other}/build/release: configured and built anew" in done.stderr
    assert f"cmake --preset release -S {checkout.folder} -B {checkout.folder}/build/release" in checkout.called()
    assert not (checkout.folder / "build" / "asan" / "CMakeCache.txt").exists()


def test_a_build_of_other_sources_is_refused_and_stays(checkout, tmp_path):
    build = tmp_path / "elsewhere"
    build.mkdir()
    (build / "CMakeCache.txt").write_text(f"CMAKE_CACHEFILE_DIR:INTERNAL={build}\nCMAKE_HOME_DIRECTORY:INTERNAL=/other/sources\n")
    done = checkout.reed("report", "/nowhere", REED_BUILD_DIR=str(build))
    assert done.returncode == 3 and done.stderr.count("\n") == 1
    assert f"REED_BUILD_DIR={build} was configured for the sources in /other/sources" in done.stderr
    assert (build / "CMakeCache.txt").exists() and checkout.called() == ""


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can become another user")
@pytest.mark.parametrize("whose", ["all of it", "the lock"])
def test_another_users_checkout_is_named_with_its_owner(checkout, tmp_path, whose):
    tmp_path.chmod(0o755)
    for parent in tmp_path.parents:
        if str(parent) != "/tmp" and str(parent).startswith("/tmp"):
            parent.chmod(0o755)
    (checkout.folder / "build" / ".bootstrap.lock").write_text("")
    if whose == "the lock":
        for folder in (checkout.folder, checkout.folder / "build", checkout.folder / "build" / ".stamps"):
            os.chown(folder, 65534, 65534)
    as_nobody = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"]
    done = checkout.reed("report", "/nowhere", prefix=as_nobody)
    path = checkout.folder if whose == "all of it" else checkout.folder / "build" / ".bootstrap.lock"
    assert done.returncode == 3, done.stderr
    assert done.stderr == (f"reed: {path} belongs to root and nobody cannot write it: clone this checkout for yourself, "
                           f"or as root: chown -R nobody {checkout.folder}\n")
    assert checkout.reed("--help", prefix=as_nobody).returncode == 0
