"""The plan of a run on a given bus: which programs, with what."""

from pathlib import Path

from reed_tools.paths import program
from reed_tools.run import hil

PAIR = {"plant": "reed_plant_sim", "firmware": "reed_firmware"}
ONE_PROCESS = {"one_process": "reed_one_process"}
START_S = 60.0  # of the loop's own time, from the first SYNC to an active arm, at most


def names(bus: str) -> dict[str, str]:
    """The programs' names by their part in a run."""
    return ONE_PROCESS if bus == hil.MEMORY else PAIR


def make(effective: dict, config: Path | str, bus: str, clock: str, folder: Path, start_s: float = START_S, **options) -> hil.Plan:
    """`effective`: the content of the file `config` with its `entries`. `options`: lcm, candump, commit,
    entries, law, environment."""
    most_cycles = int((effective["scenario"]["duration_s"] + start_s) * effective["timing"]["rate_hz"])
    programs = {part: str(program(name)) for part, name in names(bus).items()}
    return hil.Plan(programs, str(config), bus, clock, str(folder), most_cycles, first_cycle=effective["timing"].get("first_cycle", 0), **options)
