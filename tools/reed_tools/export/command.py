"""tools/reed export RUN_DIR --to FORMAT: a run in the formats of other tools."""

import importlib.util
import tempfile
from pathlib import Path

from reed_tools import folders
from reed_tools.errors import RunError, UsageError
from reed_tools.record import configuration, run_folder
from reed_tools.record.telemetry_log import load

TELEMETRY, BUS = ("mcap", "csv", "parquet"), ("asc", "blf", "mf4")
INSTALL = "build/venv/bin/python3 -m pip install"
EXAMPLE = """examples:
  tools/reed export out/RUN --to mcap                  # for Foxglove (layout: docs/foxglove_layout.json) and PlotJuggler
  tools/reed export out/RUN --to csv --out run.csv     # one row per cycle; the events in run-events.csv
  tools/reed export out/RUN --to blf                   # the frames of the bus, for CANoe, SavvyCAN and others"""


def add_arguments(parser) -> None:
    parser.add_argument("run_dir", metavar="RUN_DIR", type=folders.argument, help="a folder that tools/reed run wrote")
    parser.add_argument("--to", required=True, choices=(*TELEMETRY, *BUS), metavar="FORMAT",
                        help="telemetry as mcap, csv or parquet; the bus as asc, blf or mf4")
    parser.add_argument("--out", metavar="F", type=folders.argument, help="file to write; default telemetry.FORMAT or bus.FORMAT in RUN_DIR")


def run(arguments) -> int:
    folder, kind = arguments.run_dir, arguments.to
    telemetry = kind in TELEMETRY
    for name in ("effective.toml", "telemetry.lcmlog") if telemetry else ("bus.candump",):
        if not (folder / name).is_file():
            raise UsageError(f"{folder} is not a run folder: it has no {name}")
    target = arguments.out or folder / f"{'telemetry' if telemetry else 'bus'}.{kind}"
    if target.is_dir():
        raise UsageError(f"--out {target}: is a folder; give the file to write")
    if not target.parent.is_dir():
        raise UsageError(f"--out {target}: there is no folder {target.parent}")
    with tempfile.TemporaryDirectory(prefix=".reed-export-", dir=target.parent) as scratch:  # a file is there whole or not at all
        try:
            written = (of_telemetry if telemetry else of_bus)(folder, kind, Path(scratch, target.name))
        except ModuleNotFoundError as error:
            raise RunError(f"--to {kind} needs the Python package {error.name}: {INSTALL} -r tools/requirements-export.txt") from None
        for path in written:
            path.replace(target.parent / path.name)
            print(f"written {target.parent / path.name}")
    return 0


def of_telemetry(folder: Path, kind: str, target: Path) -> list[Path]:
    if kind == "mcap":
        from reed_tools.export import mcap_file as format_of
    else:
        from reed_tools.export import tables as format_of
        if kind == "parquet":
            import pyarrow  # noqa: F401  (before a minute of telemetry is read)
    run_folder.require_unchanged(folder)
    effective = configuration.load(folder / "effective.toml")
    recording = load(folder / "telemetry.lcmlog")
    if not recording.has("REED_MEASURED"):
        raise UsageError(f"{folder / 'telemetry.lcmlog'} holds no cycle: there is nothing to export")
    if kind == "mcap":
        return format_of.write(recording, effective, target)
    write = format_of.write_csv if kind == "csv" else format_of.write_parquet
    return write(recording, effective["arm"]["param_names"], target)


def of_bus(folder: Path, kind: str, target: Path) -> list[Path]:
    if kind == "mf4" and not importlib.util.find_spec("asammdf"):
        raise RunError(f"--to mf4 needs the Python package asammdf, which is not installed with the others: {INSTALL} asammdf")
    from reed_tools.export import can_logs

    return can_logs.write(folder / "bus.candump", kind, target)
