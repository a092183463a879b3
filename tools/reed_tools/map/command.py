"""tools/reed map: margin of a scenario over delay, jitter and loss of commands and measurements, and over the rate."""

import json
from pathlib import Path

from reed_tools import folders, streams
from reed_tools.engine import options as engine_options
from reed_tools.errors import UsageError
from reed_tools.map import grid, measured
from reed_tools.record.whole_file import write_text
from reed_tools.run import in_memory

FILE, PICTURE = "map.json", "map.png"
MOST_STEPS = 50
EXAMPLE = """examples:
  tools/reed map press_known --only delay              # the arm under 0 to 5 ms of delay in both directions
  tools/reed map free_motion --axis link.command_delay_s=0:0.02:21"""


def add_arguments(parser) -> None:
    parser.add_argument("scenario", nargs="?", default="press_known", metavar="SCENARIO", help="a name in config/scenarios or a path; default %(default)s")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--only", action="append", choices=list(grid.standard(2)), help="this map of the four; repeatable")
    which.add_argument("--axis", action="append", metavar="KEY=FROM:TO:N", help="a map over this key instead, or over two")
    parser.add_argument("--steps", type=int, default=11, metavar="N", help="values on each axis of the four maps; default %(default)s")
    parser.add_argument("--set", action="append", default=[], metavar="SECTION.KEY=VALUE", help="fixed in every run; repeatable")
    parser.add_argument("--seed", type=int, metavar="N", help="of every run; default: the scenario's")
    engine_options.add_arguments(parser)
    parser.add_argument("--out", type=folders.argument, metavar="DIR", help=f"folder for {FILE} and {PICTURE}; default out/<time>-map-<scenario>")
    parser.add_argument("--json", action="store_true", help=f"print the content of {FILE}, the rest on standard error")


def run(arguments) -> int:
    if not 2 <= arguments.steps <= MOST_STEPS:
        raise UsageError(f"--steps {arguments.steps}: allowed: a whole number from 2 to {MOST_STEPS}")
    if arguments.seed is not None and arguments.seed < 0:
        raise UsageError(f"--seed {arguments.seed}: allowed: 0 and more")
    engine_options.check(arguments)
    four = grid.standard(arguments.steps)
    grids = [grid.own(arguments.axis)] if arguments.axis else [four[name] for name in arguments.only or four]
    fixed = [*arguments.set, *([f"scenario.seed={arguments.seed}"] if arguments.seed is not None else [])]
    nominal = measured.nominal_run(arguments.scenario, fixed)
    if arguments.axis:
        measured.refuse_bad_key(arguments.scenario, fixed, grids[0])
    folder = folders.fresh(arguments.out, f"map-{Path(arguments.scenario).stem}", (FILE, PICTURE), "a map already")
    with streams.result_alone(arguments.json):
        maps = measured.measure(arguments, grids, fixed, nominal)
        result = {"scenario": arguments.scenario, "build": in_memory.build(), "nominal": nominal.text(), **maps[0].as_json(),
                  "maps": [one.as_json() for one in maps]}
        write_text(folder / FILE, json.dumps(result, indent=1, allow_nan=False) + "\n")
        from reed_tools.map import borders, picture

        picture.draw(arguments.scenario, maps, folder / PICTURE)
        borders.show(arguments.scenario, maps)
        print(f"written {folder / FILE} and {folder / PICTURE}")
    if arguments.json:
        print(json.dumps(result))
    return 0
