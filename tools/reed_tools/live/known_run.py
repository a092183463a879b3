"""Which configuration a run on the telemetry has: the run command leaves word of its folder, for programs started by hand the
names in REED_RUN are looked up. Without either the page shows what telemetry alone says."""

import os
import tempfile
from pathlib import Path

from reed_tools.errors import ReedError
from reed_tools.paths import CURRENT_RUN
from reed_tools.record import configuration
from reed_tools.robots import joint_frames


def configuration_of(run, dof: int) -> dict | None:
    """run: run_t or None when the page was opened after the run's start."""
    try:
        effective = configuration.load(Path(os.fsdecode(CURRENT_RUN.read_bytes().rstrip(b"\n"))) / "effective.toml")
    except (OSError, ReedError):
        effective = None
    if effective and fits(effective, run, dof):
        return effective
    if run is None:
        return None
    from reed_tools.run import scenario

    try:
        with tempfile.TemporaryDirectory() as scratch:
            effective = scenario.write_effective(run.scenario, run.arm, [], Path(scratch, "effective.toml"))
    except ReedError:
        return None
    return effective if fits(effective, run, dof) else None


def fits(effective: dict, run, dof: int) -> bool:
    names = run is None or (effective["scenario"]["name"], effective["arm"]["name"]) == (run.scenario, run.arm)
    return names and joint_frames.dof(effective["arm"]) == dof
