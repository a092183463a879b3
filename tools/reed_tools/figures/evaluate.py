"""From the records of a run folder to its figures, pictures and page."""

from pathlib import Path

from reed_tools.figures import report_page, summary
from reed_tools.record import configuration, run_folder
from reed_tools.record.telemetry_log import load


def evaluate(folder: Path) -> tuple[dict, str | None]:
    """The figures, and in one line why they could not be kept in the folder."""
    recording = load(*run_folder.logs(folder))
    figures, signals = summary.build(folder, recording)
    try:
        summary.write(folder, figures)
        from reed_tools.figures import animation, curves, plots  # matplotlib takes half a second: not before the numbers are safe

        effective = configuration.load(folder / run_folder.CONFIGURATION)
        pictures = plots.draw_all(folder, recording, signals, effective, figures)
        lively = {"arm": animation.data(recording, signals, effective),
                  "curves": curves.data(signals, recording, effective, figures["reason"], plots.COLOURS)}
        report_page.write(folder, figures, pictures, lively)
    except OSError as error:
        return figures, f"{error.filename}: {(error.strerror or str(error)).lower()}; the records are kept, `tools/reed report {folder}` makes the rest"
    return figures, None
