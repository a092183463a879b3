"""tools/reed identify: inertial parameters and friction of an arm from recorded runs, or the motion to record them with."""

import json
from pathlib import Path

import numpy as np

from reed_tools import folders
from reed_tools.errors import UsageError
from reed_tools.identify import least_squares, samples, write
from reed_tools.identify.base import Base, base_of
from reed_tools.identify.feasible import nearest
from reed_tools.identify.structural import Structural, structural
from reed_tools.record.whole_file import require_new, write_text
from reed_tools.robots import nominal
from reed_tools.robots.nominal import NominalArm
from reed_tools.robots.pseudo_inertia import body_parts

CUTOFF_HZ = 8.0
LARGEST_DISTANCE = 3.0  # standard deviations per square root of a parameter: bodies that are further off are reported
EXAMPLE = """examples:
  tools/reed identify --excite a5 --out excite.toml      # a motion to record
  tools/reed run excite.toml --bus memory --out out/excite
  tools/reed identify out/excite --check out/other --write a5_identified.toml
  tools/reed identify bus.candump --arm a5               # frames of a real arm that moved freely"""


def add_arguments(parser) -> None:
    parser.add_argument("runs", nargs="*", metavar="RUN_DIR|CANDUMP", type=folders.argument, help="run folders, or candump -L files of a real arm")
    parser.add_argument("--arm", metavar="NAME|FILE", help="the arm's description; needed with a candump, else that of the run")
    parser.add_argument("--check", action="append", default=[], metavar="RUN_DIR|CANDUMP", type=folders.argument,
                        help="a run that is not used: how well its torques are predicted; repeatable")
    parser.add_argument("--cutoff", type=float, default=CUTOFF_HZ, metavar="HZ", help="of the low pass over regressor and torque; default %(default)g")
    parser.add_argument("--write", type=folders.argument, metavar="ARM_OUT.toml", help="the arm file again, with the estimates as p_nom and coulomb_nominal")
    parser.add_argument("--excite", metavar="ARM", help="instead: write a scenario: Fourier series of the joints within limits, with a low condition number")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="with --excite: another motion")
    parser.add_argument("--out", type=folders.argument, metavar="FILE.toml", help="with --excite: where to; default excite_ARM.toml")
    parser.add_argument("--json", action="store_true", help="print {parameters, condition, residual, validation, structural, bodies}")


def run(arguments) -> int:
    if arguments.excite:
        return excite(arguments)
    if not arguments.runs:
        raise UsageError("identify: a run folder or a candump file is needed, or --excite ARM")
    if not 1.0 <= arguments.cutoff <= 50.0:
        raise UsageError(f"--cutoff {arguments.cutoff:g}: allowed: 1 ... 50 Hz")
    if arguments.write:
        require_new("--write", arguments.write)
    for path in (*arguments.runs, *arguments.check):
        if not path.exists():
            raise UsageError(f"{path}: is no run folder and no candump file")
    arm = arm_of(arguments)
    base = base_of(arm)
    names = ", ".join(map(str, arguments.runs))
    stretches = [part for path in arguments.runs for part in read(path, arm)]
    fit = least_squares.solve(stretches, arm, base, arguments.cutoff, names)
    dof = arm.dof
    every, distance = nearest(base.B, fit.estimate, fit.information, arm.inertial, fit.estimate[-2 * dof:])
    estimate = fit.estimate if distance < 1e-4 else base.B @ every
    friction = np.maximum(estimate[-2 * dof:].reshape(2, dof), 0.0)
    validation = [least_squares.read_rows(read(path, arm), arm, friction, arguments.cutoff, str(path)) for path in arguments.check]
    found = structural(arm, base, fit)
    result = as_json(arm, base, fit, estimate, every, found)
    if validation:
        result["validation"] = of_joints(least_squares.percent(least_squares.together(validation), base, estimate))
    if arguments.write:
        source = str(nominal.path_of(arguments.arm)) if arguments.arm else f"the arm of {arguments.runs[0]}"
        text = Path(source).read_text(encoding="utf-8") if arguments.arm else write.arm_text_of_run(arguments.runs[0])
        write.write(arguments.write, write.with_nominal(text, found.p, found.coulomb, source))
    if arguments.json:
        print(json.dumps(result, allow_nan=False))
        return 0
    show(result, base, distance)
    if arguments.write:
        print(f"written {arguments.write}")
    return 0


