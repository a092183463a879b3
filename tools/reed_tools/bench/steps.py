"""The control step beside what a user would put together from Pinocchio: time, instructions, growth with the joints."""

import math
import tomllib

from reed_tools.bench import callgrind, programs
from reed_tools.bench.rows import Found, Row
from reed_tools.paths import ROOT, program

PINOCCHIO = "Slotine-Li from Pinocchio"
TORQUE_REGRESSOR = "computeJointTorqueRegressor"
JOINTS, QUICK_JOINTS = (2, 4, 8, 16, 32), (2, 4, 8)
MARGIN = 1.05  # as tests/timing/test_instructions.py


def steps(arguments, _folder) -> Found:
    programs.build("reed_bench_stages", "reed_bench_regressor")
    missing = programs.build_pinocchio()
    ours = programs.nanoseconds("reed_bench_stages", arguments.processes)
    ours |= programs.nanoseconds("reed_bench_regressor", arguments.processes)
    theirs = {} if missing else programs.nanoseconds("reed_bench_pinocchio", arguments.processes)

    def other(stage: str, key: str) -> float | None:
        return theirs[stage][key] if theirs else None

    found = Found(notes=[missing] if missing else [], details={"stages_ns": ours, "pinocchio_ns": theirs})
    found.rows += [Row("control step a5, median", ours["step"]["median_ns"], other("step_a5", "median_ns"), "ns", 0.5, PINOCCHIO)]
    found.add(instructions(bool(theirs)))
    found.rows += [Row(f"regressor {arm} with its kinematics, best", ours[f"regressor_{arm}"]["best_ns"],
                       other(f"torque_regressor_{arm}", "best_ns"), "ns", 0.5, TORQUE_REGRESSOR) for arm in ("a5", "a7")]
    return found


def instructions(compared: bool) -> Found:
    """Exact, and the same on every machine: the mean over the inputs for the comparison, the worst for the budget."""
    if not callgrind.available():
        return Found(notes=[f"valgrind is missing, no instructions: {callgrind.HOW_TO_GET}"])
    ours = callgrind.count(program("reed_bench_stages"))
    theirs = callgrind.count(program("reed_bench_pinocchio")) if compared else {}
    budget = tomllib.loads((ROOT / "bench" / "budget.toml").read_text())["x86_64"]
    found = Found([Row("control step a5, instructions", ours["step"].mean, theirs["step_a5"].mean if theirs else None, "", 0.5, PINOCCHIO)])
    found.notes.append("instructions, worst input / budget: " + ", ".join(
        f"{stage} {ours[stage].worst}/{limit}{'' if ours[stage].worst <= limit * MARGIN else ' TOO MANY'}" for stage, limit in budget.items()))
    found.details = {"instructions": {stage: {"worst": count.worst, "mean": count.mean, "budget": budget.get(stage)}
                                      for stage, count in ours.items()},
                     "pinocchio_instructions": {stage: count.mean for stage, count in theirs.items()}}
    return found


def growth(arguments, _folder) -> Found:
    joints = QUICK_JOINTS if arguments.quick else JOINTS
    programs.build(*(f"reed_bench_growth_{n}" for n in joints))
    missing = programs.build_pinocchio()
    processes = max(2, arguments.processes // 2)
    ours = {n: programs.nanoseconds(f"reed_bench_growth_{n}", processes)[f"step_{n}"]["best_ns"] for n in joints}
    found = Found(details={"growth_ns": {"joints": list(joints), "reed": list(ours.values())}})
    theirs = None
    if missing:
        found.notes.append(f"growth has no other side: {missing}")
    else:
        all_of_them = programs.nanoseconds("reed_bench_pinocchio", processes)
        theirs = {n: all_of_them[f"step_{n}"]["best_ns"] for n in joints}
        found.details["growth_ns"]["pinocchio"] = list(theirs.values())
    found.rows.append(Row(f"growth, {joints[0]} to {joints[-1]} joints: exponent", exponent(ours), exponent(theirs) if theirs else None, "",
                          1.0, PINOCCHIO))
    if theirs:
        found.notes.append("step at " + ", ".join(f"{n} joints {ours[n] / 1e3:.2f} µs, other side {theirs[n] / 1e3:.2f} µs" for n in joints))
    return found


def exponent(times: dict[int, float]) -> float:
    """Slope of the straight line through log time over log joints."""
    x, y = [math.log(n) for n in times], [math.log(t) for t in times.values()]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x)
