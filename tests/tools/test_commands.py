"""What every command has: a quick start, an example in its help, --json where it prints figures, plain lines in a pipe."""

import fcntl
import json
import re
import shlex
import subprocess

import own_address
import pytest
from built import reed as tools  # with the programs that are built; the fixture has stand-ins

from reed_tools.cli import COMMANDS
from reed_tools.paths import PYTHON, ROOT

BUS = own_address.bus()
LIGHT = {"numpy", "rich"}  # packages that a start may import; the others take longer than everything else together
START = """
import sys
sys.path.insert(0, {tools!r})
standing = set(sys.modules)
from reed_tools import cli
cli.{what}({name!r})
loaded = {{module.partition(".")[0] for module in set(sys.modules) - standing}} - set(sys.stdlib_module_names) - {{"reed_tools"}}
print(*sorted(module for module in loaded if not module.startswith("_")))
"""


@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_starts_without_packages_that_start_slowly(name):
    """The modules and not the seconds: those are the machine's."""
    script = START.format(tools=str(ROOT / "tools"), what="module_of" if name == "inspect" else "parser_of", name=name)
    loaded = subprocess.run([*PYTHON, "-c", script], capture_output=True, text=True, check=True).stdout.split()
    assert set(loaded) <= LIGHT


@pytest.mark.parametrize("name", COMMANDS)
def test_help_has_examples_of_this_command(name):
    done = tools(name, "--help")
    assert done.returncode == 0 and done.stderr == ""
    examples = done.stdout.partition("example")[2]
    assert f"tools/reed {name}" in examples and re.search(r"^ .*tools/reed", examples, re.M) or f"example: tools/reed {name}" in done.stdout


def test_the_bootstrap_shows_help_while_another_command_builds():
    """Nothing that only prints waits for the lock."""
    with open(ROOT / "build" / ".bootstrap.lock", "a") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        for words in (["report", "--help"], ["completion", "bash"]):
            done = subprocess.run([ROOT / "tools" / "reed", *words], capture_output=True, text=True, timeout=120)
            assert done.returncode == 0 and "report" in done.stdout, done.stderr


def test_json_of_a_run_and_of_its_report_is_all_that_is_printed(reed, tmp_path):
    done = reed("run", "--bus", BUS, "--json", "--out", tmp_path / "run")
    assert done.returncode == 1, done.stderr  # the stand-in's force error fails the checks
    found = json.loads(done.stdout)
    assert found == {"folder": str(tmp_path / "run"), **json.loads((tmp_path / "run" / "summary.json").read_text())}
    assert "error by second" in done.stderr
    again = reed("report", tmp_path / "run", "--json")
    assert again.returncode == 1 and json.loads(again.stdout) == found


def test_json_of_doctor_and_of_the_version(reed):
    found = json.loads(reed("doctor", "--json").stdout)
    assert {"system", "findings", "buses"} == set(found) and len(found["findings"]) > 10
    assert all(set(item) == {"subject", "good", "detail", "fix"} for item in found["findings"])
    said = json.loads(reed("--version", "--json").stdout)
    assert set(said) == {"reed", "commit", "build"} and said == json.loads(reed("run", "--version", "--json").stdout)


def test_a_table_is_plain_lines_in_a_pipe(reed, tmp_path):
    lines = reed("run", "--bus", BUS, "--out", tmp_path / "run").stdout.splitlines()
    assert ["force_rms_percent_last_second", "2.5", "3", "ok"] in [line.split() for line in lines]
    assert any(line.startswith("time per cycle, µs") for line in lines)
    assert not any(set(line) & set("─━│┃╺") for line in lines)


def complete(*words):
    """What bash offers behind these words, the last of them unfinished."""
    script = f"""source {shlex.quote(str(complete.script))}
COMP_WORDS=(tools/reed {' '.join(map(shlex.quote, words))}); COMP_CWORD={len(words)}; _reed; printf '%s\\n' "${{COMPREPLY[@]}}" """
    return set(subprocess.run(["bash", "--norc", "-c", script], capture_output=True, text=True, check=True, cwd=ROOT).stdout.split())


@pytest.fixture(scope="module")
def bash(tmp_path_factory):
    complete.script = tmp_path_factory.mktemp("completion") / "reed.bash"
    complete.script.write_text(tools("completion", "bash").stdout)
    return complete


def test_bash_completes_commands_options_and_values(bash):
    assert bash("") == set(COMMANDS) and bash("re") == {name for name in COMMANDS if name.startswith("re")}
    assert {"--seed", "--set"} == bash("run", "--se")
    assert "press_known" in bash("run", "press_")
    assert "a5" in bash("run", "--arm", "a") and bash("run", "--clock", "l") == {"lockstep"}
    assert bash("run", "--clock", "=", "l") == {"lockstep"}
    assert bash("export", "--to", "") == {"mcap", "csv", "parquet", "asc", "blf", "mf4"}
    assert "press_known" in bash("campaign", "") and bash("run", "--seed", "") == set()
    assert {"--arm", "--states", "--plot", "--modes"} <= bash("inspect", "--")
    assert bash("completion", "") == {"bash", "zsh"}


ZSH = """
compdef() { print -r -- "compdef $*" }
_describe() { print -rl -- "${(@P)2}" }
_arguments() { print -rl -- "$@" }
_alternative() { print -rl -- "$@" }
source %s
words=(tools/reed %s); CURRENT=%d; _reed
"""


def zsh(script, *words):
    done = subprocess.run(["zsh", "-f", "-c", ZSH % (shlex.quote(str(script)), " ".join(map(shlex.quote, words)), len(words) + 1)], capture_output=True, text=True)
    assert done.returncode == 0 and done.stderr == "", done.stderr
    return done.stdout.splitlines()


def test_zsh_gets_commands_options_with_their_help_and_values(tmp_path):
    script = tmp_path / "_reed"
    script.write_text(tools("completion", "zsh").stdout)
    first = zsh(script, "")
    assert first[0] == "compdef _reed reed" and {line.partition(":")[0] for line in first[1:]} == set(COMMANDS)
    run = zsh(script, "run", "")[1:]
    assert any(line.startswith("*--set=[override") for line in run)
    assert any(line.startswith("--clock=[") and line.endswith(":(realtime wall lockstep)") for line in run)
    assert run[-1].startswith("*:run:_reed_names ") and "config/scenarios" in run[-1]
