"""From the records of a run folder to its figures, pictures and page."""

from pathlib import Path

from reed_tools import report_html, scenario, summary
from reed_tools.telemetry_log import load


def evaluate(folder: Path) -> dict:
    recording = load(folder / "telemetry.lcmlog")
    figures, signals = summary.build(folder, recording)
    summary.write(folder, figures)
    from reed_tools import plots  # matplotlib takes half a second: not before the numbers are safe

    pictures = plots.draw_all(folder, recording, signals, scenario.load(folder / "effective.toml"), figures)
    report_html.write(folder, figures, pictures)
    return figures
