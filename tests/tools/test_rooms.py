"""The rooms of tools/reed_tools: which one may import which."""

import ast
import sys
from pathlib import Path

import pytest

from reed_tools.paths import ROOT

TOOLS = ROOT / "tools" / "reed_tools"
BASE = {"errors", "folders", "paths", "streams", "text", "versions"}  # modules that every room may import; they know no room
ARROWS = {
    "show": set(),
    "law": set(),
    "record": set(),
    "robots": {"record", "show"},
    "figures": {"record", "robots", "show"},
    "compare": {"figures", "record", "show"},
    "live": {"record", "robots", "run"},
    "replay": {"law", "record", "run", "show"},
    "gate": {"record", "replay", "robots", "run", "show"},
    "export": {"record", "robots", "run"},
    "arms": {"record", "robots", "show"},
    "scenarios": {"record", "robots", "run"},
    "identify": {"export", "record", "robots", "scenarios", "show"},
    "run": {"figures", "law", "record", "robots"},
    "engine": {"run"},
    "campaign": {"engine", "figures", "record", "robots", "run", "show"},
    "worst": {"campaign", "engine", "run"},
    "faults": {"engine", "record", "run", "show"},
    "map": {"campaign", "engine", "record", "run", "show", "worst"},
    "paper": {"engine", "figures", "record", "robots", "run", "show"},
    "bode": {"robots", "run", "show"},
    "tune": {"campaign", "engine", "record", "robots", "run", "scenarios", "show"},
    "bench": {"law", "record", "robots", "show"},
    "machine": {"run", "show"},
    "testing": {"run"},
    "notebook": {"cli", "export", "figures", "record", "run", "show"},
    "completion": {"cli"},  # it lists what the command line takes
}
NEEDS_NO_PACKAGE = ("run/pair.py", "run/hil.py", "run/guard.py", "record/log_tail.py", "run/__init__.py", "record/__init__.py", "__init__.py")  # run inside the VM


def imported(file: Path) -> set[str]:
    """The rooms and base modules of reed_tools that a file imports, at its top or later."""
    found = set()
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.ImportFrom) and node.module:
            parts = node.module.split(".")
            found |= {alias.name for alias in node.names} if parts == ["reed_tools"] else {parts[1]} if parts[0] == "reed_tools" else set()
        elif isinstance(node, ast.Import):
            found |= {alias.name.split(".")[1] for alias in node.names if alias.name.startswith("reed_tools.")}
    return found


def test_the_rooms_are_those_that_have_arrows():
    assert {path.parent.name for path in TOOLS.glob("*/__init__.py")} == set(ARROWS)
    assert {path.stem for path in TOOLS.glob("*.py")} == BASE | {"__init__", "__main__", "cli"}
    assert imported(TOOLS / "cli.py") <= BASE  # a command's room is imported when the command is asked for


@pytest.mark.parametrize("room", ARROWS)
def test_a_room_imports_only_along_its_arrows(room):
    for file in (TOOLS / room).rglob("*.py"):
        assert imported(file) <= ARROWS[room] | BASE | {room}, file


@pytest.mark.parametrize("room", ARROWS)
def test_every_arrow_is_used(room):
    used = set().union(*(imported(file) for file in (TOOLS / room).rglob("*.py")))
    assert ARROWS[room] <= used


def test_what_runs_inside_the_vm_needs_the_standard_library_alone():
    for name in NEEDS_NO_PACKAGE:
        for node in ast.walk(ast.parse((TOOLS / name).read_text())):
            modules = [alias.name for alias in node.names] if isinstance(node, ast.Import) else \
                [node.module] if isinstance(node, ast.ImportFrom) else []
            for module in modules:
                assert module.split(".")[0] in sys.stdlib_module_names or module in ("reed_tools.record.log_tail", "reed_tools.run", "reed_tools.run.guard"), (name, module)
