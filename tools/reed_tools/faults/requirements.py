"""safety/*.toml: hazards, the requirements that keep them away, and the faults that test these. safety/matrix.jsonl: what the faults
showed when the matrix was last run with --keep. Both make docs/safety.md (safety_page.py)."""

import json
import tomllib
from dataclasses import asdict, dataclass
from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.faults import accepted, catalogue
from reed_tools.faults.results import CLASSES
from reed_tools.paths import ROOT
from reed_tools.record.whole_file import write_text

SAFETY = ROOT / "safety"
MATRIX = SAFETY / "matrix.jsonl"
ACTIONS = ("not provided", "provided", "too early", "too late", "out of order", "stopped too soon", "applied too long")
KEYS = {"id", "action", "unsafe", "shall", "faults", "evidence"}
WHEN = ("within_ms", "before_hazard")  # one of them


@dataclass(frozen=True)
class Requirement:
    hazard: str
    id: str
    action: str          # of STPA's unsafe control actions
    unsafe: str
    shall: str
    within_ms: float | None  # from the fault to its detection; None: before the hazard
    faults: tuple[str, ...]
    evidence: tuple[str, ...]


@dataclass(frozen=True)
class Shown:
    """One cell of the kept matrix, over its seeds."""

    fault: str
    scenario: str
    phase: str
    seeds: int
    worst: str           # class
    detected_by: str | None
    fdti_ms: float | None
    fhti_ms: float | None
    ftti_ms: float | None    # the shortest
    margin_ms: float | None  # the smallest
    hazard: str | None       # reached with the monitors
    without_monitors: str | None
    digest: str              # of the first seed's run


def load(folder: Path = SAFETY) -> tuple[dict[str, str], list[Requirement]]:
    """Hazards by id, and all requirements; UsageError names file and what is wrong."""
    known = {entry["id"] for entry in catalogue.load(catalogue.STANDARD)}
    hazards, found = {}, []
    for path in sorted(folder.glob("*.toml")):
        if path.name == accepted.FILE.name:
            continue
        try:
            content = tomllib.loads(path.read_text(encoding="utf-8"))
        except (OSError, tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise UsageError(f"{path}: {error}") from None
        hazard, entries = content.get("hazard"), content.get("requirement", [])
        if not isinstance(hazard, dict) or not all(isinstance(hazard.get(key), str) and hazard[key] for key in ("id", "text")):
            raise UsageError(f"{path}: [hazard] needs id and text")
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            raise UsageError(f"{path}: expected [[requirement]]")
        hazards[hazard["id"]] = hazard["text"]
        found += [one(path, hazard["id"], entry, known) for entry in entries]
    twice = next((one.id for one in found if sum(other.id == one.id for other in found) > 1), None)
    if twice:
        raise UsageError(f"{folder}: the requirement {twice} is there twice")
    return hazards, found


def one(path: Path, hazard: str, entry: dict, known: set[str]) -> Requirement:
    name = entry.get("id", "without id")
    keys = set(entry) - set(WHEN)
    if keys != KEYS or len(set(entry) & set(WHEN)) != 1:
        raise UsageError(f"{path}: requirement {name}: expected the keys {', '.join(sorted(KEYS))} and one of {' and '.join(WHEN)}")
    within_ms = entry.get("within_ms")
    if not (entry.get("before_hazard") is True or type(within_ms) in (int, float) and within_ms > 0):
        raise UsageError(f"{path}: requirement {name}: allowed: within_ms above 0, or before_hazard = true")
    for key in ("faults", "evidence"):
        if not isinstance(entry[key], list) or not all(isinstance(text, str) for text in entry[key]):
            raise UsageError(f"{path}: requirement {name}: {key}: expected a list of texts")
    if entry["action"] not in ACTIONS:
        raise UsageError(f"{path}: requirement {name}: action '{entry['action']}'; allowed: {', '.join(ACTIONS)}")
    missing = [fault for fault in entry["faults"] if fault not in known]
    if missing or not entry["faults"]:
        raise UsageError(f"{path}: requirement {name}: " + (f"the fault '{missing[0]}' is not in config/faults/standard.toml" if missing else "no fault tests it"))
    return Requirement(hazard, name, entry["action"], entry["unsafe"], entry["shall"], within_ms, tuple(entry["faults"]), tuple(entry["evidence"]))


# ---- what the matrix showed ----

def summarised(rows: list[dict]) -> list[Shown]:
    """Of the rows of faults.json: the worst over the seeds."""
    cells: dict[tuple, list[dict]] = {}
    for row in rows:
        if row["class"] in CLASSES:
            cells.setdefault((row["fault"], row["scenario"], row["phase"]), []).append(row)

    def extreme(of, among, key):
        return of((row[key] for row in among if row[key] is not None), default=None)

    def named(among, key):
        return next((row[key] for row in among if row[key]), None)

    return [Shown(*key, len(among), min((row["class"] for row in among), key=CLASSES.index),
                  " ".join(sorted({row["detected_by"] for row in among if row["detected_by"]})) or None, extreme(max, among, "fdti_ms"),
                  extreme(max, among, "fhti_ms"), extreme(min, among, "ftti_ms"), extreme(min, among, "margin_ms"), named(among, "hazard"),
                  named(among, "hazard_unmonitored"), min(among, key=lambda row: row["seed"])["digest"])
            for key, among in sorted(cells.items())]


def keep(rows: list[dict]) -> None:
    write_text(MATRIX, "".join(json.dumps(asdict(shown)) + "\n" for shown in summarised(rows)))


def kept(path: Path = MATRIX) -> list[Shown]:
    return [Shown(**json.loads(line)) for line in path.read_text(encoding="utf-8").splitlines()] if path.exists() else []


def unproven(requirements: list[Requirement], shown: list[Shown]) -> list[str]:
    """Requirements of which a fault was never executed."""
    executed = {cell.fault for cell in shown}
    return [f"{one.id}: {fault}" for one in requirements for fault in one.faults if fault not in executed]


def unaccepted(shown: list[Shown], allowed: list[accepted.Accepted]) -> list[Shown]:
    """Dangerous cells that were not detected, or not in time, and that nobody has accepted."""
    return [cell for cell in shown if (cell.worst == "dangerous undetected" or cell.hazard)
            and not any(one.fault == cell.fault and (not one.phases or cell.phase in one.phases) for one in allowed)]
