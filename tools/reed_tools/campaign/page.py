"""campaign.html: one file with limits, distributions and the worst draws, readable without a network and in print."""

import html
from pathlib import Path

from reed_tools import versions
from reed_tools.record.whole_file import write_text
from reed_tools.run import in_memory
from reed_tools.show.html_parts import again, mark, page, picture, table
from reed_tools.show.tables import number

FILE = "campaign.html"
CAPTIONS = {"distributions": "How the figures of the scenario's checks are distributed over the draws.",
            "causes": "What a bad draw goes along with."}


def limits(summary: dict) -> str:
    rows = [[line["name"], number(line["value"]) if line["value"] is not None else "∞", number(line["limit"]), mark(line["ok"])]
            for line in summary["limits"]]
    rows.append(["draws whose second run differed", len(summary["different"]), f"of {summary['repeated']} repeated", mark(not summary["different"])])
    return table(["", "value", "limit", ""], rows)


def figures(summary: dict) -> str:
    return table(["figure", "limit", "median", "95 %", "worst", "draws beyond"],
                 [[figure["name"], *(number(figure[key]) for key in ("limit", "median", "p95", "worst", "beyond"))] for figure in summary["figures"]])


def worst(summary: dict) -> str:
    """The command goes under its draw, over the whole width."""
    rows = []
    for draw in summary["worst"]:
        why = draw["deciding"]
        why_text = f"{why['name']} = {number(why['value'])} (limit {number(why['limit'])})" if why else ""
        ratio = number(draw["ratio"], 3) if draw["ratio"] is not None else "∞"
        cells = "".join(f"<td>{html.escape(str(cell))}</td>" for cell in (draw["index"], draw["seed"], ratio, draw["message"] or why_text))
        rows.append(f"<tr>{cells}</tr>"
                    f'<tr><td colspan="4"><pre>{html.escape(draw["command"])}</pre></td></tr>')
    return ("<table><thead><tr><th>draw</th><th>seed</th><th>ratio</th><th>deciding</th></tr></thead><tbody>\n" + "\n".join(rows)
            + "\n</tbody></table>")


RAW = ("summary.json", "draws.jsonl", "options.json", "campaign.toml", "junit.xml")


def write(folder: Path, summary: dict, definition_text: str, pictures: list[Path], command: str) -> Path:
    """`command`: the line that repeats the campaign."""
    title = html.escape(f"campaign {summary['campaign']}")
    head = (f'<h1>{title}: <span class="{summary["verdict"]}">{summary["verdict"]}</span></h1>'
            f"<p>{summary['finished']} of {summary['draws']} draws of {html.escape(summary['scenario'])}, campaign seed {summary['seed']}, "
            f"lockstep<br>programs {html.escape(', '.join(summary['builds']))}, definition {summary['definition'][:16]}</p>")
    shown = "\n".join(picture(path, CAPTIONS[path.stem]) for path in pictures)
    sections = [("Limits", limits(summary)), ("Figures", figures(summary)), ("Distributions", shown),
                ("Worst draws, ready to run again", worst(summary)), ("The same campaign again", again(command, [name for name in RAW if (folder / name).is_file()], versions.all_of_them(in_memory.programs()))),
                ("Definition", f"<pre>{html.escape(definition_text)}</pre>")]
    body = "\n".join(f"<h2>{name}</h2>\n{content}" for name, content in sections)
    path = folder / FILE
    write_text(path, page(title, f"{head}\n{body}"))
    return path
