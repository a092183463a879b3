"""Estimates as nominal values of a new arm file: a copy of the old one, comments kept, with other p_nom and coulomb_nominal."""

import re
from pathlib import Path

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.record.whole_file import write_text
from reed_tools.robots import nominal
from reed_tools.robots.nominal import NominalArm


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


def with_nominal(text: str, arm: NominalArm, p: np.ndarray, coulomb: np.ndarray, where: str) -> str:
    if not re.search(r"^param_names\s*=", text, re.M):
        raise UsageError(f"--write: {where} names no parameters; write param_names, p_nom and param_shapes into it, which config/README.md describes")
    if re.search(r"^\[\[bodies\]\]", text, re.M) and "p_true" not in text:
        raise UsageError(f"--write: the [[bodies]] of {where} include p_nom; write what is not uncertain as known_bodies instead")
    text = with_line(text, "p_nom", p)
    return with_line(text, "coulomb_nominal", coulomb)


def with_line(text: str, key: str, values: np.ndarray) -> str:
    """`key = [...]` with these values and the old comment, or a new line before the first table."""
    line = f"{key} = [{', '.join(f'{value:.6g}' for value in values)}]"
    old = re.compile(rf"^{key}\s*=\s*(?:\[[^\]]*\]|[^#\n]*?)([ \t]*#[^\n]*)?$", re.M)
    if old.search(text):
        return old.sub(lambda found: f"{line}{found[1] or ''}", text, count=1)
    table = re.search(r"^\s*\[", text, re.M)
    at = table.start() if table else len(text)
    return f"{text[:at].rstrip()}\n{line}   # identified\n\n{text[at:].lstrip()}"


def write(target: Path, text: str) -> None:
    if target.exists():
        raise UsageError(f"--write {target}: is there already; nothing was overwritten")
    nominal.of_table(nominal.parsed(text, str(target)), str(target))  # still an arm file
    try:
        write_text(target, text)
    except OSError as error:
        raise UsageError(f"--write {target}: {(error.strerror or str(error)).lower()}") from None
