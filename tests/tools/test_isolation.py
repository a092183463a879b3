"""What the caller's environment, folder and streams hold does not reach the tools, and a reader that leaves ends nothing."""

import ast
import json
import os
import subprocess
import time

import own_address
import pytest

from reed_tools import cli
from reed_tools.paths import PYTHON, ROOT, SCENARIOS

BUS = own_address.bus()
BOOTSTRAP = ROOT / "tools" / "reed"
FOREIGN = "import sys\nsys.exit('a module of the caller ran')\n"


@pytest.fixture
def hostile(tmp_path):
    """A folder to start in, and an environment, that break a Python that listens to them."""
    folder = tmp_path / "hostile"
    (folder / "modules").mkdir(parents=True)
    for name in ("lcm", "queue", "numpy", "rich", "reed_tools", "sitecustomize"):
        (folder / f"{name}.py").write_text(FOREIGN)
        (folder / "modules" / f"{name}.py").write_text(FOREIGN)
    (folder / "matplotlibrc").write_bytes(b"backend: nowhere\nfont.size: many\n\xff\n")
    return folder, {"PYTHONPATH": str(folder / "modules"), "PYTHONHOME": "/nowhere", "PYTHONSTARTUP": str(folder / "lcm.py"),
                    "PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0", "MPLBACKEND": "module://matplotlib_inline.backend_inline",
                    "MATPLOTLIBRC": str(folder / "matplotlibrc"), "MPLCONFIGDIR": "/proc/nowhere", "HOME": "/nowhere",
                    "LC_ALL": "de_DE.ISO-8859-1", "LANG": "de_DE.ISO-8859-1", "CDPATH": "/"}


