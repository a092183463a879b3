"""tools/reed worst: the worst case of a campaign, found by search, reduced to what it needs, and kept for the tests."""

import functools
import json
import math
from pathlib import Path

from reed_tools import folders, streams
from reed_tools.campaign import definition, one_draw
from reed_tools.campaign.definition import MOST_DRAWS, Campaign
from reed_tools.engine import options as engine_options
from reed_tools.engine.engine import Engine
from reed_tools.errors import RunError, UsageError
from reed_tools.run import in_memory
from reed_tools.worst import cases, judged
from reed_tools.worst.search import Case, Found, search
from reed_tools.worst.shrink import shrink
from reed_tools.worst.space import Point, Space

FILE = "worst.json"
LEAST_RUNS = 4
EXAMPLE = """examples:
  tools/reed worst press_known --runs 200              # as many runs as the campaign has draws
  tools/reed worst --seed 2 --no-keep                  # another search, without adding to the tests' file of cases"""


def add_arguments(parser) -> None:
    parser.add_argument("campaign", nargs="?", metavar="CAMPAIGN", help="a name in config/campaigns or a path; default press_known")
    parser.add_argument("--runs", type=int, metavar="N", help="runs of the search, at most; default: the campaign's number of draws")
    parser.add_argument("--seed", type=int, metavar="N", help="of the search; default: the campaign's")
    parser.add_argument("--set", action="append", metavar="SECTION.KEY=VALUE", help="fixed in every run; repeatable")
    engine_options.add_arguments(parser)
    parser.add_argument("--out", type=folders.argument, metavar="DIR", help="folder; default out/<time>-worst-<name>")
    kept = parser.add_mutually_exclusive_group()
    kept.add_argument("--cases", type=folders.argument, default=cases.FILE, metavar="FILE", help="where the case is added; default tests/data/worst_cases.jsonl")
    kept.add_argument("--no-keep", action="store_true", help="add the case to no file")
    parser.add_argument("--json", action="store_true", help="print the content of worst.json, the rest on standard error")


def run(arguments) -> int:
    if arguments.runs is not None and not LEAST_RUNS <= arguments.runs <= MOST_DRAWS:
        raise UsageError(f"--runs {arguments.runs}: allowed: a whole number from {LEAST_RUNS} to {MOST_DRAWS}")
    engine_options.check(arguments)
    campaign = definition.load(definition.find(arguments.campaign or "press_known"), arguments.seed, tuple(arguments.set or []))
    space = Space(campaign)
    one_draw.known_to_figures(campaign, list(campaign.fixed))  # a wrong key is a line before the workers start
    if not arguments.no_keep:
        cases.read(arguments.cases)
    folder = folders.fresh(arguments.out, f"worst-{campaign.name}", (FILE,), "such a search already; choose another folder")
    with streams.result_alone(arguments.json):
        status, result = look(arguments, campaign, space, folder)
    if arguments.json:
        print(json.dumps({"folder": str(folder), **result}))
    return status


def look(arguments, campaign: Campaign, space: Space, folder: Path) -> tuple[int, dict]:
    runs = arguments.runs or campaign.draws
    print(f"worst case of {campaign.name}: {len(space.axes)} parameters, at most {runs} runs of {campaign.scenario}, "
          f"{engine_options.place(arguments)}", flush=True)
    with Engine(engine_options.jobs(arguments), arguments.scheduler) as engine:
        evaluate = Evaluation(engine, campaign, space)
        found = search(len(space.axes), runs, campaign.seed, evaluate)
        if engine.interrupted or not found.cases:
            raise KeyboardInterrupt
        worst = found.worst
        if worst.ratio == -math.inf:
            raise RunError(f"every run was refused: {worst.result.record.message}")
        print("  without what it does not need", flush=True)
        worst, shrunk = shrink(worst, evaluate)
        if engine.interrupted:
            raise KeyboardInterrupt
    result = summary(campaign, space, found, worst, shrunk, evaluate.done)
    (folder / FILE).write_text(json.dumps(result, indent=2, allow_nan=False) + "\n")
    show(space, worst, shrunk, result)
    if not arguments.no_keep:
        case = {"campaign": campaign.name, "scenario": campaign.scenario, "entries": shrunk.result.record.overrides,
                "figure": shrunk.result.aim, "value": shrunk.result.value, "ratio": finite(shrunk.ratio)}
        print(f"{'kept in' if cases.add(arguments.cases, case) else 'already in'} {arguments.cases}")
    print(f"result  {folder / FILE}")
    return (1 if worst.ratio > 1.0 else 0), result


class Evaluation:
    """A generation at a time, in its order whoever runs it."""

    def __init__(self, engine: Engine, campaign: Campaign, space: Space):
        self.engine, self.space, self.done, self.largest = engine, space, 0, -math.inf
        self.one = functools.partial(judged.run, campaign, in_memory.build())

    def __call__(self, points: list[Point]) -> list[Case]:
        items = [(number, self.space.entries(point)) for number, point in enumerate(points)]
        results = {item[0]: result for item, result in self.engine.map(self.one, items)}
        died = next((one.record for one in results.values() if one.record.status == "died"), None)
        if died:
            raise RunError(f"a program died: {died.message}; {judged.Judged(died).line(self.space.campaign.scenario)}")
        self.done += len(results)
        self.largest = max([self.largest, *(one.ratio for one in results.values())])
        print(f"  {self.done:5d} runs, worst ratio {self.largest:.4g}", flush=True)
        return [Case(point, results[number].ratio, results[number]) for number, point in enumerate(points) if number in results]


def finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def described(campaign: Campaign, case: Case) -> dict:
    return {"ratio": finite(case.ratio), "figure": case.result.aim, "what": case.result.text(), "command": case.result.line(campaign.scenario),
            "digest": case.result.record.digest}


def summary(campaign: Campaign, space: Space, found: Found, worst: Case, shrunk: Case, done: int) -> dict:
    """A ratio that is null: the run ended in a fault, or a limit of 0 is broken."""
    return {"campaign": campaign.name, "scenario": campaign.scenario, "seed": campaign.seed, "build": worst.result.record.build,
            "runs": len(found.cases), "generations": found.generations, "runs_to_shrink": done - len(found.cases),
            "refused": sum(case.ratio == -math.inf for case in found.cases), **described(campaign, worst),
            "shrunk": {**described(campaign, shrunk), "parameters": needed(space, shrunk)}}


def needed(space: Space, case: Case) -> list[str]:
    return [axis.name for axis, u in zip(space.axes, case.point) if u is not None]


def show(space: Space, worst: Case, shrunk: Case, result: dict) -> None:
    print(f"worst   {worst.ratio:.4g} times its limit: {worst.result.text()}; digest {result['digest'][:16]}\n  {result['command']}")
    print(f"reduced to {', '.join(needed(space, shrunk)) or 'nothing that was drawn'}: {shrunk.ratio:.4g} times its limit: {shrunk.result.text()}; "
          f"digest {result['shrunk']['digest'][:16]}\n  {result['shrunk']['command']}")
