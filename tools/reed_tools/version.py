"""Which Reed this is: the version of its sources, and the commit they are at."""

import re
import subprocess

from reed_tools.paths import ROOT


def text() -> str:
    return f"reed {number()}, {commit()}"


def number() -> str:
    return re.search(r"^project\(reed VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]


def commit() -> str:
    """With what differs from it, since a run then is that of no commit."""
    head = git("rev-parse", "--short=12", "HEAD")
    if not head:
        return "commit unknown: this is no git checkout of this user"
    return f"commit {head}{' with changes' if git('status', '--porcelain', '--untracked-files=no') else ''}"


def git(*arguments: str) -> str:
    try:
        done = subprocess.run(["git", "-C", str(ROOT), *arguments], capture_output=True, text=True, errors="replace")
    except OSError:
        return ""
    return done.stdout.strip() if done.returncode == 0 else ""
