"""tools/reed arm import | export | check | show: arm files from and to URDF, judged, drawn."""

import argparse
import json
import re

from reed_tools import folders
from reed_tools.errors import UsageError
from reed_tools.record.whole_file import require_new, write_new
from reed_tools.text import plain

EXAMPLE = """examples:
  tools/reed arm import ROBOT.urdf --tip tool0 --out robot.toml   # from a URDF; what it does not say is marked # assumed
  tools/reed arm check robot.toml                                 # inertias, units, limits, resonances
  tools/reed arm show a5 --out a5.png                             # with its frames, and bent by its weight
  tools/reed arm export a5 --out a5.urdf                          # back to URDF"""


def add_arguments(parser) -> None:
    verbs = parser.add_subparsers(dest="verb", metavar="import|export|check|show", required=True)

    def verb(name: str, text: str):
        found = verbs.add_parser(name, help=text, description=text + ".", epilog=parser.epilog, formatter_class=argparse.RawDescriptionHelpFormatter)
        return found

    taken = verb("import", "an arm file from a URDF: chain, links, limits, friction; the rest by rule, marked as assumed")
    taken.add_argument("urdf", metavar="ROBOT.urdf", type=folders.argument)
    taken.add_argument("--out", required=True, metavar="FILE.toml", type=folders.argument, help="the arm file; nothing is overwritten")
    taken.add_argument("--base", metavar="LINK", help="first link of the chain; default the root")
    taken.add_argument("--tip", metavar="LINK", help="last link, whose origin is the tool point; needed where there are several")
    taken.add_argument("--limit", action="append", default=[], metavar="JOINT=LOWER,UPPER[,EFFORT,SPEED]",
                       help="limits that the URDF does not have (rad, N·m, rad/s), as those of continuous joints; repeatable")
    taken.add_argument("--rigid", action="store_true", help="leave the links rigid; default: tubes from joint to joint, by rule and marked as assumed")
    taken.add_argument("--json", action="store_true", help="print {arm, file, dof, base, tip, held}")
    given = verb("export", "a URDF from an arm file, with its nominal links")
    given.add_argument("arm", metavar="NAME|FILE")
    given.add_argument("--out", required=True, metavar="F.urdf", type=folders.argument, help="the URDF; nothing is overwritten")
    judged = verb("check", "an arm file judged: inertias, units by magnitude, limits, resonances against the rate")
    judged.add_argument("arm", metavar="NAME|FILE")
    judged.add_argument("--rate", type=float, default=1000.0, metavar="HZ", help="of the control loop; default %(default)g")
    judged.add_argument("--json", action="store_true", help="print {arm, dof, mass_kg, reach_m, warnings, modes_hz}")
    drawn = verb("show", "a picture of an arm: its frames, and the arm bent by its weight where links bend")
    drawn.add_argument("arm", metavar="NAME|FILE")
    drawn.add_argument("--at", metavar="Q1,Q2,...", help="the pose, rad; default the middle of every range")
    drawn.add_argument("--out", metavar="FILE", type=folders.argument, help="the PNG; default arm-NAME.png")


def run(arguments) -> int:
    return {"import": take, "export": give, "check": check, "show": show}[arguments.verb](arguments)


def take(arguments) -> int:
    from reed_tools.arms import arm_file, serial, urdf

    target = arguments.out
    require_new("--out", target)
    robot = urdf.read(arguments.urdf)
    found = serial.serial_of(robot, arguments.base, arguments.tip, limits_of(arguments.limit))
    name = re.sub(r"[^A-Za-z0-9_.-]", "_", robot.name)
    write_new("--out", target, arm_file.text_of(found, name, plain(arguments.urdf.name), arguments.rigid))
    if arguments.json:
        print(json.dumps({"arm": name, "file": str(target), "dof": len(found.joints), "base": found.base, "tip": found.tip, "held": found.held}))
        return 0
    held = f"; held at 0: {', '.join(found.held)}" if found.held else ""
    print(f"written {target}: {name}, {len(found.joints)} joints from {found.base} to {found.tip}{held}; what was assumed is marked in it")
    return 0


def limits_of(entries: list[str]) -> dict[str, list[float]]:
    found = {}
    for entry in entries:
        joint, _, text = entry.partition("=")
        try:
            values = [float(word) for word in text.split(",")]
        except ValueError:
            values = []
        if len(values) not in (2, 4):
            raise UsageError(f"--limit {entry}: allowed: JOINT=LOWER,UPPER or JOINT=LOWER,UPPER,EFFORT,SPEED, numbers in rad, N·m and rad/s")
        found[joint] = values
    return found


def give(arguments) -> int:
    from reed_tools.arms import export_urdf
    from reed_tools.robots import nominal

    target = arguments.out
    require_new("--out", target)
    table = nominal.read(nominal.path_of(arguments.arm))
    arm = nominal.load(arguments.arm)
    write_new("--out", target, export_urdf.urdf_of(arm, table))
    print(f"written {target}")
    return 0


def check(arguments) -> int:
    from reed_tools.arms import check as judge

    found = judge.judge(arguments.arm, arguments.rate)
    if arguments.json:
        print(json.dumps(found, allow_nan=False))
    else:
        modes = ", ".join(f"{mode:.1f}" for mode in found["modes_hz"]) or "none known"
        print(f"{found['arm']}: {found['dof']} joints, {found['mass_kg']:.3g} kg, reach {found['reach_m']:.3g} m, modes with locked motors {modes} Hz")
        for warning in found["warnings"]:
            print(f"warning: {warning}")
    return 1 if found["warnings"] else 0


def show(arguments) -> int:
    from reed_tools.arms import picture

    print(f"written {picture.draw(arguments.arm, arguments.at, arguments.out)}")
    return 0
