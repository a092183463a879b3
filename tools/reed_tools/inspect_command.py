"""tools/reed inspect: hands everything to the C++ program that links the firmware's own model and laws."""

import os

from reed_tools.paths import program


def pass_through(argv: list[str]) -> int:
    path = str(program("reed_inspect"))
    os.execv(path, [path, *argv])
