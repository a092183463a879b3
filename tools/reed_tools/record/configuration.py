"""effective.toml: the one configuration that both programs read, as a run folder keeps it."""

import tomllib
from pathlib import Path

from reed_tools.errors import UsageError


def load(path: Path) -> dict:
    try:
        return tomllib.loads(path.read_text())
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise UsageError(f"{path}: {error}") from None


def parameter_boxes(effective: dict) -> list[tuple[float, float]]:
    return list(zip(effective["arm"]["p_lo"], effective["arm"]["p_hi"]))


def sigma_limits(effective: dict) -> tuple[float, float]:
    control = effective["control"]
    return control["sigma0_max"], control["sigma1_max"]
