"""Estimates as nominal values of a new arm file: a copy of the old one, comments kept, with other p_nom and coulomb_nominal."""

import re
from pathlib import Path

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.record.toml_text import replaced
from reed_tools.record.whole_file import require_new, write_new
from reed_tools.robots import nominal


def arm_text_of_run(folder: Path) -> str:
    """The [arm] part of effective.toml as a file of its own."""
    lines, inside = [], False
    for line in (folder / "effective.toml").read_text(encoding="utf-8").splitlines():
        if header := re.match(r"(\[+)([^\]]+)(\]+)$", line):
            inside = header[2].split(".")[0] == "arm"
            line = f"{header[1]}{header[2].removeprefix('arm.')}{header[3]}" if header[2] != "arm" else ""
        if inside:
            lines.append(line)
    return "\n".join(lines).strip() + "\n"


def with_nominal(text: str, p: np.ndarray, coulomb: np.ndarray, where: str) -> str:
    if not re.search(r"^param_names\s*=", text, re.M):
        raise UsageError(f"--write: {where} names no parameters; write param_names, p_nom and param_shapes into it, which config/README.md describes")
    if re.search(r"^\[\[bodies\]\]", text, re.M) and "p_true" not in text:
        raise UsageError(f"--write: the [[bodies]] of {where} include p_nom; write what is not uncertain as known_bodies instead")
    text = with_line(text, "p_nom", p)
    return with_line(text, "coulomb_nominal", coulomb)


def with_line(text: str, key: str, values: np.ndarray) -> str:
    """`key = [...]` with these values and the old comment, or a new line, before the first table."""
    value = f"[{', '.join(f'{value:.6g}' for value in values)}]"
    table = re.search(r"^[ \t]*\[+[A-Za-z]", text, re.M)  # rows of numbers in brackets are none
    at = table.start() if table else len(text)
    head = replaced(text[:at], key, value) or f"{text[:at].rstrip()}\n{key} = {value}   # identified\n\n"
    return head + text[at:]


def write(target: Path, text: str) -> None:
    require_new("--write", target)
    nominal.of_table(nominal.parsed(text, str(target)), str(target))  # still an arm file
    write_new("--write", target, text)
