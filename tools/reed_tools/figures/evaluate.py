"""From the records of a run folder to its figures, pictures and page."""

from pathlib import Path

from reed_tools.figures import report_page, summary
from reed_tools.record import configuration
from reed_tools.record.telemetry_log import load


def evaluate(folder: Path) -> dict:
    recording = load(folder / "telemetry.lcmlog")
    figures, signals = summary.build(folder, recording)
    summary.write(folder, figures)
    from reed_tools.figures import plots  # matplotlib takes half a second: not before the numbers are safe

    pictures = plots.draw_all(folder, recording, signals, configuration.load(folder / "effective.toml"), figures)
    report_page.write(folder, figures, pictures)
    return figures
