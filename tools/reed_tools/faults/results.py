"""faults.json: every cell, how much of what is dangerous was detected, and what fails the matrix."""

import json
import math
from pathlib import Path

from reed_tools.faults import accepted
from reed_tools.faults.cell import Row
from reed_tools.record.whole_file import write_text

FILE = "faults.json"
SCHEMA = 1
CLASSES = ("dangerous undetected", "dangerous detected", "safe undetected", "safe detected")  # worst first
ORDER = ("died", "refused", "not executed", *CLASSES)


def coverage(classes: list[str]) -> float | None:
    """Share of the dangerous cells that were detected before the hazard."""
    detected, undetected = classes.count("dangerous detected"), classes.count("dangerous undetected")
    return detected / (detected + undetected) if detected + undetected else None


def failures(row: Row, reason: str | None) -> str | None:
    """Why this cell fails the matrix; None if it does not. `reason`: for which it is accepted."""
    if not row.executed:
        return f"{row.verdict}{f': {row.expected}' if row.expected else ''}"
    if row.verdict == "dangerous undetected" and not reason:
        return f"dangerous and undetected: {row.hazard or row.hazard_unmonitored}"
    if row.hazard and not reason:
        return f"detected, and yet dangerous: {row.hazard}"
    return row.expected


def build(rows: list[Row], false_alarms: list[dict], twins: int, allowed: list[accepted.Accepted], head: dict) -> dict:
    reasons = {id(row): accepted.reason_for(row, allowed) for row in rows}
    failed = {id(row): failures(row, reasons[id(row)]) for row in rows}
    rows = sorted(rows, key=lambda row: badness(row, failed[id(row)]))
    covered = coverage([row.verdict for row in rows])
    undetected = [row for row in rows if row.verdict == "dangerous undetected"]
    return {"schema": SCHEMA, **head, "verdict": "fail" if any(failed.values()) or false_alarms else "pass",
            "cells": len(rows), "classes": {name: sum(row.verdict == name for row in rows) for name in sorted({row.verdict for row in rows})},
            "diagnostic_coverage": None if covered is None else round(covered, 6),
            "dangerous_undetected": len(undetected),
            "dangerous_undetected_accepted": sum(reasons[id(row)] is not None for row in undetected),
            "false_alarms": false_alarms, "fault_free_runs": twins,
            "not_executed": [{"fault": row.fault, "phase": row.phase, "scenario": row.scenario, "seed": row.seed} for row in rows if not row.executed],
            "failed": sum(failure is not None for failure in failed.values()),
            "rows": [{**row.as_dict(), "accepted": reasons[id(row)], "failure": failed[id(row)]} for row in rows]}


def badness(row: Row, failure: str | None) -> tuple:
    """Worst first."""
    margin = row.margin_ms if row.margin_ms is not None else math.inf
    return (failure is None, ORDER.index(row.verdict), row.hazard is None, margin, row.fault, row.scenario, row.phase, row.seed)


def write(folder: Path, result: dict) -> Path:
    path = folder / FILE
    write_text(path, json.dumps(result, indent=1, allow_nan=False) + "\n")
    return path
