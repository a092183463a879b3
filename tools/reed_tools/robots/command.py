"""tools/reed inspect: hands everything to the C++ program that links the firmware's own model and laws; draws what it
says of the arm's shape when --plot is among the options."""

import argparse
import json
import os
import re
import signal
import subprocess
from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.paths import program

MODES = 4
HELP = """  --plot [FILE]               with --arm: the arm bent by its weight and its first modes (--modes, default 4) as PNG,
                              at --at; default inspect-ARM.png

examples:
  tools/reed inspect --arm a5 --modes 4                # its first modes, motors locked
  tools/reed inspect --arm a5 --states cases.json      # the model and the law at given states
"""


def pass_through(argv: list[str]) -> int:
    argv = with_one_pose(argv)
    if any(option in ("-h", "--help") for option in argv):
        return show_help()
    if any(option == "--plot" or option.startswith("--plot=") for option in argv):
        return plot(argv)
    path = str(program("reed_inspect"))
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # Python ignores it; the program ends as others do when its reader has left
    os.execv(path, [path, *argv])


def with_one_pose(argv: list[str]) -> list[str]:
    """--at Q1 Q2 and --at Q1,Q2 are both --at=Q1,Q2; an angle may begin with a minus."""
    found, rest = [], list(argv)
    while rest:
        word = rest.pop(0)
        if word == "--at":
            angles = []
            while rest and re.match(r"[-+]?[.\d]", rest[0]):
                angles.append(rest.pop(0).strip(","))
            word = f"--at={','.join(angles)}" if angles else word
        found.append(word)
    return found


def show_help() -> int:
    done = subprocess.run([str(program("reed_inspect")), "--help"], stdout=subprocess.PIPE, text=True, errors="replace")
    print(done.stdout.rstrip("\n").replace("Usage: reed_inspect", "Usage: tools/reed inspect") + "\n" + HELP, end="")
    return done.returncode


class Parser(argparse.ArgumentParser):
    def error(self, message: str):
        raise UsageError(f"inspect --plot: {message}; allowed: --plot [FILE] --arm NAME|FILE [--modes N] [--at Q1,Q2,...]")


def plot(argv: list[str]) -> int:
    parser = Parser(prog="tools/reed inspect", add_help=False, allow_abbrev=False)
    parser.add_argument("--plot", nargs="?", type=Path)
    parser.add_argument("--arm", required=True)
    parser.add_argument("--modes", type=int, default=MODES)
    parser.add_argument("--at")
    arguments = parser.parse_args(argv)
    asked = [str(program("reed_inspect")), "--arm", arguments.arm, "--modes", str(arguments.modes)]
    done = subprocess.run([*asked, *(["--at=" + arguments.at] if arguments.at else [])], stdout=subprocess.PIPE, text=True, errors="surrogateescape")
    if done.returncode:
        return done.returncode   # the program has said why
    shapes = json.loads(done.stdout)
    target = arguments.plot or Path(f"inspect-{shapes['arm']}.png")
    from reed_tools.robots.arm_picture import draw
    try:
        draw(shapes, target)
    except (OSError, ValueError) as error:
        raise UsageError(f"inspect --plot {target}: {getattr(error, 'strerror', None) or error}") from None
    print(f"written {target}")
    return 0
