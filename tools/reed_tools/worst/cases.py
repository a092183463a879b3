"""The file of cases that the tests run again: each line of JSON is a case that a search has found."""

import fcntl
import json
from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.paths import ROOT

FILE = ROOT / "tests" / "data" / "worst_cases.jsonl"
KEYS = {"campaign", "scenario", "entries", "figure", "ratio"}
VALUE = "value"  # of the figure; where the limit is 0 the ratio says nothing. Cases of former versions have none


def read(path: Path) -> list[dict]:
    found = []
    for position, line in enumerate(path.read_text(encoding="utf-8").splitlines() if path.exists() else [], 1):
        try:
            case = json.loads(line)
        except ValueError:
            case = None
        if not isinstance(case, dict) or set(case) - {VALUE} != KEYS:
            raise UsageError(f"{path}:{position}: not a case: allowed is an object with {', '.join(sorted(KEYS))} and {VALUE}")
        found.append(case)
    return found


def add(path: Path, case: dict) -> bool:
    """False: it is there already."""
    try:
        with open(path, "a", encoding="utf-8") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            known = {(one["scenario"], *one["entries"]) for one in read(path)}
            if (case["scenario"], *case["entries"]) in known:
                return False
            file.write(json.dumps(case) + "\n")
    except OSError as error:
        raise UsageError(f"--cases {path}: {(error.strerror or str(error)).lower()}") from None
    return True
