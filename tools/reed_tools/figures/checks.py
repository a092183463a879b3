"""The verdict's figures by name, for [[checks]] of a scenario. Every check holds when value <= limit; a figure that does not
exist fails, with the reason."""

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.figures import contact_figures, estimate_figures, loop_figures, tracking_figures
from reed_tools.figures.run_data import NoFigure, RunData

FIGURES = {function.__name__: function for module in (tracking_figures, contact_figures, estimate_figures, loop_figures)
           for function in module.FIGURES}
ALWAYS = ("faults", "missing_s")  # must be 0: a run that ended in a fault or early never passes, whatever the scenario asks
EXPLAINED = {"missing_s": loop_figures.why_missing}


def require_known(entries: list[dict], where: str) -> None:
    for entry in entries:
        if entry["name"] not in FIGURES:
            raise UsageError(f"{where}: checks.name = \"{entry['name']}\" is not a figure; allowed: {', '.join(FIGURES)}")


def value_of(name: str, run: RunData) -> tuple[float | None, str | None]:
    """(value, None), or (None, why there is none)."""
    try:
        value = FIGURES[name](run)
    except NoFigure as reason:
        return None, str(reason)
    return (value, None) if np.isfinite(value) else (None, "it is no finite number")


def evaluate(entries: list[dict], run: RunData) -> list[dict]:
    asked = {entry["name"] for entry in entries}
    result = []
    for entry in [*entries, *({"name": name, "limit": 0} for name in ALWAYS if name not in asked)]:
        value, why = value_of(entry["name"], run)
        ok = value is not None and value <= entry["limit"]
        if not ok and value is not None and entry["name"] in EXPLAINED:
            why = EXPLAINED[entry["name"]](run)
        result.append({"name": entry["name"], "limit": entry["limit"], "value": value, "ok": bool(ok), "why": why})
    return result
