"""faults.json: every cell, how much of what is dangerous was detected, and what fails the matrix."""

import json
import math
from pathlib import Path

from reed_tools.faults import accepted
from reed_tools.faults.cell import Row

FILE = "faults.json"
SCHEMA = 1


def failures(row: Row, allowed: list[accepted.Accepted]) -> str | None:
    """Why this cell fails the matrix; None if it does not."""
    if not row.executed:
        return f"{row.verdict}{f': {row.expected}' if row.expected else ''}"
    if row.verdict == "dangerous undetected" and not accepted.reason_for(row, allowed):
        return f"dangerous and undetected: {row.hazard}"
    if row.hazard and not accepted.reason_for(row, allowed):
        return f"detected, and yet dangerous: {row.hazard}"
    return row.expected


def build(rows: list[Row], false_alarms: list[dict], twins: int, allowed: list[accepted.Accepted], head: dict) -> dict:
    dangerous = [row for row in rows if row.verdict.startswith("dangerous")]
    detected = [row for row in dangerous if row.verdict == "dangerous detected"]
    failed = [row for row in rows if failures(row, allowed)]
    undetected = [row for row in dangerous if row.verdict == "dangerous undetected"]
    return {"schema": SCHEMA, **head, "verdict": "fail" if failed or false_alarms else "pass",
            "cells": len(rows), "classes": {name: sum(row.verdict == name for row in rows) for name in sorted({row.verdict for row in rows})},
            "diagnostic_coverage": round(len(detected) / len(dangerous), 6) if dangerous else None,
            "dangerous_undetected": len(undetected),
            "dangerous_undetected_accepted": sum(accepted.reason_for(row, allowed) is not None for row in undetected),
            "false_alarms": false_alarms, "fault_free_runs": twins,
            "not_executed": [{"fault": row.fault, "phase": row.phase, "scenario": row.scenario, "seed": row.seed} for row in rows if not row.executed],
            "failed": len(failed),
            "rows": [{**row.as_dict(), "accepted": accepted.reason_for(row, allowed), "failure": failures(row, allowed)}
                     for row in sorted(rows, key=lambda row: badness(row, allowed))]}


def badness(row: Row, allowed: list[accepted.Accepted]) -> tuple:
    """Worst first."""
    order = ["died", "refused", "not executed", "dangerous undetected", "dangerous detected", "safe undetected", "safe detected"]
    soon = row.ftti_ms if row.ftti_ms is not None else math.inf
    return (failures(row, allowed) is None, order.index(row.verdict), soon, row.fault, row.scenario, row.phase, row.seed)


def write(folder: Path, result: dict) -> Path:
    path = folder / FILE
    path.write_text(json.dumps(result, indent=1, allow_nan=False) + "\n")
    return path
