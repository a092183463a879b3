"""tools/reed budget --law LIB.so: the loop's proofs for one law from outside, each broken promise with the function that broke it."""

import json
import subprocess

from reed_tools.bench import callgrind, programs
from reed_tools.errors import UsageError
from reed_tools.law import choice
from reed_tools.paths import program

PROGRAM = "reed_law_budget"
SYSTEM_CALLS = {"0": "read", "1": "write", "9": "mmap", "12": "brk", "35": "nanosleep", "202": "futex", "228": "clock_gettime",
                "230": "clock_nanosleep", "257": "openat", "318": "getrandom"}  # x86-64
PROMISES = {"exceptions": "throws nothing and does not end the process", "finite": "answers finite torques",
            "heap": "never allocates", "page_faults": "touches no new memory", "system_calls": "makes no system call"}
EXAMPLE = "example: tools/reed budget --law build/own_law/libown_law.so"


def add_arguments(parser) -> None:
    parser.add_argument("--law", required=True, metavar="LIB.so", help="a shared library with the functions of reed/law.h")
    parser.add_argument("--json", action="store_true", help="print the figures as JSON")
    parser.add_argument("--no-pinocchio", action="store_true", help="do not build and time the step put together from Pinocchio")


def run(arguments) -> int:
    law = choice.choose(arguments.law, "wall")
    programs.build(PROGRAM)
    found = prove(law.spec)
    whole = "time" in found
    if whole and callgrind.available():
        counted = callgrind.count(program(PROGRAM), law.spec)["step"]
        found["instructions"] = {"worst": counted.worst, "mean": counted.mean}
    if whole and not arguments.no_pinocchio and programs.build_pinocchio() is None:
        found["time"]["pinocchio_median_ns"] = programs.nanoseconds("reed_bench_pinocchio", 1)["step_a5"]["median_ns"]
    broken = [name for name in PROMISES if found.get(name, {"broken": 1})["broken"]]
    if arguments.json:
        print(json.dumps({**found, "broken": broken}, indent=2))
    else:
        print("\n".join(lines(found)))
    return 1 if broken else 0


def prove(spec: str) -> dict[str, dict]:
    """Each proof by its name. An exception or a torque that is no number ends the rest."""
    done = subprocess.run([str(program(PROGRAM)), spec], capture_output=True, text=True, timeout=600)
    if done.returncode:
        raise UsageError((done.stderr.strip().splitlines() or [f"{PROGRAM} ended with status {done.returncode}"])[-1].removeprefix(f"{PROGRAM}: "))
    rows = [json.loads(line) for line in done.stdout.splitlines()]
    return {row.pop("proof"): row for row in rows}


def lines(found: dict[str, dict]) -> list[str]:
    out = [line_of(name, promise, found[name]) for name, promise in PROMISES.items() if name in found]
    if "time" not in found:
        return [*out, "the other proofs were not made: the law does not run"]
    time = found["time"]
    out.append(f"  step of a5  median {time['median_ns']:.0f} ns, worst {time['worst_ns']:.0f} ns; built-in law {time['built_in_median_ns']:.0f} "
               f"and {time['built_in_worst_ns']:.0f} ns" + (f"; put together from Pinocchio {time['pinocchio_median_ns']:.0f} ns (median)"
                                                         if "pinocchio_median_ns" in time else ""))
    if "instructions" in found:
        out.append(f"  instructions of the step: worst {found['instructions']['worst']}, mean {found['instructions']['mean']:.0f}")
    return out


def line_of(name: str, promise: str, proof: dict) -> str:
    if not proof["broken"]:
        return f"  holds   {promise}"
    what = proof["what"]
    if name == "system_calls":
        number = what.rpartition(" ")[2]
        what = f"system call {SYSTEM_CALLS.get(number, number)}"
    elif name in ("heap", "page_faults", "finite"):
        what = f"{proof['broken']} {what}"
    return f"  BROKEN  {promise}: {what}{' in ' + proof['where'] if proof['where'] else ''}"
