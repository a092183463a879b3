"""report.html: one file with everything in it: the moving arm, curves to zoom, tables; readable without a network and in print."""

import html
import re
from pathlib import Path

from reed_tools.figures.parameter_units import unit_of
from reed_tools.figures.result_table import lines
from reed_tools.record import configuration, run_folder
from reed_tools.record.whole_file import write_text
from reed_tools.show import interactive
from reed_tools.show.html_parts import Markup, again, mark, page, picture, table
from reed_tools.show.tables import number

CAPTIONS = {
    "arm": "The arm's true shape from the plant's record, with the desired arm (dotted), the true wall and the path of the tip.",
    "joint_error": "Planned reference minus motor-side angle; triangles: the joint turns round and its Coulomb friction changes sign. While "
                   "the arm presses, the force loop moves it off the plan along the force direction D on purpose: that part is in the "
                   "upper curves and no failure. The lower curves are without it, and the checks apply to them.",
    "tip_error": "The plant's true, bent tip against the planned tip. Along the wall's normal the arm yields until the force is right.",
    "force": "Desired, measured and true normal force; below, the true force error.",
    "torque": "Torque as commanded, after all limits.",
    "parameters": "Estimates against the plant's true values (dashed) inside their box (grey). They need not converge to the truth.",
    "lyapunov": "V of (42) or (45), wide and grey, with its parts, and its derivative by the equations and by differences. The equations "
                "contain no Coulomb friction and no bending: V converges to where they balance.",
    "timing": "How long each phase of a cycle took.",
}
RAW = ("summary.json", run_folder.TELEMETRY, "bus.candump", run_folder.CONFIGURATION, "controller.toml", "plant.toml", run_folder.SUMS)
FREE_JOINT_ERROR = "Planned reference minus motor-side angle; triangles: the joint turns round and its Coulomb friction changes sign."
MOST_EVENTS = 60
SAID_IN_TEXT = ("mode_change", "force_source_change", "drive_state", "controller_present", "controller_restarted", "brakes_released",
                "brakes_closed")  # their value adds nothing


def checks(summary: dict) -> str:
    return table(["figure", "value", "limit", "", ""], [
        [check["name"], number(check["value"]), number(check["limit"]), mark(check["ok"]), check["why"] or ""]
        for check in summary["checks"]], text=(4,))


def windows(summary: dict) -> str:
    names = ["joint_rms_mrad", "joint_peak_mrad", "tangential_joint_rms_mrad", "tip_rms_mm", "tangential_tip_rms_mm", "force_rms_N", "force_peak_N"]
    return table(["second", "joint rms [mrad]", "joint peak [mrad]", "tangential rms [mrad]", "tip rms [mm]", "tangential tip [mm]",
                  "force rms [N]", "force peak [N]"],
                 [[f"{w['from_s']:g}–{w['to_s']:g}", *(number(w[name], 3) for name in names)] for w in summary["windows"]])


def happened(summary: dict) -> str:
    """All events up to a number; what stopped the arm in any case."""
    events = summary["events"]
    shown = events if len(events) <= MOST_EVENTS else [event for k, event in enumerate(events) if k < MOST_EVENTS or is_reason(event, summary)]
    rows = [[f"{event['t_s']:.3f}", event["from"], joint(event), "" if event["name"] in SAID_IN_TEXT else number(event["value"]),
             Markup(f"<b class=fail>{html.escape(in_words(event))}</b>") if is_reason(event, summary) else in_words(event)] for event in shown]
    left = f"<p>{len(events) - len(shown)} more are in summary.json.</p>" if len(events) > len(shown) else ""
    return table(["time [s]", "by", "joint", "value", "event"], rows, text=(1, 4)) + left


def is_reason(event: dict, summary: dict) -> bool:
    reason = summary["reason"]
    return bool(reason) and all(event[key] == reason[key] for key in reason)


def in_words(event: dict) -> str:
    """The plant's own clock started earlier; the first column has the run's time."""
    return re.sub(r" at \d+\.\d+ s$", "", event["text"])


def joint(event: dict) -> str:
    return "" if event["joint"] is None else str(event["joint"] + 1)


