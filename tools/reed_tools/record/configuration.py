"""effective.toml: the whole configuration of a run, both programs' halves, as a run folder keeps it."""

import tomllib
from pathlib import Path

from reed_tools.errors import UsageError


TRUTH_BESIDE = {"p": "p_true", "bodies": "bodies", "coulomb": "coulomb"}  # of [arm.truth], as figures call it


def load(path: Path) -> dict:
    try:
        return with_truth_beside(tomllib.loads(path.read_text()))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise UsageError(f"{path}: {error}") from None


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