def arm_of(arguments) -> NominalArm:
    if arguments.arm:
        return nominal.load(arguments.arm)
    if not arguments.runs[0].is_dir():
        raise UsageError(f"{arguments.runs[0]}: frames do not say which arm this is; --arm NAME|FILE does")
    return nominal.of_table(samples.arm_of_run(arguments.runs[0]), str(arguments.runs[0]))


def read(path: Path, arm: NominalArm) -> list[samples.Stretch]:
    found = samples.of_run(path) if path.is_dir() else samples.of_candump(path, arm.dof)
    if any(part.angle.shape[1] != arm.dof for part in found):
        raise UsageError(f"{path}: its arm has {found[0].angle.shape[1]} joints, {arm.name} has {arm.dof}")
    return found


def of_joints(values: np.ndarray) -> dict[str, float]:
    return {f"joint{joint + 1}": round(float(value), 6) for joint, value in enumerate(values)}


def as_json(arm: NominalArm, base: Base, fit: least_squares.Fit, estimate: np.ndarray, every: np.ndarray, found: Structural) -> dict:
    nominal_values = base.B @ np.concatenate([arm.inertial, arm.viscous @ arm.p, arm.coulomb])
    rows = zip(base.names, estimate, fit.sigma, nominal_values, base.units, base.texts, fit.estimate)
    bodies = every[:len(arm.inertial)].reshape(arm.dof, -1)
    return {"arm": arm.name,
            "parameters": [{"name": name, "estimate": float(value), "sigma": float(sigma), "nominal": float(before), "unit": unit,
                            "combination": text, "unconstrained": float(free)} for name, value, sigma, before, unit, text, free in rows],
            "condition": fit.condition, "residual": of_joints(fit.residual), "validation": None,
            "structural": [{"name": name, "estimate": float(value), "sigma": float(sigma), "nominal": float(before)}
                           for name, value, sigma, before in zip(arm.names, found.p, found.sigma, arm.p)],
            "bodies": [body_parts(body) for body in bodies]}


def show(result: dict, base: Base, distance: float) -> None:
    from reed_tools.show import tables

    out = tables.console()
    grid = tables.grid(f"base parameters of {result['arm']}", "parameter", "estimate", "sigma", "nominal", "unit")
    for row in result["parameters"]:
        grid.add_row(row["name"], f"{row['estimate']:.5g}", f"{row['sigma']:.2g}", f"{row['nominal']:.5g}", row["unit"])
    out.print(grid)
    if result["structural"]:
        grid = tables.grid("p of the arm file", "parameter", "estimate", "sigma", "nominal")
        for row in result["structural"]:
            grid.add_row(row["name"], f"{row['estimate']:.4g}", f"{row['sigma']:.2g}", f"{row['nominal']:.4g}")
        out.print(grid)
    if distance > LARGEST_DISTANCE**2 * len(base.names):
        print(f"no bodies have the parameters that fit best; the nearest are {np.sqrt(distance):.3g} standard deviations away: check axes, signs and the arm file")
    print(f"condition number {result['condition']:.3g}")
    for title in ("residual", "validation"):
        if result[title]:
            print(f"{title:<10} {', '.join(f'{joint} {value:.3g} %' for joint, value in result[title].items())} of the torque's rms")


def excite(arguments) -> int:
    from reed_tools.identify import excite as motions

    if arguments.runs:
        raise UsageError("--excite: writes a scenario and takes no run")
    arm = nominal.load(arguments.excite)
    target = arguments.out or Path(f"excite_{arm.name}.toml")
    if target.exists():
        raise UsageError(f"{target} is there already; nothing was overwritten, --out FILE.toml names another")
    text, motion = motions.scenario(arm, nominal.for_file(arguments.excite), arguments.seed)
    write_text(target, text)
    if arguments.json:
        print(json.dumps({"file": str(target), "condition": motion.condition, "duration_s": motion.period_s}))
    else:
        print(f"written {target}: {motion.period_s:g} s, condition number {motion.condition:.1f}; run it with `tools/reed run {target}`")
    return 0
