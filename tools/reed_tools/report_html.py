"""report.html: one file with everything in it, readable without a network and in print."""

import base64
import html
from pathlib import Path

from reed_tools.result_table import lines, number

STYLE = """
body{font:15px/1.45 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#222}
h1{font-size:1.5rem;margin-bottom:0} h2{font-size:1.1rem;margin-top:2rem;border-bottom:1px solid #ccc}
table{border-collapse:collapse;margin:.6rem 0} th,td{padding:.15rem .8rem .15rem 0;text-align:right;border-bottom:1px solid #eee}
th:first-child,td:first-child{text-align:left} th{font-weight:600}
.pass{color:#00703c}.fail{color:#b00020} img{width:100%;margin:.6rem 0} pre{white-space:pre-wrap;font-size:12px;background:#f6f6f6;padding:.8rem}
@media print{body{max-width:none;margin:0} img,table{break-inside:avoid}}
"""

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


def table(head: list[str], rows: list[list]) -> str:
    def cells(tag: str, values: list) -> str:
        return "".join(f"<{tag}>{value}</{tag}>" for value in values)

    body = "\n".join(f"<tr>{cells('td', row)}</tr>" for row in rows)
    return f"<table><thead><tr>{cells('th', head)}</tr></thead><tbody>\n{body}\n</tbody></table>"


def mark(ok: bool) -> str:
    return '<span class="pass">ok</span>' if ok else '<span class="fail"><b>FAIL</b></span>'


def picture(path: Path, caption: str) -> str:
    data = base64.b64encode(path.read_bytes()).decode()
    return f'<figure><img alt="{html.escape(caption)}" src="data:image/png;base64,{data}"><figcaption>{html.escape(caption)}</figcaption></figure>'


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
        [html.escape(name), *(number(value) for value in values)] for name, *values in zip(known["names"], *columns)])
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
    path.write_text(f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>Reed: {title}</title>'
                    f"<style>{STYLE}</style></head><body>\n{head}\n{body}\n</body></html>\n")
    return path
