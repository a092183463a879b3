"""tools/reed inspect: hands everything to the C++ program that links the firmware's own model and laws; draws what it
says of the arm's shape when --plot is among the options."""

import argparse
import json
import os
import signal
import subprocess
from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.paths import program

MODES = 4


def pass_through(argv: list[str]) -> int:
    if any(option == "--plot" or option.startswith("--plot=") for option in argv):
        return plot(argv)
    path = str(program("reed_inspect"))
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # Python ignores it; the program ends as others do when its reader has left
    os.execv(path, [path, *argv])


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
