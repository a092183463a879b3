"""Folders for results: one process each."""

import errno
import os
import subprocess
import sys

import own_address
import pytest

from reed_tools import folders
from reed_tools.errors import UsageError
from reed_tools.paths import ROOT

MAKE = f"""
import sys, time
sys.path.insert(0, {str(ROOT / 'tools')!r})
from reed_tools import folders
folders.ROOT = folders.Path(sys.argv[1])
folders.time.strftime = lambda form: "20260101-000000"
print(folders.fresh(None, "press", ("a", "b"), "a run already"), flush=True)
sys.stdin.read()
"""


def test_processes_that_start_in_one_second_get_a_folder_each(tmp_path):
    started = [subprocess.Popen([sys.executable, "-c", MAKE, tmp_path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
               for _ in range(6)]
    made = [process.stdout.readline().strip() for process in started]
    for process in started:
        process.communicate()
    assert sorted(made) == sorted(str(tmp_path / "out" / f"20260101-000000-press{suffix}") for suffix in ("", "-2", "-3", "-4", "-5", "-6"))


def test_a_folder_is_in_use_until_its_process_has_ended_however_it_ends(tmp_path):
    first = subprocess.Popen([sys.executable, "-c", MAKE, tmp_path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    folder = folders.Path(first.stdout.readline().strip())
    with pytest.raises(UsageError, match=f"{folder}: another command is writing there"):
        folders.fresh(folder, "", ("a", "b"), "a run already")
    first.kill()
    first.communicate()
    assert folders.fresh(folder, "", ("a", "b"), "a run already") == folder


def test_a_file_system_without_locks_is_used_without_them(tmp_path, monkeypatch):
    def refuse(*_):
        raise OSError(errno.EOPNOTSUPP, "Operation not supported")

    monkeypatch.setattr(folders.fcntl, "flock", refuse)
    assert folders.fresh(tmp_path, "", ("a",), "a run already") == tmp_path


@pytest.mark.parametrize("there, told", [("a", "holds a run already"), ("b", "its b would be replaced")])
def test_a_folder_with_results_is_refused_and_stays_as_it_is(tmp_path, there, told):
    (tmp_path / there).write_text("mine")
    with pytest.raises(UsageError, match=f"--out {tmp_path}: .*{told}"):
        folders.fresh(tmp_path, "", ("a", "b"), "a run already")
    assert (tmp_path / there).read_text() == "mine"


def test_other_files_do_not_matter_and_a_link_to_nowhere_does(tmp_path):
    (tmp_path / "notes.txt").write_text("mine")
    assert folders.fresh(tmp_path, "", ("a", "b"), "a run already") == tmp_path
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "b").symlink_to("/nowhere")
    with pytest.raises(UsageError, match="its b would be replaced"):
        folders.fresh(tmp_path / "run", "", ("a", "b"), "a run already")


@pytest.mark.parametrize("title", ["../../escape", "a b;c", "n" * 300, "\x1b[31m\n"])
def test_a_title_stays_one_name_inside_out(monkeypatch, tmp_path, title):
    monkeypatch.setattr(folders, "ROOT", tmp_path)
    made = folders.make_named(title)
    assert made.parent == tmp_path / "out" and made.is_dir() and made.name.isprintable() and " " not in made.name


def test_what_the_disk_refuses_is_a_line(tmp_path):
    (tmp_path / "file").write_text("")
    for wanted in (tmp_path / "file", tmp_path / "file" / "run", folders.Path("/proc/nowhere")):
        with pytest.raises(UsageError, match=f"--out {wanted}: "):
            folders.fresh(wanted, "", ("a",), "a run already")


def test_a_second_run_into_the_same_folder_is_refused(reed, tmp_path):
    bus = own_address.bus()
    assert reed("run", "--bus", bus, "--out", tmp_path).returncode == 1  # of the stand-in's checks
    before = (tmp_path / "summary.json").read_text()
    again = reed("run", "--bus", bus, "--out", tmp_path)
    assert (again.returncode, again.stderr) == (2, f"reed: --out {tmp_path}: holds a run already; remove it or choose another folder\n")
    assert (tmp_path / "summary.json").read_text() == before


@pytest.mark.parametrize("argv", [["run", "--out", ""], ["campaign", "--out", ""], ["campaign", "--resume", ""], ["bench", "--out", ""],
                                  ["paper", "--out", ""], ["report", ""], ["export", ""],
                                  ["export", "run", "--out", ""], ["live", ""], ["compare", "", ""]])
def test_an_empty_folder_name_is_refused(reed, argv, tmp_path):
    done = reed(*argv, cwd=tmp_path)
    assert done.returncode == 2 and "is empty; allowed: a path" in done.stderr
    assert os.listdir(tmp_path) == []


def test_a_run_from_a_folder_that_is_gone_ends_as_any_other(reed, tmp_path):
    start = "mkdir gone && cd gone && rmdir ../gone && exec \"$@\""
    done = subprocess.run(["bash", "-c", start, "bash", *reed.command(["run", "--bus", own_address.bus(), "--out", tmp_path / "run"])],
                          cwd=tmp_path, env=reed.environment({}), capture_output=True, text=True)
    assert done.returncode == 1 and "internal error" not in done.stderr, done.stderr
    assert (tmp_path / "run" / "report.html").exists() and str(tmp_path / "run" / "report.html") in done.stdout
