"""The .lcm files: each line of a message declares one number once, with name, unit, frame, sign and, for what the loop records,
the expression that it comes from:

    double f_d;  // N, desired normal force <- decision.force.f_d

Everything else follows: the snapshot, the encoder and the line that fills it (lcmtypes/generate_fields.py), the arrays, columns,
units and figures of the tools."""

import re
from pathlib import Path
from typing import NamedTuple

FIELD = re.compile(r"^\s*(\w+)\s+(\w+)((?:\[\w+\])?)\s*;[^\S\n]*(?://[^\S\n]*(.*))?$", re.MULTILINE)
UNIT = re.compile(r"(%|us|ns|s|rad(?:/s(?:\^2)?)?|rad/m|N·m(?:·s/rad)?|N·s|N/m|N|m(?:/s(?:\^2)?)?|kg|J|W|1/s)(?=[,; ]|$)")
SOURCE = "<-"


class Field(NamedTuple):
    kind: str           # scalar type
    name: str
    length: str | None  # of an array: a number or an earlier field
    comment: str        # unit, meaning, frame, sign
    source: str = ""    # in C++, of what a loop records

    @property
    def unit(self) -> str:
        """What the comment begins with, "" for a number without unit."""
        found = UNIT.match(self.comment)
        return found[1] if found else ""


def fields(path: Path) -> list[Field]:
    """In the file's order."""
    text = path.read_text(encoding="utf-8")
    found = []
    for kind, name, length, comment in FIELD.findall(text[text.index("{"):]):
        meaning, _, source = comment.partition(SOURCE)
        found.append(Field(kind, name, length.strip("[]") or None, meaning.strip(), source.strip()))
    return found