def test_a_run_is_the_same_whatever_the_caller_tells_his_own_python(reed, hostile, tmp_path):
    folder, variables = hostile
    # The stand-in programs are Python themselves: they get their environment back.
    build = tmp_path / "build"
    (build / "bin").mkdir(parents=True)
    given = reed.environment({})
    for part in ("lcmtypes", "bin/reed_config"):
        (build / part).symlink_to(f"{given['REED_BUILD_DIR']}/{part}")
    for name in ("reed_firmware", "reed_plant_sim"):
        (build / "bin" / name).write_text("#!/bin/sh\nunset PYTHONHOME PYTHONPATH PYTHONSTARTUP\n"
                                          f"exec {given['REED_BUILD_DIR']}/bin/{name} \"$@\"\n")
        (build / "bin" / name).chmod(0o755)
    done = reed("run", "--bus", BUS, "--out", tmp_path / "run", cwd=folder, **variables, REED_BUILD_DIR=str(build))
    assert done.returncode == 1 and done.stderr == "", done.stderr  # 1: the stand-in's force error fails the checks
    assert json.loads((tmp_path / "run" / "summary.json").read_text())["cycles"] == 1100
    assert "–" in (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
    assert (tmp_path / "run" / "force.png").stat().st_size > 5000


def test_the_bootstrap_is_isolated_too(hostile):
    folder, variables = hostile
    done = subprocess.run([BOOTSTRAP, "frobnicate"], cwd=folder, env={**os.environ, **variables}, capture_output=True, text=True)
    told = [line for line in done.stderr.splitlines() if not line.startswith("bash: warning: setlocale")]  # no such locale here
    assert (done.returncode, done.stdout, len(told)) == (2, "", 1) and told[0].startswith("reed: unknown command"), done.stderr


@pytest.mark.parametrize("closed", ["<&-", ">&-", "2>&-", "<&- >&- 2>&-"])
def test_closed_streams_are_empty_ones(reed, tmp_path, closed):
    quoted = " ".join(f"'{word}'" for word in reed.command(["run", "--bus", BUS, "--out", tmp_path / "run"]))
    for command, status in ((quoted, 1), (f"{BOOTSTRAP} frobnicate", 2)):
        done = subprocess.run(["bash", "-c", f"{command} {closed}"], env=reed.environment({}), capture_output=True, text=True)
        assert done.returncode == status, done.stderr
    assert (tmp_path / "run" / "report.html").stat().st_size > 1000


def test_a_reader_that_leaves_ends_no_run(reed, tmp_path):
    process = reed.start("run", "--bus", BUS, "--out", tmp_path / "run")
    process.stdout.close()
    assert process.wait(60) == 1, process.stderr.read()  # of the checks
    assert process.stderr.read() == ""
    assert json.loads((tmp_path / "run" / "summary.json").read_text())["cycles"] == 1100


def test_a_slow_reader_of_a_non_blocking_pipe_gets_everything(tmp_path):
    reading, writing = os.pipe()
    os.set_blocking(writing, False)
    say = f"import sys; sys.path.insert(0, {str(ROOT / 'tools')!r})\nfrom reed_tools import streams\nstreams.install()\n" \
          "print('x' * 1_000_000, flush=True)\nsys.exit(streams.finish(0))"
    process = subprocess.Popen([*PYTHON, "-c", say], stdout=writing, stderr=subprocess.PIPE)
    os.close(writing)
    time.sleep(1.0)
    with open(reading, "rb") as pipe:
        assert pipe.read() == b"x" * 1_000_000 + b"\n"
    assert process.wait(20) == 0, process.stderr.read()


def test_a_full_disk_behind_standard_output_is_told_when_the_run_is_done(reed, tmp_path):
    for argv in (["doctor"], ["run", "--help"]):
        with open("/dev/full", "w") as full:
            done = subprocess.run(reed.command(argv), env=reed.environment({}), stdout=full, stderr=subprocess.PIPE, text=True)
        assert (done.returncode, done.stderr) == (3, "reed: standard output: no space left on device\n")


def test_a_path_that_is_no_utf8_is_a_path(reed, tmp_path):
    odd = os.fsdecode(os.fsencode(tmp_path) + b"/r\xfcn")
    done = subprocess.run([os.fsencode(word) for word in reed.command(["run", "--bus", BUS, "--out", odd])],
                          env=reed.environment({}), capture_output=True)
    assert done.returncode == 1 and b"r\xfcn/report.html" in done.stdout, done.stderr
    scenario = os.fsencode(tmp_path) + b"/pr\xfcfung.toml"  # its name stands in the report, as what repeats the run
    with open(scenario, "wb") as file:
        file.write((SCENARIOS / "press_known.toml").read_bytes())
    done = subprocess.run([os.fsencode(word) for word in reed.command(["run", os.fsdecode(scenario), "--bus", BUS, "--out", tmp_path / "2"])],
                          env=reed.environment({}), capture_output=True)
    assert done.returncode == 1 and (tmp_path / "2" / "report.html").exists(), done.stderr
    done = subprocess.run([os.fsencode(word) for word in reed.command(["run", "--bus", BUS, os.fsdecode(b"/r\xfcn.toml")])],
                          env=reed.environment({}), capture_output=True)
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1 and b"Traceback" not in done.stderr


def test_a_mistake_of_ours_is_one_line_and_status_3(monkeypatch, capsys):
    def wrong(argv):
        raise ValueError("seven\nis no colour")

    monkeypatch.setattr(cli, "dispatch", wrong)
    assert cli.main(["run"]) == 3
    told = capsys.readouterr().err
    assert told.startswith("reed: internal error, ValueError at test_isolation.py:") and told.endswith(": seven is no colour\n")


def test_one_module_starts_matplotlib():
    """It must start in our own folder, with our own settings."""
    for file in (ROOT / "tools" / "reed_tools").rglob("*.py"):
        if file.name != "drawing.py":
            for node in ast.walk(ast.parse(file.read_text())):
                names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else \
                    [node.module or ""] if isinstance(node, ast.ImportFrom) else []
                assert not any(name.split(".")[0] == "matplotlib" for name in names), file


def test_every_python_of_ours_is_started_isolated():
    """By paths.PYTHON. The tests' own runner and builds get an environment without PYTHON variables; a law is its owner's."""
    allowed = {"paths.py", "__main__.py", "stages.py", "choice.py", "versions_built.py"}
    found = {file.name for file in (ROOT / "tools" / "reed_tools").rglob("*.py") if "sys.executable" in file.read_text()}
    assert found == allowed
