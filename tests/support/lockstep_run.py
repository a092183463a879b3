"""A run of both programs in lockstep, recorded into a folder without figures and page: a second or two."""

from pathlib import Path

from reed_tools.paths import program
from reed_tools.record.merge import merge
from reed_tools.run import hil, scenario


def record(folder: Path, bus: str, name: str, *entries: str) -> Path:
    effective = scenario.write_effective(name, None, list(entries), folder / "effective.toml")
    plan = hil.Plan(str(program("reed_firmware")), str(program("reed_plant_sim")), str(folder / "effective.toml"), bus, "lockstep",
                    str(folder), int(61 * effective["timing"]["rate_hz"]), lcm=False)
    outcome = hil.run_pair(plan, lambda mode, t_s: None)
    assert (outcome.firmware_status, outcome.plant_status) == (0, 0)
    merge([plan.log("firmware"), plan.log("plant")], folder / "telemetry.lcmlog")
    return folder
