"""tools/reed tune: gains of a scenario, better ones within the rules, with what each step brought."""

import functools
import json
import tempfile
import tomllib
from pathlib import Path

from reed_tools import folders, streams
from reed_tools.engine import options
from reed_tools.engine.engine import Engine
from reed_tools.errors import RunError, UsageError
from reed_tools.paths import ARMS, SCENARIOS
from reed_tools.record.whole_file import require_new, write_new
from reed_tools.run import in_memory, scenario
from reed_tools.tune import margins, search, trials, write
from reed_tools.tune.gains import Gains, of_effective, text

MOST_DRAWS = 20
EXAMPLE = """examples:
  tools/reed tune press_known --out /tmp/tuned.toml    # better gains of a scenario, as a scenario
  tools/reed tune press_known --draws 1 --json         # for the scenario as it is, without changed walls and springs
  tools/reed tune a7 --out /tmp/a7_free.toml           # of an arm: a free motion is made for it first"""


def add_arguments(parser) -> None:
    parser.add_argument("scenario", metavar="SCENARIO|ARM", help="a name in config/scenarios or config/arms, or a path; a scenario's [[checks]] "
                        "are what is made better, an arm gets a free motion")
    parser.add_argument("--set", action="append", default=[], metavar="SECTION.KEY=VALUE", help="override in every run; repeatable")
    parser.add_argument("--draws", type=int, default=3, metavar="N", help="runs that judge one candidate: the scenario, then with other "
                        "walls, springs and frictions; default %(default)s")
    parser.add_argument("--out", type=folders.argument, metavar="F.toml", help="write the scenario with the gains that were found")
    parser.add_argument("--json", action="store_true", help="print the result as JSON, the rest on standard error")
    options.add_arguments(parser)


def run(arguments) -> int:
    options.check(arguments)
    if not 1 <= arguments.draws <= MOST_DRAWS:
        raise UsageError(f"--draws {arguments.draws}: allowed: a whole number from 1 to {MOST_DRAWS}")
    if arguments.out:
        require_new("--out", arguments.out)
    with streams.result_alone(arguments.json), tempfile.TemporaryDirectory(prefix="reed-tune-") as scratch:
        source = source_of(arguments.scenario, Path(scratch))
        first, best, steps = tuned(arguments, source, Path(scratch))
        show(first, best, arguments, source)
    if arguments.json:
        print(json.dumps({"scenario": arguments.scenario, "score": {"before": first.trial.score, "after": best.trial.score},
                          "margin": {"gain": best.margin.gain, "phase_deg": best.margin.phase_deg}, "gains": dict(best.gains.values),
                          "before": dict(first.gains.values),
                          "steps": [{"step": step.what, "score": step.trial.score, "taken": step.taken, "refused": step.refused,
                                     "gain_margin": step.margin.gain, "phase_margin_deg": step.margin.phase_deg} for step in steps]}))
    return 0 if best.trial.worst[1] <= 1.0 else 1


def source_of(named: str, scratch: Path) -> Path:
    """The scenario's file; of an arm a scenario that is made for it."""
    path = Path(named)
    by_path = "/" in named or named.endswith(".toml")
    if not by_path:
        path = SCENARIOS / f"{named}.toml"
    if path.is_file() and not (by_path and is_arm(path)):
        return path
    arm = path if by_path else ARMS / f"{named}.toml"
    if not arm.is_file():
        known = ", ".join(sorted(file.stem for folder in (SCENARIOS, ARMS) for file in folder.glob("*.toml")))
        raise UsageError(f"tune {named}: no such scenario or arm; allowed: a path, or one of {known}")
    from reed_tools.robots import nominal
    from reed_tools.scenarios import new

    made = scratch / f"free_{arm.stem}.toml"
    made.write_text(new.free(nominal.load(str(arm)), str(arm.resolve()) if by_path else named), encoding="utf-8")
    return made


def is_arm(path: Path) -> bool:
    try:
        found = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False   # the reader of scenarios says what is wrong
    return "arm" not in found and ("joint" in found or "dh" in found)


def tuned(arguments, source: Path, scratch: Path) -> tuple[search.Step, search.Step, list[search.Step]]:
    effective = scenario.write_effective(str(source), None, arguments.set, scratch / "effective.toml")
    start = of_effective(effective)
    draws = trials.draws(effective, arguments.draws)
    function = functools.partial(trials.run, str(source), in_memory.build())
    steps: list[search.Step] = []
    with Engine(options.jobs(arguments), arguments.scheduler) as engine:
        def margin_of(gains: Gains) -> margins.Margin:
            return margins.of(str(source), [*arguments.set, *gains.entries()])

        def judge(candidates: list[Gains]) -> list[trials.Trial]:
            items = [trials.Item(number, at, (*arguments.set, *gains.entries()), tuple(draw))
                     for number, gains in enumerate(candidates) for at, draw in enumerate(draws)]
            found = {(item.candidate, item.draw): record for item, record in engine.map(function, items)}
            if engine.interrupted or len(found) < len(items):
                raise RunError("interrupted; nothing was written")
            return [trials.judge([found[number, at] for at in range(len(draws))]) for number in range(len(candidates))]

        def told(step: search.Step) -> None:
            steps.append(step)
            print(line(step), flush=True)

        print(f"tune {arguments.scenario}: {len(draws)} runs judge a candidate, {options.place(arguments)}; 1: a figure is at its limit", flush=True)
        first = search.Step("as it is", start, margin_of(start), judge([start])[0], True, 0)
        told(first)
        best = search.improve(first, margin_of, judge, told)
    if not search.usable(best.trial):
        raise UsageError(f"tune {arguments.scenario}: with no gains within the rules does it run as it should: {best.trial.why}")
    return first, best, steps


def line(step: search.Step) -> str:
    margin = f"gain margin {step.margin.gain:4.2f}, phase margin {step.margin.phase_deg:3.0f} degrees"
    refused = f"; {step.refused} beyond a rule" if step.refused else ""
    outcome = f"{step.trial.score:6.3f}  worst {step.trial.worst[0]} {step.trial.worst[1]:.2f}" if search.usable(step.trial) else f"   inf  {step.trial.why}"
    return f"  {step.what:30}{margin}  score {outcome}{refused}"


def show(first: search.Step, best: search.Step, arguments, source: Path) -> None:
    from reed_tools.show.tables import console, grid

    table = grid(f"gains of {arguments.scenario}", "gain", "before", "after")
    for (key, before), (_, after) in zip(first.gains.values, best.gains.values):
        table.add_row(key, text(before), text(after))
    console().print(table)
    if arguments.out:
        write_new("--out", arguments.out, write.with_gains(source.read_text(encoding="utf-8"), best.gains))
        print(f"written {arguments.out}: tools/reed run {arguments.out}")
