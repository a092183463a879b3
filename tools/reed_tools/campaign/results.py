"""A campaign's summary.json: its limits, the distribution of every figure, and the worst draws as command lines."""

import json
import math
from pathlib import Path

import numpy as np

from reed_tools.campaign.definition import Campaign
from reed_tools.campaign.draws import Record, command, worst_first
from reed_tools.campaign.verdicts import Verdict

SCHEMA = 1
WORST_SHOWN = 15


def build(campaign: Campaign, records: list[Record], wanted: int, verdict: Verdict) -> dict:
    """`wanted`: draws that were asked for."""
    return {
        "schema": SCHEMA,
        "campaign": campaign.name,
        "scenario": campaign.scenario,
        "seed": campaign.seed,
        "definition": campaign.definition(),
        "builds": sorted({record.build for record in records}),
        "draws": wanted,
        "finished": len(records),
        "verdict": "pass" if verdict.ok else "fail",
        "limits": [{"name": line.name, "value": finite(line.value), "limit": line.limit, "ok": line.ok} for line in verdict.lines],
        "repeated": verdict.repeated,
        "different": verdict.different,
        "figures": [distribution(name, limit, records) for name, limit in checked(records)],
        "worst": [{"index": record.index, "ratio": finite(record.ratio), "status": record.status, "message": record.message,
                   "deciding": record.deciding, "digest": record.digest, "seed": record.seed, "command": command(campaign.scenario, record)}
                  for record in worst_first(records)[:WORST_SHOWN]],
    }


def finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def checked(records: list[Record]) -> list[tuple[str, float]]:
    """(name, limit) of every check, in the scenario's order."""
    return list({check["name"]: check["limit"] for record in records for check in record.checks}.items())


def values(name: str, records: list[Record]) -> np.ndarray:
    found = [check["value"] for record in records for check in record.checks if check["name"] == name]
    return np.array([value for value in found if value is not None], dtype=float)


def distribution(name: str, limit: float, records: list[Record]) -> dict:
    found = values(name, records)
    some = len(found) > 0
    return {"name": name, "limit": limit, "count": len(found),
            "median": float(np.median(found)) if some else None,
            "p95": float(np.percentile(found, 95)) if some else None,
            "worst": float(found.max()) if some else None,
            "beyond": int(np.sum(found > limit))}


def write(folder: Path, summary: dict) -> None:
    (folder / "summary.json").write_text(json.dumps(summary, indent=2, allow_nan=False) + "\n")
