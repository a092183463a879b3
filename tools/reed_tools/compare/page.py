"""compare.html: differences first, then the curves, then the checks beside each other."""

import html
import os
import shlex
from pathlib import Path

from reed_tools import versions
from reed_tools.compare.figures import Difference, in_short
from reed_tools.record.whole_file import write_text
from reed_tools.show.html_parts import Markup, again, mark, page, picture, table
from reed_tools.show.tables import number


def differences(names: list[str], found: list[Difference]) -> str:
    if not found:
        return "<p>None: every figure is the same.</p>"
    return table(["figure", *names], [[entry.figure, *map(in_short, entry.values)] for entry in found])


def checks(names: list[str], summaries: list[dict]) -> str:
    listed = list(dict.fromkeys(check["name"] for summary in summaries for check in summary["checks"]))
    rows = []
    for name in listed:
        here = [next((check for check in summary["checks"] if check["name"] == name), None) for summary in summaries]
        rows.append([name, *(Markup(f"{number(check['value'])} {mark(check['ok'])}") if check else "–" for check in here)])
    return table(["check", *names], rows)


def write(path: Path, names: list[str], found: list[Difference], summaries: list[dict], curves: Path | None, folders: list[Path]) -> Path:
    sections = [("Differences", differences(names, found))]
    if curves:
        sections.append(("Curves", picture(curves, "The runs on common axes, from the moment the arm became active.")))
    if all("checks" in summary for summary in summaries):
        sections.append(("Checks", checks(names, summaries)))
    sections.append(("The same page again", again(shlex.join(["tools/reed", "compare", *map(str, folders)]), links(path.parent, folders), versions.of_tools())))
    body = "\n".join(f"<h2>{title}</h2>\n{content}" for title, content in sections)
    title = html.escape(", ".join(names))
    write_text(path, page(title, f"<h1>{title}</h1>\n{body}"))
    return path


def links(here: Path, folders: list[Path]) -> list[str]:
    """The summaries that were compared, from this page's folder."""
    return [os.path.relpath(folder.resolve() / "summary.json", here.resolve()) for folder in folders if (folder / "summary.json").is_file()]
