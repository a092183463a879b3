"""tools/reed gate BASE [HEAD]: did the controller's behaviour change between two commits, and does one of them say so?"""

import json
import os
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.gate import commits, corpus, kept, quick, trial, versions_built
from reed_tools.show import tables
from reed_tools.text import plain

MOST_ROWS = 40  # on the terminal; --json has all
EXAMPLE = """examples:
  tools/reed gate                     # the commit checked out against the last of main
  tools/reed gate HEAD~1              # the last commit against the one before
  tools/reed gate main my-branch      # a branch, before it is merged
  tools/reed gate v0.2 --only wall    # only tapes and scenarios with this in their names
  tools/reed gate --quick             # this checkout against the digests that the last commit of main keeps: seconds

a commit that is to change behaviour says so in its message: `changes-control: why`, and renews the
digests: tools/reed gate --write"""


def add_arguments(parser) -> None:
    parser.add_argument("base", nargs="?", metavar="BASE", help="commit whose behaviour is the measure; default: the last of main, before HEAD")
    parser.add_argument("head", nargs="?", metavar="HEAD", help="commit that is judged; default: the one checked out")
    parser.add_argument("--only", default="", metavar="TEXT", help="tapes and scenarios with this in their names; coverage is not asserted")
    parser.add_argument("--quick", action="store_true", help=f"this checkout against the digests that BASE keeps in {kept.PATH}; nothing of BASE is built")
    parser.add_argument("--write", action="store_true", help=f"write {kept.PATH} of this checkout")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), metavar="N", help="at the same time; default: one per core")
    parser.add_argument("--json", action="store_true", help="print {base, head, tapes, scenarios, changed: [{tape, signal, first_cycle, largest}], declared}")


def run(arguments) -> int:
    if arguments.jobs < 1:
        raise UsageError(f"--jobs {arguments.jobs}: allowed: 1 or more")
    if arguments.quick or arguments.write:
        return by_kept_digests(arguments)
    base = commits.resolve(arguments.base) if arguments.base else commits.last_of_main()
    if base is None:
        raise UsageError(f"BASE is missing, and {commits.NO_BASE}")
    if arguments.head is None:
        commits.require_clean()
    head = commits.resolve(arguments.head or "HEAD")
    known = corpus.load()
    tapes = [entry for entry in known.tapes if arguments.only in entry.name]
    scenarios = [entry for entry in corpus.scenarios(known.longest_s) if arguments.only in entry.name]
    if not tapes and not scenarios:
        raise UsageError(f"--only {arguments.only}: no tape and no scenario has this in its name; tapes: {', '.join(one.name for one in known.tapes)}")
    joints = joints_of([*tapes, *scenarios], known)
    programs = [versions_built.programs(commit, joints) for commit in (base, head)]
    results = try_all(*programs, tapes, scenarios, arguments.jobs)
    lacking = [] if arguments.only else corpus.lacks([result.recorded for result in results if result.recorded is not None], known.coverage)
    declared = commits.declared(base, head)
    changed = [(result, one) for result in results for one in result.changed]
    if arguments.json:
        print(json.dumps(as_json(base, head, tapes, scenarios, changed, declared, lacking)))
    else:
        show(results, changed, declared, lacking)
    return 1 if lacking or (changed and not declared) else 0


def by_kept_digests(arguments) -> int:
    if arguments.head or arguments.only or (arguments.write and (arguments.base or arguments.quick or arguments.json)):
        raise UsageError("--quick takes BASE, --jobs and --json, and --write takes --jobs: both are of the whole corpus and of this checkout")
    known = corpus.load()
    return quick.write(known, arguments.jobs) if arguments.write else quick.run(known, arguments.base, arguments.jobs, arguments.json)


def joints_of(entries: list[corpus.Entry], known: corpus.Corpus) -> list[int]:
    """No more than they need: each number of joints takes half a minute to compile."""
    found = {entry.joints for entry in entries}
    return sorted(found) if None not in found else known.coverage["joints"]


def try_all(base: Path, head: Path, tapes: list[corpus.Entry], scenarios: list[corpus.Entry], jobs: int) -> list[trial.Result]:
    def one(job) -> trial.Result:
        attempt, entry = job
        with tempfile.TemporaryDirectory(prefix="reed-gate-") as scratch:
            return attempt(base, head, entry, Path(scratch))

    with ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(one, [*((trial.open_loop, entry) for entry in tapes), *((trial.closed_loop, entry) for entry in scenarios)]))


def as_json(base, head, tapes, scenarios, changed, declared, lacking) -> dict:
    return {"base": base, "head": head, "tapes": len(tapes), "scenarios": len(scenarios),
            "changed": [{"tape": result.name, "kind": result.kind, "signal": one.signal, "first_cycle": one.cycle, "largest": one.largest}
                        for result, one in changed], "declared": declared, "not_covered": lacking}


def show(results: list[trial.Result], changed, declared: list[str], lacking: list[str]) -> None:
    counts = {kind: sum(result.kind == kind for result in results) for kind in ("tape", "scenario")}
    said = f"tapes in open loop: {counts['tape']}, scenarios in closed loop: {counts['scenario']}"
    if not changed:
        print(f"same to the bit: {said}")
    else:
        out = tables.console()
        grid = tables.grid("what changed", "run", "loop", "signal", "first cycle", "largest difference")
        for result, one in changed[:MOST_ROWS]:
            grid.add_row(result.name, "open" if result.kind == "tape" else "closed", one.signal, str(one.cycle), tables.number(one.largest))
        out.print(grid)
        if len(changed) > MOST_ROWS:
            print(f"{len(changed) - MOST_ROWS} more: --json has all")
        differing = len({(result.kind, result.name) for result, _ in changed})
        print(f"changed: {differing} of {len(results)} ({said})")
        print("declared: " + "; ".join(map(plain, declared)) if declared else
              "no commit in between says `changes-control: why`: say it in the message, or find the cause")
    if lacking:
        print(f"the tapes do not cover what config/gate/corpus.toml promises: {', '.join(lacking)}")
