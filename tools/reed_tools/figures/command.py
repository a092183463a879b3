"""tools/reed report RUN_DIR: figures, plots and page from what a run folder holds."""

from reed_tools import folders
from reed_tools.errors import UsageError
from reed_tools.figures import result_table
from reed_tools.figures.evaluate import evaluate
from reed_tools.record.telemetry_log import require_whole


def add_arguments(parser) -> None:
    parser.add_argument("run_dir", metavar="RUN_DIR", type=folders.argument, help="a folder that tools/reed run wrote")


def run(arguments) -> int:
    folder = arguments.run_dir
    for name in ("effective.toml", "telemetry.lcmlog"):
        if not (folder / name).is_file():
            raise UsageError(f"{folder} is not a run folder: it has no {name}")
    require_whole(folder / "telemetry.lcmlog")
    summary = evaluate(folder)
    result_table.show(summary)
    print(f"report  {folder / 'report.html'}")
    return 0 if summary["verdict"] == "pass" else 1
