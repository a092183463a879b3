"""tools/reed report RUN_DIR: figures, plots and page from what a run folder holds."""

from reed_tools import folders, streams
from reed_tools.errors import RunError, UsageError
from reed_tools.figures import result_table
from reed_tools.figures.evaluate import evaluate
from reed_tools.record import run_folder

EXAMPLE = """examples:
  tools/reed report out/RUN                            # figures, plots and page again
  tools/reed report out/RUN --json                     # the figures alone"""


def add_arguments(parser) -> None:
    parser.add_argument("run_dir", metavar="RUN_DIR", type=folders.argument, help="a folder that tools/reed run wrote, also one whose run was cut short")
    parser.add_argument("--json", action="store_true", help="print the content of summary.json and its folder, the rest on standard error")


def run(arguments) -> int:
    folder = arguments.run_dir
    for name, there in ((run_folder.CONFIGURATION, (folder / run_folder.CONFIGURATION).is_file()), (run_folder.TELEMETRY, run_folder.logs(folder))):
        if not there:
            raise UsageError(f"{folder} is not a run folder: it has no {name}")
    run_folder.require_ended(folder)
    problem = run_folder.complete(folder)
    run_folder.require_unchanged(folder)
    with streams.result_alone(arguments.json):
        summary, unwritten = evaluate(folder)
        result_table.show(summary)
        if problem := problem or unwritten:
            raise RunError(problem)
        print(f"report  {folder / 'report.html'}")
    if arguments.json:
        print(run_folder.as_json(folder))
    return 0 if summary["verdict"] == "pass" else 1
