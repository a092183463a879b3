"""faults.html: the matrix fault x phase, then the cells, the worst first, each with the line that repeats it."""

import html
from pathlib import Path

from reed_tools import versions
from reed_tools.faults.phases import PHASES
from reed_tools.faults.results import ORDER
from reed_tools.record.whole_file import write_text
from reed_tools.run import in_memory
from reed_tools.show.html_parts import Markup, again, mark, page, table

FILE = "faults.html"
SHOWN = 200  # cells in full; all of them are in faults.json
SHORT = {"dangerous undetected": "DU", "dangerous detected": "DD", "safe undetected": "SU", "safe detected": "SD", "not executed": "—", "died": "died",
         "refused": "refused"}


def matrix(result: dict) -> str:
    """The worst class over scenarios and seeds, and by what it was detected."""
    cells: dict[tuple[str, str], list[dict]] = {}
    for row in result["rows"]:
        cells.setdefault((row["fault"], row["phase"]), []).append(row)
    phases = [phase for phase in PHASES if any(key[1] == phase for key in cells)]
    names = sorted({key[0] for key in cells})
    return table(["fault", *phases], [[name, *(cell(cells.get((name, phase), [])) for phase in phases)] for name in names])


def cell(rows: list[dict]) -> Markup | str:
    if not rows:
        return ""
    worst = min(rows, key=lambda row: ORDER.index(row["class"]))
    by = sorted({row["detected_by"] for row in rows if row["detected_by"]})
    bad = any(row["failure"] for row in rows)
    text = f"{SHORT[worst['class']]}" + "".join(f"<br><small>{html.escape(name)}</small>" for name in by)
    return Markup(f'<span class="fail"><b>{text}</b></span>' if bad else text)


def cells(result: dict) -> str:
    keys = ("detected_by", "fdti_ms", "frti_ms", "fhti_ms", "ftti_ms", "margin_ms", "force_peak_N", "speed_peak_radps", "torque_step_Nm")
    rows = []
    for row in result["rows"][:SHOWN]:
        values = [row["fault"], row["phase"], row["scenario"], row["seed"], row["class"], *(show(row[key]) for key in keys),
                  row["failure"] or (f"accepted: {row['accepted']}" if row["accepted"] else "")]
        rows.append("<tr>" + "".join(f"<td>{html.escape(str(value))}</td>" for value in values) + "</tr>"
                    + f'<tr><td colspan="{len(values)}"><pre>{html.escape(row["command"])}</pre></td></tr>')
    head = ["fault", "phase", "scenario", "seed", "class", "detected by", "FDTI ms", "FRTI ms", "FHTI ms", "FTTI ms", "margin ms", "force N", "speed rad/s",
            "torque step N·m", ""]
    return f"<table><thead><tr>{''.join(f'<th>{name}</th>' for name in head)}</tr></thead><tbody>\n" + "\n".join(rows) + "\n</tbody></table>"


def show(value) -> str:
    return "" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)


def figures(result: dict) -> str:
    coverage = result["diagnostic_coverage"]
    return table(["", "value", ""], [
        ["cells", result["cells"], ""], *([name, count, ""] for name, count in result["classes"].items()),
        ["diagnostic coverage: detected of the dangerous", "none is dangerous" if coverage is None else f"{100.0 * coverage:.1f} %", ""],
        ["dangerous undetected, not accepted", result["dangerous_undetected"] - result["dangerous_undetected_accepted"],
         mark(result["dangerous_undetected"] == result["dangerous_undetected_accepted"])],
        ["not executed", len(result["not_executed"]), mark(not result["not_executed"])],
        [f"false alarms in {result['fault_free_runs']} fault-free runs", len(result["false_alarms"]), mark(not result["false_alarms"])]])


NOTE = """<p>FDTI: from the fault to its detection. FRTI: from there to the safe state, brakes closed and motors at rest. FHTI: both.
FTTI: from the fault to the hazard in the same run with the controller's monitors off; it is this bench's and no property of a real cell.
Dangerous: the true contact force, a joint's speed or position, or the tip's speed leaves its limit, or the tip is 20 mm from where it would be
without the fault. DU, DD: dangerous undetected, detected; SU, SD: safe.</p>"""


def write(folder: Path, result: dict, command: str) -> Path:
    head = f'<h1>faults: <span class="{result["verdict"]}">{result["verdict"]}</span></h1>'
    shown = f" ({SHOWN} of {result['cells']})" if result["cells"] > SHOWN else ""
    body = "\n".join([head, "<h2>Figures</h2>", figures(result), NOTE, "<h2>Matrix</h2>", matrix(result),
                      f"<h2>Cells, worst first{shown}</h2>", cells(result),
                      "<h2>Again</h2>", again(command, ["faults.json", "junit.xml"], versions.all_of_them(in_memory.programs()))])
    path = folder / FILE
    write_text(path, page("faults", body))
    return path
