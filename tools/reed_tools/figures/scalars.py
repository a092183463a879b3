"""The range of every scalar that a loop records while the arm is active. Names, units and meanings come from the .lcm files, so a
scalar that is declared there is here, in summary.json and on the page."""

import math

import numpy as np

from reed_tools.record.message_layout import fields
from reed_tools.record.signals import ACTIVE
from reed_tools.record.telemetry_log import DIGEST_CHANNELS, TABLES, Recording, name_of

LAW = "of the law from outside"
TIME = "t_s"  # says when, and is no figure


def declared(channel: str) -> list:
    """Fields of a channel that are one physical number."""
    return [field for field in fields(TABLES[channel]) if field.kind == "double" and field.length is None and field.name != TIME]


def of_run(recording: Recording) -> dict[str, dict]:
    """By name: unit, meaning, and smallest, largest, mean and last value; empty where the arm never was active."""
    control = recording.tables["REED_CONTROL"]
    cycles = control["cycle"][control["mode"] == ACTIVE] if recording.has("REED_CONTROL") else []
    found = {}
    for channel in DIGEST_CHANNELS:
        table = recording.tables[channel]
        rows = np.isin(table["cycle"], cycles)
        if not rows.any():
            continue
        for field in declared(channel):
            found[name_of(channel, field.name)] = {"unit": field.unit, "meaning": field.comment, **ranges(table[field.name][rows])}
    law = recording.tables["REED_LAW"]
    rows = np.isin(law["cycle"], cycles)
    if rows.any():
        for name, values in zip(recording.law_names, law["values"][rows].T):
            found[name_of("REED_LAW", name)] = {"unit": "", "meaning": LAW, **ranges(values)}
    return found


def ranges(values: np.ndarray) -> dict[str, float | None]:
    figures = {"min": values.min(), "max": values.max(), "mean": values.mean(), "last": values[-1]}
    return {name: float(value) if math.isfinite(value) else None for name, value in figures.items()}
