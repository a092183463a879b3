"""A commit checked out and built in build/gate/<hash>: kept for the next gate, the oldest ones removed."""

import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

from reed_tools.errors import RunError, UsageError
from reed_tools.gate.commits import git
from reed_tools.paths import ROOT

CACHE = ROOT / "build" / "gate"
KEPT = 4  # trees with their builds, about 150 MB each
TARGETS = ("reed_one_process", "reed_replay", "reed_config_tool")


def programs(commit: str, joints: list[int]) -> Path:
    """The folder of the programs, built for these numbers of joints and those that it was built for before."""
    tree = CACHE / commit[:16]
    if not (tree / "CMakeLists.txt").is_file():
        check_out(commit, tree)
    build = tree / "build" / "release"
    started = time.monotonic()
    print(f"  building {commit[:12]} ", end="", file=sys.stderr, flush=True)
    step(commit, "cmake", "--preset", "release", "-S", str(tree), "-B", str(build), f"-DREED_PYTHON={sys.executable}", f"-DREED_JOINTS={with_those_before(build, joints)}",
         "-DREED_BUILD_TESTS=OFF", *launcher())
    step(commit, "ninja", "-C", str(build), *TARGETS)
    print(f"{time.monotonic() - started:6.1f} s", file=sys.stderr, flush=True)
    tree.touch()
    forget_oldest()
    return build / "bin"


def with_those_before(build: Path, joints: list[int]) -> str:
    cache = build / "CMakeCache.txt"
    before = re.search(r"^REED_JOINTS:\w+=(.*)$", cache.read_text(errors="replace"), re.M) if cache.exists() else None
    return ";".join(map(str, sorted({*joints, *(int(number) for number in (before[1].split(";") if before else []))})))


def check_out(commit: str, tree: Path) -> None:
    if git("cat-file", "-e", f"{commit}:firmware/replay/main.cc").returncode:
        raise UsageError(f"commit {commit[:12]} has no reed_replay, so its tapes cannot be compared; name a later one")
    CACHE.mkdir(parents=True, exist_ok=True)
    git("worktree", "prune")
    done = git("worktree", "add", "--force", "--detach", str(tree), commit)
    if done.returncode:
        raise RunError(f"commit {commit[:12]} could not be checked out: {done.stderr.strip()[-300:]}")


def launcher() -> list[str]:
    found = shutil.which("ccache")
    return [f"-DCMAKE_{language}_COMPILER_LAUNCHER={found}" for language in ("C", "CXX")] if found else []


def step(commit: str, *command: str) -> None:
    """ccache sees paths relative to the tree: two versions have most of their code in common."""
    shared = {"CCACHE_BASEDIR": str(CACHE / commit[:16]), "CCACHE_NOHASHDIR": "1"}
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", env={**os.environ, **shared})
    if done.returncode:
        print(file=sys.stderr)
        raise RunError(f"commit {commit[:12]} did not build: {(done.stderr + done.stdout).strip()[-400:]}")


def forget_oldest() -> None:
    trees = sorted((path for path in CACHE.iterdir() if (path / "CMakeLists.txt").is_file()), key=lambda path: path.stat().st_mtime)
    for tree in trees[:-KEPT]:
        git("worktree", "remove", "--force", str(tree))
