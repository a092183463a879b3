"""Commits by their names, and what their messages declare."""

import re
import subprocess

from reed_tools.errors import UsageError
from reed_tools.paths import ROOT

MAIN = ("origin/main", "main")  # the first that is there and is another commit
NO_BASE = "this clone has no commit before HEAD (a shallow clone: `git fetch --deepen 1`)"
DECLARATION = re.compile(r"^changes-control:[ \t]*(\S.*)$", re.IGNORECASE | re.MULTILINE)


def git(*arguments: str) -> subprocess.CompletedProcess:
    try:
        return subprocess.run(["git", "-C", str(ROOT), *arguments], capture_output=True, text=True, errors="replace")
    except OSError:
        raise UsageError("git is not installed, and the gate builds two commits; install git") from None


def resolve(name: str) -> str:
    """The full hash."""
    done = git("rev-parse", "--verify", "--quiet", "--end-of-options", f"{name}^{{commit}}")
    if done.returncode:
        raise UsageError(f"`{name}` is no commit of {ROOT}; allowed: a hash, a branch, a tag or HEAD~N (`git fetch` brings those of others)")
    return done.stdout.strip()


def last_of_main() -> str | None:
    """Where HEAD left main; on main itself the commit before HEAD. None where the clone does not reach that far."""
    head = resolve("HEAD")
    for name in MAIN:
        found = git("merge-base", name, "HEAD")
        if found.returncode == 0 and found.stdout.strip() not in ("", head):
            return found.stdout.strip()
    before = git("rev-parse", "--verify", "--quiet", "HEAD^1^{commit}")
    return before.stdout.strip() if before.returncode == 0 else None


def require_clean() -> None:
    """What is not in a commit would not be gated."""
    changed = [line[3:] for line in git("status", "--porcelain", "--untracked-files=no").stdout.splitlines()]
    if changed:
        more = f" and {len(changed) - 1} more" if len(changed) > 1 else ""
        raise UsageError(f"the working tree is not clean ({changed[0]}{more}) and the gate compares commits: commit, or name the second "
                         "commit as well: tools/reed gate BASE HEAD")


def declared(base: str, head: str) -> list[str]:
    """The lines `changes-control: why` of every commit from base to head."""
    return DECLARATION.findall(git("log", "--format=%B%x00", f"{base}..{head}").stdout)
