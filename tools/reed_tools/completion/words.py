"""What can be typed behind tools/reed: from the commands' own parsers, so that nothing is listed twice."""

import re
import subprocess
from dataclasses import dataclass

from reed_tools import cli
from reed_tools.errors import RunError
from reed_tools.paths import program

KINDS = {"RUN_DIR": "run", "RUN": "run", "RUN_DIR|FILE|-": "run", "RUN_DIR|CANDUMP": "run", "SCENARIO": "scenario", "SCENARIO|ARM": "scenario", "NAME|FILE": "arm",
         "ARM": "arm", "CAMPAIGN": "campaign", "DIR": "folder", "FILE": "file", "F": "file", "F.toml": "file", "F.urdf": "file",
         "FILE.toml": "file", "ARM_OUT.toml": "file", "LIB.so": "file", "LIB.so|FILE.py": "file", "BUS": "bus"}
FREE = "free"  # a value that only the person knows
OF_INSPECT = {"--arm": "arm", "--states": "file", "--plot": "file", "--modes": FREE, "--at": FREE, "--beam": FREE}


@dataclass(frozen=True)
class Value:
    """kind: of KINDS, FREE, or "choice" with its words."""

    kind: str
    choices: tuple[str, ...] = ()


@dataclass(frozen=True)
class Option:
    name: str
    help: str
    value: Value | None  # None: a switch
    repeatable: bool = False


@dataclass(frozen=True)
class Command:
    name: str
    help: str
    options: tuple[Option, ...]
    words: Value | None  # what stands without an option


def commands() -> list[Command]:
    return [inspect(name, text) if hasattr(cli.module_of(name), "pass_through") else of_parser(name, text)
            for name, (_, text) in cli.COMMANDS.items()]


def of_parser(name: str, text: str) -> Command:
    options, words = [], None
    for action in cli.parser_of(name)._actions:  # argparse has no public list of them
        value = value_of(action)
        if not action.option_strings:
            words = value
        else:
            options += [Option(option, help_of(action), value, type(action).__name__ == "_AppendAction")
                        for option in action.option_strings if option.startswith("--")]
    return Command(name, text, tuple(options), words)


def value_of(action) -> Value | None:
    if action.nargs == 0:
        return None
    if action.choices:
        return Value("choice", tuple(map(str, action.choices)))
    return Value(KINDS.get(action.metavar, FREE))


def help_of(action) -> str:
    return re.sub(r"%\((\w+)\)s", lambda found: str(getattr(action, found[1], "")), action.help or "").replace("%%", "%")


def inspect(name: str, text: str) -> Command:
    """Its options are the program's."""
    try:
        printed = subprocess.run([str(program("reed_inspect")), "--help"], capture_output=True, text=True).stdout
    except RunError:  # not built yet
        printed = ""
    found = {*re.findall(r"--[\w-]+", printed), *OF_INSPECT, "--help", "--version"}
    options = tuple(Option(option, "", Value(OF_INSPECT[option]) if option in OF_INSPECT else None) for option in sorted(found))
    return Command(name, text, options, None)