def timing(summary: dict) -> str:
    return table(["phase [µs]", "p50", "p99", "p99.9", "max"], [
        [phase, *(number(figures[key] if figures else None) for key in ("p50", "p99", "p999", "max"))]
        for phase, figures in summary["timing_us"].items()])


def parameters(summary: dict, arm: dict) -> str:
    known = summary["parameters"]
    columns = [known[key] or [None] * len(known["names"]) for key in ("true", "initial", "final", "max_abs")]
    return table(["parameter", "true", "initial", "final", "largest", "unit"], [
        [name, *(number(value) for value in values), unit_of(arm, name)] for name, *values in zip(known["names"], *columns)])


def scalars(summary: dict) -> str:
    return table(["scalar", "smallest", "largest", "mean", "last", "unit", "meaning"], [
        [name, *(number(figures[key]) for key in ("min", "max", "mean", "last")), figures["unit"], figures["meaning"]]
        for name, figures in summary["scalars"].items()], text=(5, 6))


def sections(summary: dict, folder: Path, effective: dict, effective_text: str, pictures: list[Path], lively: dict) -> list[tuple[str, str]]:
    captions = CAPTIONS if effective.get("wall") and summary["windows"] and any(w["force_rms_N"] is not None for w in summary["windows"]) \
        else CAPTIONS | {"joint_error": FREE_JOINT_ERROR}
    still = {path.stem: picture(path, captions[path.stem]) for path in pictures}
    loop = "".join(f"<p>{html.escape(line)}</p>" for line in lines(summary))
    raw = [name for name in RAW if (folder / name).is_file()]
    return [("The arm", (interactive.ARM if lively.get("arm") else "") + unless(lively.get("arm"), still.pop("arm", "<p>Its shape was not recorded.</p>"))),
            ("Checks", checks(summary)), ("Error by second", windows(summary)), ("What happened", happened(summary)),
            ("Curves", curves(lively.get("curves")) + unless(lively.get("curves"), "\n".join(still.values()))),
            ("Parameters", parameters(summary, effective["arm"])), ("Recorded scalars", scalars(summary)), ("Loop, bus and clock", loop + timing(summary)),
            ("The same run again", again(summary["command"], raw, summary["versions"], summary["machine"])),
            ("Effective configuration", f"<p>SHA-256 {summary['config_sha256']}</p><pre class=long>{html.escape(effective_text)}</pre>")]


def curves(drawn: dict | None) -> str:
    if not drawn:
        return ""
    thinned = f" Every {drawn['every']}th cycle is drawn; telemetry.lcmlog has all." if drawn["every"] > 1 else ""
    return (f'<p class="hint">Drag in a diagram to zoom all of them, double-click to see the whole run, click to show the arm at that time. The '
            f"values under the cursor are in the legends; a click there hides a curve.{thinned} In print these are still pictures.</p>{interactive.CURVES}")


def unless(lively: dict | None, still: str) -> str:
    """Still pictures are for print, and for a browser that runs no scripts, where the page has something that moves instead."""
    return f'<div class="still">{still}</div>' if lively else still


def because(summary: dict) -> str:
    return f'<p class="fail"><b>{html.escape(summary["cause"])}</b></p>' if summary["cause"] else ""


def write(folder: Path, summary: dict, pictures: list[Path], lively: dict) -> Path:
    """`lively`: the numbers of animation.py ("arm") and curves.py ("curves"), where the record allows them."""
    source = folder / run_folder.CONFIGURATION
    title = html.escape(f"{summary['scenario']} on {summary['arm']}")
    head = (f'<h1>{title}: <span class="{summary["verdict"]}">{summary["verdict"].upper()}</span></h1>{because(summary)}'
            f"<p>law {html.escape(summary['law'])}, {summary['dof']} joints, seed {summary['seed']}, "
            f"{summary['clock']} clock at {summary['rate_hz']:g} Hz<br>digest {summary['digest']}</p>")
    listed = sections(summary, folder, configuration.load(source), source.read_text(encoding="utf-8"), pictures, lively)
    body = "\n".join(f"<h2>{name}</h2>\n{content}" for name, content in listed)
    path = folder / "report.html"
    write_text(path, page(title, f"{head}\n{body}", interactive.head(), interactive.scripts(lively)))
    return path
