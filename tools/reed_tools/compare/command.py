"""tools/reed compare RUN RUN…: two or more runs, or campaigns, beside each other; differences first."""

import json
from pathlib import Path

from reed_tools import folders
from reed_tools.compare import figures
from reed_tools.errors import UsageError
from reed_tools.figures import summary
from reed_tools.record import configuration, run_folder
from reed_tools.record.telemetry_log import load
from reed_tools.show import tables
from reed_tools.text import plain

PAGE, CURVES = OWN_FILES = "compare.html", "curves.png"
MOST_ROWS = 60  # on the terminal; page and --json have all
EXAMPLE = """examples:
  tools/reed compare out/RUN out/OTHER                 # what differs, and the curves on common axes
  tools/reed compare out/RUN out/OTHER --json          # the differences alone"""


def add_arguments(parser) -> None:
    parser.add_argument("folders", nargs="+", metavar="RUN", type=folders.argument, help="folders of runs, or of campaigns: two or more")
    parser.add_argument("--json", action="store_true", help="print {runs, differences: [{figure, values}]} and write no page")
    parser.add_argument("--out", metavar="DIR", type=folders.argument, help="folder of the page; default out/<time>-compare")


def run(arguments) -> int:
    if len(arguments.folders) < 2:
        raise UsageError("compare: two or more folders are needed")
    kinds = [kind_of(folder) for folder in arguments.folders]
    if len(set(kinds)) > 1:
        raise UsageError(f"compare: {arguments.folders[0]} is a {kinds[0]}, another folder is not; runs go with runs, campaigns with campaigns")
    read = [read_run(folder) if kinds[0] == "run" else read_campaign(folder) for folder in arguments.folders]
    summaries, found_figures, signals = zip(*read)
    names = labels(arguments.folders)
    found = figures.differences(list(found_figures), repeatable=all(one.get("clock", "lockstep") == "lockstep" for one in summaries))
    if arguments.json:
        print(json.dumps({"runs": [str(folder) for folder in arguments.folders],
                          "differences": [{"figure": entry.figure, "values": entry.values} for entry in found]}, allow_nan=False))
        return 0
    show(names, found)
    print(f"page  {write_page(arguments, names, found, summaries, signals)}")
    return 0


def kind_of(folder: Path) -> str:
    if (folder / run_folder.CONFIGURATION).is_file() and run_folder.logs(folder):
        return "run"
    if (folder / "summary.json").is_file() and (folder / "campaign.toml").is_file():
        return "campaign"
    raise UsageError(f"{folder} is neither a run nor a campaign: it has no {run_folder.CONFIGURATION} with its telemetry, and no campaign.toml")


def read_run(folder: Path) -> tuple[dict, dict, object]:
    run_folder.require_unchanged(folder)
    found, signals = summary.build(folder, load(*run_folder.logs(folder)))
    return found, figures.of_run(found, configuration.load(folder / run_folder.CONFIGURATION)), signals


def read_campaign(folder: Path) -> tuple[dict, dict, None]:
    path = folder / "summary.json"
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise UsageError(f"{path}: {error}") from None
    if not isinstance(found, dict) or "campaign" not in found:
        raise UsageError(f"{path}: is not the summary of a campaign")
    return found, figures.of_campaign(found), None


def labels(folders: list[Path]) -> list[str]:
    """The folders' own names where they differ."""
    short = [folder.resolve().name for folder in folders]
    return short if len(set(short)) == len(short) else [str(folder) for folder in folders]


def show(names: list[str], found: list[figures.Difference]) -> None:
    out = tables.console()
    grid = tables.grid("differences", "figure", *map(plain, names))
    for entry in found[:MOST_ROWS]:
        grid.add_row(plain(entry.figure), *(plain(figures.in_short(value)) for value in entry.values))
    out.print(grid if found else "no figure differs")
    if len(found) > MOST_ROWS:
        out.print(f"{len(found) - MOST_ROWS} more are on the page")


def write_page(arguments, names, found, summaries, signals) -> Path:
    from reed_tools.compare import page

    folder = folders.fresh(arguments.out, "compare", OWN_FILES, "a comparison already; remove it or choose another folder")
    drawn = [(name, one) for name, one in zip(names, signals) if one is not None]
    curves = None
    if drawn:
        from reed_tools.compare.curves import draw

        curves = draw(folder / CURVES, drawn)
    return page.write(folder / PAGE, names, found, list(summaries), curves, arguments.folders)
