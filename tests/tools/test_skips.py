"""In CI a test that did not run fails, whichever runner left it out."""

import subprocess
import sys

import pytest

from reed_tools.testing import skips
from reed_tools.testing.command import execute
from reed_tools.testing.stages import PYTEST_CLOSING, Stage

GTEST = """<?xml version="1.0"?><testsuites><testsuite name="Bus">
<testcase name="Opens" status="run" result="completed" classname="Bus" />
<testcase name="Hears" status="run" result="skipped" classname="Bus"><skipped message="bus_test.cc:7&#x0A;no bus here"/></testcase>
<testcase name="Rests" status="notrun" result="suppressed" classname="Bus" />
</testsuite></testsuites>"""
CTEST = """add_test(Bus.Opens true)
add_test(Bus.Hears sh -c "exit 77")
set_tests_properties(Bus.Hears PROPERTIES SKIP_RETURN_CODE 77)
add_test(Bus.Rests true)
set_tests_properties(Bus.Rests PROPERTIES DISABLED ON)
"""
PYTEST = """
import pytest
def test_opens(): pass
def test_hears(): pytest.skip("no bus here")
@pytest.mark.skipif(True, reason="never")
def test_rests(): pass
"""


def of_gtest(folder):
    (folder / "results.xml").write_text(GTEST)


def of_ctest(folder):
    (folder / "CTestTestfile.cmake").write_text(CTEST)
    subprocess.run(["ctest", "--test-dir", folder, "--output-junit", folder / "results.xml"], capture_output=True, check=True)


def of_pytest(folder):
    (folder / "test_bus.py").write_text(PYTEST)
    subprocess.run(pytest_command(folder), capture_output=True, check=True)


def pytest_command(folder):
    return [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--rootdir", str(folder), str(folder / "test_bus.py"),
            f"--junit-xml={folder / 'results.xml'}"]


@pytest.mark.parametrize(("runner", "names"), [(of_gtest, ["Bus.Hears", "Bus.Rests"]), (of_ctest, ["Bus.Hears", "Bus.Rests"]),
                                               (of_pytest, ["test_bus.test_hears", "test_bus.test_rests"])])
def test_every_runner_s_skips_are_seen(tmp_path, runner, names):
    runner(tmp_path)
    assert sorted(skips.skipped(tmp_path / "results.xml")) == names
    lines = skips.complaints([tmp_path / "results.xml"])
    assert [line.split(":")[0] for line in lines] == [f"SKIPPED {name}" for name in names]
    assert all("\n" not in line for line in lines)


def test_a_skip_that_is_on_the_list_is_no_complaint(tmp_path, monkeypatch):
    of_gtest(tmp_path)
    monkeypatch.setattr(skips, "ALLOWED", {"Bus.Hears": "no bus in a container", "Bus.R*": "rests"})
    assert skips.complaints([tmp_path / "results.xml"]) == []


def test_a_module_that_is_left_out_whole_is_seen(tmp_path):
    (tmp_path / "test_bus.py").write_text('import pytest\npytest.skip("nothing is installed", allow_module_level=True)\n')
    subprocess.run(pytest_command(tmp_path), capture_output=True)
    (line,) = skips.complaints([tmp_path / "results.xml"])
    assert line.startswith("SKIPPED test_bus") and "nothing is installed" in line


@pytest.mark.parametrize(("no_skips", "ok"), [(False, True), (True, False)])
def test_a_stage_fails_by_a_skip_in_ci_only(tmp_path, no_skips, ok):
    (tmp_path / "test_bus.py").write_text(PYTEST)
    stage = Stage("tests", pytest_command(tmp_path), PYTEST_CLOSING, results=[tmp_path / "results.xml"])
    execute(stage, no_skips)
    assert stage.ok == ok and any("SKIPPED test_bus.test_hears" in line and "no bus here" in line for line in stage.closing_lines) == no_skips


def test_results_of_an_earlier_run_do_not_count(tmp_path):
    of_gtest(tmp_path)
    stage = Stage("tests", ["true"], PYTEST_CLOSING, results=[tmp_path / "results.xml"])
    execute(stage, no_skips=True)
    assert not stage.ok and "its runner wrote no results" in stage.closing_lines[0]


def test_every_name_on_the_list_is_a_test_that_there_is():
    """A test that was renamed must not leave a hole for the next of its name."""
    from reed_tools.paths import ROOT

    sources = "\n".join(path.read_text() for path in (ROOT / "tests").rglob("*_test.cc"))
    for pattern in skips.ALLOWED:
        group, _, name = pattern.rpartition(".")
        if group.startswith(("tools.", "runs.")):
            file = ROOT / "tests" / f"{group.replace('.', '/')}.py"
            assert file.exists() and (name == "*" or f"def {name}(" in file.read_text()), pattern
        else:
            assert f"({group}, " in sources and (name == "*" or name.strip("*") in sources), pattern
