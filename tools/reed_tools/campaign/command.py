"""tools/reed campaign: many lockstep runs of one scenario with drawn numbers, and whether all of them hold."""

import functools
import json
import shlex
import shutil
import tempfile
from pathlib import Path

from reed_tools import folders, streams
from reed_tools.campaign import definition, draws, junit, one_draw, verdicts
from reed_tools.campaign.definition import LARGEST, MOST_DRAWS, Campaign
from reed_tools.engine import options as engine_options
from reed_tools.engine import progress
from reed_tools.engine.engine import Engine
from reed_tools.errors import RunError, UsageError
from reed_tools.run import in_memory, scenario

OPTIONS = "options.json"  # of the folder: what --resume goes on with
OWN_FILES = ("campaign.toml", OPTIONS, draws.FILE, "summary.json", junit.FILE, "campaign.html", "distributions.png", "causes.png")
MOST_REPEATS = 1000
WHOLE = {"draws": (1, MOST_DRAWS), "first": (0, MOST_DRAWS), "count": (1, MOST_DRAWS), "repeat": (0, MOST_REPEATS)}
SELECTION = ("draws", "first", "count")
EXAMPLE = """examples:
  tools/reed campaign press_known --draws 20           # how good and how bad it gets
  tools/reed campaign --resume out/CAMPAIGN            # goes on where it was interrupted"""


def add_arguments(parser) -> None:
    parser.add_argument("campaign", nargs="?", metavar="CAMPAIGN", help="a name in config/campaigns or a path; default press_known")
    parser.add_argument("--draws", type=int, metavar="N", help="draws 0 to N-1; default: the campaign's number")
    parser.add_argument("--from", dest="first", type=int, metavar="I", help="only draws from number I on")
    parser.add_argument("--count", type=int, metavar="K", help="only K draws")
    parser.add_argument("--seed", type=int, metavar="N", help="campaign seed; a draw follows from it and the draw's number")
    parser.add_argument("--set", action="append", metavar="SECTION.KEY=VALUE", help="override in every draw; repeatable")
    engine_options.add_arguments(parser)
    parser.add_argument("--repeat", type=int, default=2, metavar="K", help="run the K worst draws twice and compare; default %(default)s")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--out", type=folders.argument, metavar="DIR", help="folder; default out/<time>-campaign-<name>")
    where.add_argument("--resume", type=folders.argument, metavar="DIR", help="go on with the campaign in DIR: finished draws are kept")
    parser.add_argument("--json", action="store_true", help="print the content of summary.json, the rest on standard error")


def run(arguments) -> int:
    for option, (least, most) in WHOLE.items():
        value = getattr(arguments, option)
        if value is not None and not least <= value <= most:
            raise UsageError(f"--{'from' if option == 'first' else option} {value}: allowed: a whole number from {least} to {most}")
    engine_options.check(arguments)
    folder, campaign, indices = resumed(arguments) if arguments.resume else begun(arguments)
    with streams.result_alone(arguments.json):
        status = run_draws(arguments, folder, campaign, indices)
    if arguments.json:
        print(json.dumps({"folder": str(folder), **json.loads((folder / "summary.json").read_text(encoding="utf-8"))}))
    return status


def run_draws(arguments, folder: Path, campaign: Campaign, indices: list[int]) -> int:
    finished = {record.index: record for record in draws.read(folder, campaign.definition())}
    pending = [index for index in indices if index not in finished]
    print(f"campaign {campaign.name}: {len(indices)} draws of {campaign.scenario}, {len(pending)} to run, "
          f"{engine_options.place(arguments)}", flush=True)
    build = in_memory.build()
    repeats, interrupted = [], False
    if pending or arguments.repeat:
        refuse_early(campaign, indices[0])
        with Engine(min(engine_options.jobs(arguments), max(len(pending), arguments.repeat)), arguments.scheduler) as engine:
            one = functools.partial(one_draw.run_draw, campaign, build)
            run_pending(engine, one, folder, campaign, pending, finished)
            records = [finished[index] for index in indices if index in finished]
            repeats = run_again(engine, one, records, arguments.repeat, build)
            interrupted = engine.interrupted
    records = [finished[index] for index in indices if index in finished]
    return conclude(folder, campaign, len(indices), records, repeats, interrupted)


def refuse_early(campaign: Campaign, index: int) -> None:
    """A wrong key is a line before the workers start, and a controller for other joints is built once."""
    try:
        one_draw.known_to_figures(campaign, campaign.overrides(index))
    except UsageError as error:
        raise UsageError(f"draw {index}: {error}") from None


def begun(arguments) -> tuple[Path, Campaign, list[int]]:
    source = definition.find(arguments.campaign or "press_known")
    options = {"seed": arguments.seed, "set": arguments.set or [], **{key: getattr(arguments, key) for key in SELECTION}}
    campaign = definition.load(source, options["seed"], tuple(options["set"]))
    indices = selected(campaign, options)
    folder = folders.fresh(arguments.out, f"campaign-{campaign.name}", OWN_FILES,
                           f"a campaign already; --resume {arguments.out} goes on with it")
    try:
        shutil.copyfile(source, folder / "campaign.toml")
        (folder / OPTIONS).write_text(json.dumps(options, indent=2) + "\n")
    except OSError as error:
        raise UsageError(f"--out {folder}: {error.strerror}") from None
    return folder, campaign, indices


