"""Which Reed this is, and what a mistyped word may have meant."""

import re
import subprocess

import pytest

from reed_tools import cli, versions
from reed_tools.cli import COMMANDS
from reed_tools.paths import ROOT, program
from reed_tools.record import run_folder
from reed_tools.run import origin
from reed_tools.text import did_you_mean


@pytest.mark.parametrize("argv", [["--version"], *([command, "--version"] for command in COMMANDS)])
def test_every_command_says_its_version_and_commit(reed, argv):
    done = reed(*argv)
    assert (done.returncode, done.stdout, done.stderr) == (0, cli.version() + "\n", "")
    assert re.fullmatch(r"reed \d+\.\d+\.\d+, commit ([0-9a-f]{40}([+]changes)?|unknown: .*)\n", done.stdout)


def test_the_bootstrap_builds_nothing_for_it():
    done = subprocess.run([ROOT / "tools" / "reed", "run", "--version"], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, cli.version() + "\n", "")


def test_a_checkout_without_git_says_so(monkeypatch):
    monkeypatch.setattr(versions, "git", lambda *arguments: "")
    assert "commit unknown: " in cli.version()


def test_the_file_of_a_law_from_outside_is_one_of_the_versions(tmp_path, monkeypatch):
    class Arguments:
        scenario, arm, law, duration, rate, seed, bus, clock, set = "press_known", None, f"{tmp_path}/law.so:gain=2", None, None, None, "memory", "lockstep", []

    monkeypatch.setattr(versions, "build", lambda programs: " ".join(programs))
    found = []
    for content in ("one", "two", "one"):
        (tmp_path / "law.so").write_text(content)
        origin.write(tmp_path, Arguments)
        found.append(run_folder.origin(tmp_path)["versions"])
    assert found[0] == found[2] and found[0]["law"] != found[1]["law"] and len(found[0]["law"]) == 12
    assert found[0]["build"] == "reed_one_process"  # the program that ran
    assert versions.all_of_them()["law"] is None


@pytest.mark.parametrize("argv, told", [(["rnu"], "did you mean `run`?"), (["inspekt"], "did you mean `inspect`?"),
                                        (["run", "--durtion", "3"], "did you mean `--duration`?"),
                                        (["run", "--sed=3"], "did you mean `--seed`?"),
                                        (["campaign", "press_knwon"], "did you mean `press_known`?"),
                                        (["bench", "stpes"], "did you mean `steps`?")])
def test_what_was_mistyped_is_named(reed, argv, told):
    done = reed(*argv)
    assert done.returncode == 2 and told in done.stderr and len(done.stderr.splitlines()) == 1, done.stderr


def test_what_is_near_to_nothing_gets_no_hint():
    assert did_you_mean("xyzzy", COMMANDS) == "" and did_you_mean("run", COMMANDS) == ""


@pytest.mark.parametrize("name", ["reed_config", "reed_firmware", "reed_inspect", "reed_plant_sim"])
def test_every_program_says_its_version(name):
    done = subprocess.run([program(name), "--version"], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, f"reed {versions.reed()} (tools/reed --version names the commit)\n", "")
