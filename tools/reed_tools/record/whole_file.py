"""A file that appears under its name whole or not at all: what was there before stays until everything is on the disk."""

import os
from contextlib import contextmanager
from pathlib import Path

from reed_tools.errors import UsageError

DRAFT = ".part"


def draft_of(path: Path) -> Path:
    return path.with_name(path.name + DRAFT)


@contextmanager
def replacing(path: Path):
    """Yields a binary file; an OSError from here on carries the name of `path`."""
    draft = draft_of(path)
    try:
        with open(draft, "wb") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        draft.replace(path)
        sync_folder(path.parent)
    except BaseException as error:
        draft.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise type(error)(error.errno, error.strerror or str(error), str(path)) from None
        raise


def write_text(path: Path, text: str) -> None:
    with replacing(path) as file:
        file.write(text.encode(errors="backslashreplace"))  # a path need not be UTF-8


def require_new(option: str, path: Path) -> None:
    if path.exists():
        raise UsageError(f"{option} {path}: is there already; nothing was overwritten")


def write_new(option: str, path: Path, text: str) -> None:
    """What an option asked for, never over an old file."""
    require_new(option, path)
    try:
        write_text(path, text)
    except OSError as error:
        raise UsageError(f"{option} {path}: {(error.strerror or str(error)).lower()}") from None


def sync_folder(folder: Path) -> None:
    """The new name itself survives a loss of power."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
