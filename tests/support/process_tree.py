"""Processes under another one, by the kernel's own lists. One that ends meanwhile is no error: it is left out."""

import os
from pathlib import Path


def children(pid: int) -> set[int]:
    """Of all its threads; none of a process that has ended."""
    found: set[int] = set()
    try:
        for task in os.listdir(f"/proc/{pid}/task"):
            found |= {int(number) for number in Path(f"/proc/{pid}/task/{task}/children").read_text().split()}
    except (FileNotFoundError, ProcessLookupError):
        pass
    return found


def command_line(pid: int) -> str:
    """Words with zeros between them; "" of a process that has ended."""
    try:
        return Path(f"/proc/{pid}/cmdline").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return ""
