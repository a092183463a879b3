"""effective.toml: the whole configuration of a run, both programs' halves, as a run folder keeps it."""

import tomllib
from pathlib import Path

from reed_tools.errors import UsageError

NUMBER = (int, float)
NEEDED = {  # what figures, pictures and page are made from
    "scenario": {"name": str, "duration_s": NUMBER, "seed": int},
    "arm": {"name": str, "param_names": list, "p_true": list, "p_lo": list, "p_hi": list, "torque_limit": list},
    "control": {"law": str, "sigma0_max": NUMBER, "sigma1_max": NUMBER},
    "timing": {"rate_hz": NUMBER},
}


TRUTH_BESIDE = {"p": "p_true", "bodies": "bodies", "coulomb": "coulomb"}  # of [arm.truth], as figures call it


def load(path: Path) -> dict:
    try:
        effective = with_truth_beside(tomllib.loads(path.read_text(encoding="utf-8")))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise UsageError(f"{path}: {error}") from None
    if problem := first_problem(effective):
        raise UsageError(f"{path}: {problem}; it is not the file that a run left")
    return effective


def first_problem(effective: dict) -> str | None:
    for section, keys in NEEDED.items():
        if not isinstance(effective.get(section), dict):
            return f"[{section}] is missing"
        for key, kind in keys.items():
            if not isinstance(effective[section].get(key), kind):
                return f"{section}.{key} is missing or of another type"
    if not any(isinstance(effective["arm"].get(key), list) for key in ("dh", "joint")):
        return "the arm has neither dh nor [[arm.joint]]"
    checks = effective.get("checks")
    if not isinstance(checks, list):
        return "[[checks]] is missing"
    if not all(isinstance(check.get("name"), str) and isinstance(check.get("limit"), NUMBER) for check in checks):
        return "a check has no name or no limit"
    return None


def with_truth_beside(effective: dict) -> dict:
    """Figures are drawn by those who may know both: [arm.truth] beside what the controller knows of the arm."""
    arm = effective.get("arm", {})
    truth = arm.get("truth", {}) if isinstance(arm, dict) else {}
    return effective | {"arm": arm | {name: truth[key] for key, name in TRUTH_BESIDE.items() if key in truth}} if truth else effective


def parameter_boxes(effective: dict) -> list[tuple[float, float]]:
    return list(zip(effective["arm"]["p_lo"], effective["arm"]["p_hi"]))


def sigma_limits(effective: dict) -> tuple[float, float]:
    control = effective["control"]
    return control["sigma0_max"], control["sigma1_max"]
