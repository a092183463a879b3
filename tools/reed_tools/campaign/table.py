"""A campaign's result on the terminal: limits, figures, the worst draw's command."""

from rich.text import Text

from reed_tools.show.tables import console, grid, mark, number
from reed_tools.text import plain


def show(summary: dict) -> None:
    out = console()
    figures = grid("figures of all draws", "figure", "limit", "median", "95 %", "worst", "beyond")
    for figure in summary["figures"]:
        figures.add_row(figure["name"], *(number(figure[key]) for key in ("limit", "median", "p95", "worst", "beyond")))
    out.print(figures)
    limits = grid("limits", "of the campaign", "value", "limit", "")
    for line in summary["limits"]:
        limits.add_row(line["name"], number(line["value"]) if line["value"] is not None else "∞", number(line["limit"]),
                       mark(line["ok"]))
    out.print(limits)
    out.print(f"repeated  {summary['repeated']} draws a second time, {len(summary['different'])} differ", highlight=False)
    worst = summary["worst"][0]
    out.print(plain(f"worst   draw {worst['index']}: {worst['command']}"), soft_wrap=True, highlight=False)
    passed = summary["verdict"] == "pass"
    out.print(f"campaign {summary['campaign']}: ", Text(summary["verdict"].upper(), f"bold {'green' if passed else 'red'}"), sep="",
              highlight=False)