def resumed(arguments) -> tuple[Path, Campaign, list[int]]:
    """Draws are those of the folder's campaign; which of them, may be asked for anew."""
    folder = arguments.resume
    if arguments.campaign or arguments.seed is not None or arguments.set:
        raise UsageError("--resume goes on with the folder's own campaign, seed and --set; leave them out")
    if not (folder / OPTIONS).is_file():
        raise UsageError(f"--resume {folder}: there is no campaign ({OPTIONS} is missing)")
    folders.hold(folder)
    options = read_options(folder / OPTIONS)
    asked = {key: getattr(arguments, key) for key in SELECTION if getattr(arguments, key) is not None}
    if asked:
        options.update({key: asked.get(key) for key in SELECTION})
    campaign = definition.load(folder / "campaign.toml", options["seed"], tuple(options["set"]))
    return folder, campaign, selected(campaign, options)


def read_options(path: Path) -> dict:
    """What begun() wrote, or a line about what is wrong with it."""
    try:
        options = json.loads(path.read_bytes())
        seed, entries = options["seed"], options["set"]
        numbers = [(options[key], *WHOLE[key]) for key in ("draws", "first", "count")]
    except (ValueError, RecursionError, TypeError, KeyError):
        raise UsageError(f"{path}: damaged: it is not what the campaign wrote there") from None
    whole = all(value is None or type(value) is int and least <= value <= most for value, least, most in [*numbers, (seed, 0, LARGEST)])
    if not whole or not isinstance(entries, list) or not all(isinstance(entry, str) for entry in entries):
        raise UsageError(f"{path}: damaged: a value is not of the kind that the campaign wrote there")
    return options


def selected(campaign: Campaign, options: dict) -> list[int]:
    first = options["first"] or 0
    end = first + options["count"] if options["count"] else options["draws"] or campaign.draws
    indices = list(range(first, end))
    if not indices:
        raise UsageError(f"no draw is selected: the draws are 0 to {(options['draws'] or campaign.draws) - 1}, --from {first}")
    return indices


class DrawTally(progress.Tally):
    unit = "draws"

    def __init__(self, total: int):
        super().__init__(total)
        self.unstable = self.outside = 0

    def add(self, record: draws.Record) -> None:
        super().add(record)
        self.unstable += not record.stable
        self.outside += record.stable and not record.within

    def text(self) -> str:
        return f"{self.unstable} not stable, {self.outside} outside limits"


def run_pending(engine: Engine, one, folder: Path, campaign: Campaign, pending: list[int], finished: dict) -> None:
    """Fills `finished` and the folder's file, each draw when it is done."""
    if pending:
        with progress.shown(campaign.name, DrawTally(len(pending))) as on_record:
            for index, record in engine.map(one, pending):
                draws.append(folder, record)
                finished[index] = record
                on_record(record)


def run_again(engine: Engine, one, records: list, count: int, build: str) -> list:
    """The worst draws of this build a second time: equal digests mean equal runs."""
    worst = [record.index for record in draws.worst_first(records) if record.build == build and record.digest][:count]
    return [record for _, record in engine.map(one, worst)]


def arm_of(campaign: Campaign) -> dict:
    with tempfile.TemporaryDirectory() as scratch:
        return scenario.write_effective(campaign.scenario, None, campaign.fixed, Path(scratch, "effective.toml"))["arm"]


def command_of(folder: Path) -> str:
    """The line that runs the folder's campaign again."""
    options = read_options(folder / OPTIONS)
    words = ["tools/reed", "campaign", str(folder / "campaign.toml")]
    for key in ("seed", *SELECTION):
        words += [f"--{'from' if key == 'first' else key}", str(options[key])] if options[key] is not None else []
    return shlex.join([*words, *(word for entry in options["set"] for word in ("--set", entry))])


def conclude(folder: Path, campaign: Campaign, wanted: int, records: list, repeats: list, interrupted: bool) -> int:
    if not records:
        raise UsageError("interrupted before the first draw was done") if interrupted else RunError("no draw came to its end")
    from reed_tools.campaign import page, plots, results, table  # numpy, matplotlib: after the runs

    verdict = verdicts.judge(campaign, records, repeats)
    summary = results.build(campaign, records, wanted, verdict)
    results.write(folder, summary)
    junit.write(folder, campaign, records, verdict)
    pictures = plots.draw_all(folder, campaign, records, arm_of(campaign))
    path = page.write(folder, summary, (folder / "campaign.toml").read_text(), pictures, command_of(folder))
    table.show(summary)
    print(f"report  {path}")
    died = [record for record in records if record.status == "died"]
    if interrupted:
        print(f"interrupted after {len(records)} of {wanted} draws; to go on: tools/reed campaign --resume {folder}")
    if died:
        raise RunError(f"a program died in {len(died)} draws; draw {died[0].index}: {died[0].message}")
    return 0 if verdict.ok and not interrupted else 1
