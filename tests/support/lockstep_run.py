"""A run of both programs in lockstep, recorded into a folder without figures and page: a second or two."""

from pathlib import Path

from reed_tools.record.merge import merge
from reed_tools.run import hil, plans, scenario


def record(folder: Path, bus: str, name: str, *entries: str) -> Path:
    effective = scenario.write_effective(name, None, list(entries), folder / "effective.toml")
    plan = plans.make(effective, folder / "effective.toml", bus, "lockstep", folder, lcm=False)
    outcome = hil.run(plan, lambda mode, t_s: None)
    assert set(outcome.statuses.values()) == {0}
    merge([plan.log("firmware"), plan.log("plant")], folder / "telemetry.lcmlog")
    return folder
