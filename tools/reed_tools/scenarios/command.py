"""tools/reed scenario new: a scenario for an arm, which runs at once."""

import argparse

from reed_tools import folders
from reed_tools.errors import UsageError
from reed_tools.record.whole_file import require_new, write_new

LEAST_N, MOST_N = 0.5, 500.0
EXAMPLE = """examples:
  tools/reed scenario new --arm a5 --press 8 --out press_a5.toml     # press 8 N on a floor, sliding along it
  tools/reed scenario new --arm robot.toml --free --out free.toml    # a motion in free space
  tools/reed run press_a5.toml"""


def add_arguments(parser) -> None:
    verbs = parser.add_subparsers(dest="verb", metavar="new", required=True)
    made = verbs.add_parser("new", help="a scenario that runs at once and is meant to be edited", formatter_class=argparse.RawDescriptionHelpFormatter,
                            description="A start pose away from singularities, a wall in reach, a slide within limits, gains by rule, checks.")
    made.add_argument("--arm", required=True, metavar="NAME|FILE")
    what = made.add_mutually_exclusive_group(required=True)
    what.add_argument("--press", type=float, metavar="N", help="press with that force, in newton, on a floor that is 1 mm lower than believed")
    what.add_argument("--free", action="store_true", help="move in free space")
    made.add_argument("--out", required=True, metavar="F.toml", type=folders.argument, help="the scenario; nothing is overwritten")
    made.epilog = parser.epilog


def run(arguments) -> int:
    from reed_tools.robots import nominal  # what counts with arrays: not for the options
    from reed_tools.scenarios import new

    if arguments.press is not None and not LEAST_N <= arguments.press <= MOST_N:
        raise UsageError(f"--press {arguments.press:g}: allowed: {LEAST_N:g} ... {MOST_N:g} N")
    require_new("--out", arguments.out)
    arm = nominal.load(arguments.arm)
    arm_file = nominal.for_file(arguments.arm)
    text = new.free(arm, arm_file) if arguments.free else new.press(arm, arm_file, arguments.press)
    write_new("--out", arguments.out, text)
    print(f"written {arguments.out}; run it with `tools/reed run {arguments.out}`")
    return 0
