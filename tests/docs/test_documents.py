"""The documents against what they speak of: links, files, commands, options, keys, channels and dependencies exist."""

import ast
import functools
import re
import shlex
import subprocess
import sys

import pytest

from reed_tools import cli
from reed_tools.campaign import definition
from reed_tools.paths import ROOT, SCENARIOS, program
from reed_tools.record.message_layout import fields
from reed_tools.record.telemetry_log import TABLES


def tracked(*patterns):
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", *patterns], cwd=ROOT, capture_output=True, text=True, check=True)
    return [name for name in listed.stdout.split() if (ROOT / name).exists()]


FILES = tracked()
DOCUMENTS = [name for name in FILES if name.endswith(".md")]
SOURCE = "h|cc|c|py|md|toml|lcm|dbc|txt|pml"
MADE = {"controller.toml", "plant.toml", "effective.toml", "run.json", "one_process.txt"}  # written by a run
INSTALLED = {"reed/law.h"}  # as users include firmware/law_interface/law.h
PYTHON_NAMES = {"can": "python-can", "pinocchio": "Pinocchio", "Pynite": "PyNite", "mujoco": "MuJoCo", "scipy": "SciPy",
                "mcap_protobuf": "mcap-protobuf-support", "google": "protobuf", "PIL": "pillow", "foxglove_schemas_protobuf": "foxglove-schemas-protobuf"}
PACKAGE_NAMES = {  # Debian package: how README.md calls it
    "cmake": "CMake", "ninja-build": "Ninja", "g++": "g++", "pkg-config": "pkg-config", "python3": "Python", "python3-venv": "Python",
    "libeigen3-dev": "Eigen", "liblcm-dev": "LCM", "liblcm-bin": "LCM", "libcli11-dev": "CLI11", "libtomlplusplus-dev": "toml++",
    "nlohmann-json3-dev": "nlohmann-json", "libgtest-dev": "GoogleTest", "libgmock-dev": "GoogleTest", "iproute2": "iproute2",
    "user-mode-linux": "User Mode Linux", "busybox-static": "busybox", "can-utils": "can-utils", "default-jre": "Java",
    "default-jdk-headless": "Java", "liblcm-java": "lcm-spy", "libjchart2d-java": "jchart2d", "clang-format-14": "clang-format",
    "clang-14": "clang", "libclang-rt-14-dev": "clang", "g++-aarch64-linux-gnu": "aarch64", "qemu-user": "qemu", "clang-tidy-14": "clang-tidy", "valgrind": "valgrind", "spin": "spin", "gcc-arm-none-eabi": "arm-none-eabi",
    "libstdc++-arm-none-eabi-newlib": "arm-none-eabi", "qemu-system-arm": "qemu", "rt-tests": "cyclictest", "xvfb": "xvfb", "chromium": "chromium", "zsh": "zsh"}


def text_of(name):
    return (ROOT / name).read_text()


def commands(start):
    """Every command in the documents that begins with `start`: in a line of code of its own or between backticks."""
    for document in DOCUMENTS:
        text = text_of(document).replace("\\\n", " ")
        for code in [*re.findall(r"^    (.*)", text, re.M), *re.findall(r"`([^`\n]+)`", text)]:
            if code.startswith(start):
                yield document, shlex.split(code.replace("\\|", "|"), comments=True)


@functools.cache
def written():
    """Files that a command of the documents writes before others read them."""
    listed = [words for _, words in commands("tools/reed ")]
    return {name for words in listed for k, word in enumerate(words) if word in ("--out", "--write") for name in words[k + 1:k + 2]}


@pytest.mark.parametrize("document", DOCUMENTS)
def test_every_link_leads_to_a_file(document):
    for target in re.findall(r"\]\(([^)#]+)[^)]*\)", text_of(document)):
        assert re.match(r"https?:", target) or (ROOT / document).parent.joinpath(target).exists(), target


@pytest.mark.parametrize("document", DOCUMENTS)
def test_every_file_that_is_named_exists(document):
    for name in re.findall(rf"(?<![\w./*<>-])(\w[\w./-]*\.(?:{SOURCE}))(?![\w/])", text_of(document)):
        assert name in MADE | INSTALLED | written() or any(f"/{file}".endswith(f"/{name}") for file in FILES), name


def test_every_document_is_linked_from_the_readme():
    linked = set(re.findall(r"\]\(([^)]+)\)", text_of("README.md")))
    assert linked >= {name for name in DOCUMENTS if name != "README.md"}


