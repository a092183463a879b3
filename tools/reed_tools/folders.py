"""Folders for results: each belongs to exactly one process, from its making to the end of that process."""

import argparse
import fcntl
import itertools
import os
import re
import time
from collections.abc import Iterable
from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.paths import ROOT

LONGEST_TITLE = 100  # of a folder's name: file systems take 255 bytes
held: list[int] = []  # descriptors of this process's folders, open until it ends


def argument(text: str) -> Path:
    """What a command line may give as a folder or file."""
    if not text:
        raise argparse.ArgumentTypeError("is empty; allowed: a path")
    return Path(text)


def fresh(wanted: Path | None, title: str, own_files: Iterable[str], holds: str) -> Path:
    """`wanted`, or out/<time>-<title>, or that with the next free number. `own_files`: what this command writes there, none of
    which may be there yet; `holds`: what a folder with the first of them holds, and what to do about it."""
    folder = wanted or make_named(title)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        hold(folder)
        there = [name for name in own_files if os.path.lexists(folder / name)]
    except OSError as error:
        raise UsageError(f"--out {folder}: {(error.strerror or str(error)).lower()}") from None
    if there and there[0] == next(iter(own_files)):
        raise UsageError(f"--out {folder}: holds {holds}")
    if there:
        raise UsageError(f"--out {folder}: is not empty, and its {there[0]} would be replaced; choose another folder")
    return folder.resolve()


def make_named(title: str) -> Path:
    """Only mkdir can say who was first: two processes may start in one second."""
    name = f"{time.strftime('%Y%m%d-%H%M%S')}-{re.sub(r'[^A-Za-z0-9_.-]', '_', title)[:LONGEST_TITLE]}"
    for number in itertools.count(1):
        folder = ROOT / "out" / (name if number == 1 else f"{name}-{number}")
        try:
            folder.mkdir(parents=True)
            return folder
        except FileExistsError:
            continue
        except OSError as error:
            raise UsageError(f"{folder}: {(error.strerror or str(error)).lower()}; --out names another folder") from None


def hold(folder: Path) -> None:
    """Nobody else writes there until this process has ended, however it ends."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(descriptor)
        raise UsageError(f"{folder}: another command is writing there; wait until it has ended") from None
    except OSError:  # a file system without locks: mkdir alone decides there
        pass
    held.append(descriptor)
