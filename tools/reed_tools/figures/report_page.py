"""report.html: one file with everything in it, readable without a network and in print."""

import html
from pathlib import Path

from reed_tools.figures.result_table import lines
from reed_tools.record.whole_file import write_text
from reed_tools.show.html_parts import STYLE, mark, picture, table
from reed_tools.show.tables import number

CAPTIONS = {
    "joint_error": "Planned reference minus motor-side angle; below, without the component along the force direction D.",
    "tip_error": "The plant's true, bent tip against the planned tip.",
    "force": "Desired, measured and true normal force; below, the true force error.",
    "torque": "Torque as commanded, after all limits.",
    "parameters": "Estimates against the plant's true values (dashed) inside their box (grey). They need not converge to the truth.",
    "lyapunov": "V of (42) or (45) with its parts, and its derivative by the equations and by differences. The equations know no "
                "Coulomb friction and no bending: V settles where they balance.",
    "timing": "How long each phase of a cycle took.",
}


def sections(summary: dict, effective_text: str, pictures: list[Path]) -> list[tuple[str, str]]:
    checks = table(["figure", "value", "limit", ""], [
        [check["name"], number(check["value"]), number(check["limit"]), mark(check["ok"])] for check in summary["checks"]])
    window_names = ["joint_rms_mrad", "joint_peak_mrad", "tangential_joint_rms_mrad", "tip_rms_mm", "tangential_tip_rms_mm",
                    "force_rms_N", "force_peak_N"]
    windows = table(["s", "joint rms [mrad]", "joint peak [mrad]", "tangential rms [mrad]", "tip rms [mm]", "tangential tip [mm]",
                     "force rms [N]", "force peak [N]"],
                    [[f"{w['from_s']:g}–{w['to_s']:g}", *(number(w[name], 3) for name in window_names)] for w in summary["windows"]])
    timing = table(["phase [µs]", "p50", "p99", "p99.9", "max"], [
        [phase, *(number(figures[key] if figures else None) for key in ("p50", "p99", "p999", "max"))]
        for phase, figures in summary["timing_us"].items()])
    known = summary["parameters"]
    columns = [known[key] or [None] * len(known["names"]) for key in ("true", "initial", "final", "max_abs")]
    parameters = table(["parameter", "true", "initial", "final", "largest"], [
        [name, *(number(value) for value in values)] for name, *values in zip(known["names"], *columns)])
    machine = "".join(f"<p>{html.escape(line)}</p>" for line in lines(summary))
    return [("Checks", checks), ("Error by second", windows), ("Pictures", "\n".join(picture(path, CAPTIONS[path.stem]) for path in pictures)),
            ("Parameters", parameters), ("Loop, bus and clock", machine + timing),
            ("Effective configuration", f"<p>SHA-256 {summary['config_sha256']}</p><pre>{html.escape(effective_text)}</pre>")]


def write(folder: Path, summary: dict, pictures: list[Path]) -> Path:
    title = html.escape(f"{summary['scenario']} on {summary['arm']}")
    head = (f'<h1>{title}: <span class="{summary["verdict"]}">{summary["verdict"]}</span></h1>'
            f"<p>law {html.escape(summary['law'])}, {summary['dof']} joints, seed {summary['seed']}, "
            f"{summary['clock']} clock at {summary['rate_hz']:g} Hz<br>digest {summary['digest']}</p>")
    body = "\n".join(f"<h2>{name}</h2>\n{content}"
                     for name, content in sections(summary, (folder / "effective.toml").read_text(), pictures))
    path = folder / "report.html"
    write_text(path, f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>Reed: {title}</title>'
                     f"<style>{STYLE}</style></head><body>\n{head}\n{body}\n</body></html>\n")
    return path