@functools.cache
def options_of(name):
    return set(re.findall(r"--[\w-]+", subprocess.run([program(name), "--help"], capture_output=True, text=True, timeout=30).stdout))


def test_every_command_of_the_tools_is_one_they_take():
    seen = set()
    for document, (_, *words) in commands("tools/reed "):
        assert words[0] in cli.COMMANDS, (document, words)
        seen.add(words[0])
        if words[0] == "inspect":
            options = {word.partition("=")[0] for word in words[1:] if word.startswith("--")}
            assert options <= options_of("reed_inspect") | {"--plot"}, (document, words)
            continue
        arguments = cli.parser_of(words[0]).parse_args([word for word in words[1:] if word != "…"])
        if getattr(arguments, "scenario", None) and arguments.scenario not in written():
            assert (SCENARIOS / f"{arguments.scenario}.toml").exists(), (document, words)
    assert seen == set(cli.COMMANDS), "a command that no document shows"


def test_every_command_of_the_programs_is_one_they_take():
    seen = set()
    for document, (path, *words) in commands("build/release/bin/"):
        options = {word for word in words if word.startswith("--")}
        assert options <= options_of(path.rpartition("/")[2]), (document, path, words)
        seen.add(path)
    assert len(seen) == 4, "both programs, the one that is both, and what checks their configuration"


@functools.cache
def keys():
    printed = subprocess.run([program("reed_config"), "--keys"], capture_output=True, text=True, check=True, timeout=30).stdout
    return set(re.findall(r"^\| ([\w.\[\]]+) \|", printed, re.M)) - {"key", "arm"}


@functools.cache
def signals():
    """Recorded signals and their columns, as Python and the exports name them: control.tau, control.tau_j1."""
    found = {f"{channel.removeprefix('REED_').lower()}.{field.name}" for channel, kind in TABLES.items() for field in fields(kind)}
    return found | {f"{name}_{suffix}" for name in found for suffix in ("j1", "x")}


@pytest.mark.parametrize("document", DOCUMENTS)
def test_every_key_of_a_scenario_that_is_named_exists(document):
    sections = {section for section in (key.partition(".")[0] for key in keys()) if not section.endswith("[]")}
    known = keys() | signals() | {f"{section}.{key}" for section, allowed in definition.SECTIONS.items() for key in allowed}
    lists = {key.partition("[]")[0] + "[]" for key in known}
    for name in re.findall(rf"(?<![\w./-])((?:{'|'.join(sections)})(?:\.\w+|\[\])+)", text_of(document)):
        key = re.sub(r"\.\d+", "[]", name)
        assert name.rpartition(".")[2] in (*SOURCE.split("|"), "lcmlog") or key in known or f"{key}[]" in lists, name


def test_every_telemetry_channel_and_message_is_in_their_document():
    text = text_of("lcmtypes/README.md")
    sources = "".join(text_of(name) for name in tracked("firmware/*.h", "firmware/*.cc", "plant_sim/*.h", "plant_sim/*.cc"))
    channels = set(re.findall(r'"(REED_[A-Z_]+)"', sources))
    assert len(channels) >= 9 and channels == set(re.findall(r"^\| (REED_\w+) \|", text, re.M))
    assert {name.partition("/")[2][:-4] for name in tracked("lcmtypes/*.lcm")} == set(re.findall(r"\| (\w+_t) \|", text))


def test_the_readme_names_everything_that_is_installed():
    table = text_of("README.md").partition("## Dependencies")[2]
    packages = [line.split()[1] for line in text_of("tools/apt-packages.txt").splitlines() if line and line[0] != "#"]
    for package in packages:
        assert PACKAGE_NAMES[package] in table, package


def test_the_readme_names_everything_that_python_imports():
    table = text_of("README.md").partition("## Dependencies")[2]
    nodes = [node for name in tracked("*.py") for node in ast.walk(ast.parse(text_of(name)))]
    modules = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    modules |= {node.module for node in nodes if isinstance(node, ast.ImportFrom) and not node.level}
    own = {name.rpartition("/")[2][:-3] for name in tracked("*.py")} | {"reed_tools", "reed"}
    for module in {name.partition(".")[0] for name in modules} - own - sys.stdlib_module_names:
        assert PYTHON_NAMES.get(module, module) in table, module
