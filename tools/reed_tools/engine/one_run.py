"""One run in a worker: in lockstep, controller and plant in one process, on a bus in memory, without telemetry on the network."""

from pathlib import Path

from reed_tools.run import hil, plans


def in_memory(effective: dict, config: Path | str, folder: Path, interrupted: list, entries: list[str] = ()) -> tuple[hil.Plan, hil.Outcome]:
    """`effective`: the content of `config` as far as it decides how long the run may be. Ends early once `interrupted` is not empty."""
    plan = plans.make(effective, config, hil.MEMORY, "lockstep", folder, lcm=False, candump=False, entries=list(entries))
    return plan, hil.run(plan, lambda mode, t_s: None, interrupted)
