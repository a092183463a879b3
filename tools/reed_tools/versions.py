"""What runs here: the version of Reed, the commit of its tree, the build of its programs and the file of a law from outside."""

import hashlib
import subprocess
import tomllib
from collections.abc import Iterable
from pathlib import Path

from reed_tools.paths import ROOT, program

PROGRAMS = ("reed_firmware", "reed_plant_sim")


def reed() -> str:
    return tomllib.loads((ROOT / "tools" / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]


def commit() -> str | None:
    """With "+changes" where the tree is not the commit's; None without git or outside a repository."""
    head = git("rev-parse", "HEAD")
    return f"{head}+changes" if head and git("status", "--porcelain", "--untracked-files=no") else head or None


def git(*arguments: str) -> str:
    try:
        done = subprocess.run(["git", "-C", str(ROOT), *arguments], capture_output=True, text=True)
    except OSError:
        return ""
    return done.stdout.strip() if done.returncode == 0 else ""


def build(programs: Iterable[str] = PROGRAMS) -> str:
    """Of the programs of a run: runs of different builds need not be equal."""
    return short_sum(program(name) for name in programs)


def short_sum(paths: Iterable[Path]) -> str:
    total = hashlib.sha256()
    for path in paths:
        total.update(path.read_bytes())
    return total.hexdigest()[:12]


def of_tools() -> dict:
    return {"reed": reed(), "commit": commit()}


def all_of_them(programs: Iterable[str] = PROGRAMS, law: Path | None = None) -> dict:
    """law: the file of a law from outside, which is in no commit and no build of ours."""
    return of_tools() | {"build": build(programs), "law": short_sum([law]) if law else None}
