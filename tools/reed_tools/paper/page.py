"""paper.html: the panels, the phases, the windows and the comparison of laws on one self-contained page."""

import html
from pathlib import Path

from reed_tools import versions
from reed_tools.paper import captions, pictures
from reed_tools.paper.phases import force_by_second, joint_by_second, phases, times
from reed_tools.paper.runs import Result
from reed_tools.record.whole_file import write_text
from reed_tools.run import in_memory
from reed_tools.show.html_parts import Markup, again, page as whole_page, table
from reed_tools.show.tables import number

PAPER, SEPARATED = "paper_corrected", "separated"
SECONDS = [Markup(f"<span class=one>{k}–{k + 1} s</span>") for k in range(3)]
EXTRA_STYLE = """
body{max-width:66rem} section{margin-top:2.2rem} figure{margin:0} dt{font-weight:600;margin-top:.4rem} dd{margin:0 0 .3rem 0}
.better{color:#00703c;font-weight:600} .worse{color:#b00020} .one{white-space:nowrap} .note{color:#555;font-size:13px}
"""


class Page:
    def __init__(self, results: list[Result]):
        self.by_key = {result.experiment.key: result for result in results}

    def pair(self, group: str) -> tuple[Result, Result]:
        return self.by_key[f"{group}/{PAPER}"], self.by_key[f"{group}/{SEPARATED}"]

    def group(self, name: str) -> list[Result]:
        return [result for key, result in self.by_key.items() if key.startswith(name + "/")]

    def pictures(self):
        """(figure of the paper, drawing, the two runs) in reading order."""
        known, unknown, joint = self.pair("known"), self.pair("unknown"), self.pair("joint")
        draw = pictures
        return [("9", draw.force_and_trajectory, known), ("10", draw.control_signals, known), ("11", draw.parameters, known),
                ("12", draw.cartesian_input, unknown), ("13", draw.joint_input, joint),
                ("14", draw.unknown_adaptation, unknown), ("15", draw.unknown_adaptation, joint),
                ("16", draw.known_errors, known), ("17", draw.unknown_errors, unknown)]


def rate(result: Result) -> float:
    return result.effective["timing"]["rate_hz"]


def seen_number(value: float | None, digits: int = 3) -> str:
    return "–" if value is None else number(float(value), digits)


def outcome(result: Result) -> str:
    if result.stopped:
        return Markup(f'<span class="worse">stopped at {result.signals.t[-1]:.2f} s: {html.escape(result.stopped)}</span>')
    return "ran to the end"


def values_of(result: Result) -> str:
    """What Reed gets, in numbers, below a panel."""
    joint = joint_by_second(result.signals, rate(result), tangential=result.signals.has_wall)
    text = f"joint error {', '.join(map(seen_number, joint))} mrad rms"
    if result.signals.has_wall:
        text += f"; force error {', '.join(map(seen_number, force_by_second(result.signals, rate(result))))} N rms"
    return f"{text} in the three seconds; {outcome(result)}"


def panel(figure: str, draw, results, folder: Path) -> str:
    text = captions.PANELS[figure]
    data = pictures.png(draw, results)
    (folder / f"figure{figure}.png").write_bytes(data)
    sides = "".join(f"<dt>{side}</dt><dd>{values_of(result)}</dd>" for side, result in
                    zip(("Reed, paper's gains", "Reed, separated"), results))
    return (f'<section id="figure{figure}"><h2>Fig. {figure}: {html.escape(text.title)}</h2>'
            f'<figure><img alt="Fig. {figure}" src="{pictures.inline(data)}"></figure>'
            f'<p class="note">{html.escape(text.read)}</p>'
            f"<dl><dt>The paper</dt><dd>{html.escape(text.paper)}</dd>{sides}</dl></section>")


def phase_table(results: list[Result]) -> str:
    rows = []
    for result in results:
        seen = phases(result.signals)
        if seen is None:
            rows.append([result.experiment.law, "no contact", "–", "–", "–", "–"])
            continue
        stable = seen.stable_s is not None
        rows.append([result.experiment.law, f"{seen.contact_s:.2f}", f"{seen.peak_s:.2f}", number(seen.peak_N, 3),
                     f"{seen.stable_s:.2f}" if stable else Markup('<span class="worse">never</span>'), seen_number(seen.stable_rms_N)])
    return table(["law", "contact [s]", "peak at [s]", "peak [N]", "stable from [s]", "rms from then [N]"], rows)


def marked(value: float | None, best: float | None) -> str:
    """The last second beside that of the law `separated`: better than it is said as loudly as worse."""
    text = times(value, best)
    if value is None or best is None:
        return text if value is not None else Markup(f'<span class="worse">{text}</span>')
    return Markup(f'<span class="{"better" if value < best else "worse" if value > best else ""}">{text}</span>')


def comparison(results: list[Result], with_force: bool) -> str:
    separated = next(result for result in results if result.experiment.key.endswith("/" + SEPARATED))
    best_joint = joint_by_second(separated.signals, rate(separated), with_force)[-1]
    best_force = force_by_second(separated.signals, rate(separated))[-1]
    rows = []
    for result in results:
        joint = joint_by_second(result.signals, rate(result), with_force)
        row = [result.experiment.law, *map(seen_number, joint), marked(joint[-1], best_joint)]
        if with_force:
            force = force_by_second(result.signals, rate(result))
            row += [*map(seen_number, force), marked(force[-1], best_force)]
        rows.append([*row, outcome(result)])
    kind = "tangential joint" if with_force else "joint"
    groups, head = [("", 1), (f"{kind} error [mrad rms]", 4)], ["law", *SECONDS, "to separated"]
    if with_force:
        groups, head = [*groups, ("force error [N rms]", 4)], [*head, *SECONDS, "to separated"]
    return table([*head, "end"], rows, text=(len(head),), groups=[*groups, ("", 1)])


def write(folder: Path, results: list[Result]) -> Path:
    page = Page(results)
    parts = [f"<h1>The paper's experiments, section 4</h1><p>{html.escape(captions.SCOPE)}</p>"
             f"<p><b>Paper's gains:</b> {html.escape(captions.PAPER_GAINS)}</p>"]
    known, unknown = page.group("known"), page.group("unknown")
    parts += [f"<h2>Comparison of laws, known force</h2>{comparison(known, True)}<p class=note>{html.escape(captions.FAIR)}</p>",
              f"<h2>Comparison of laws, unknown force</h2>{comparison(unknown, False)}",
              f"<h2>Comparison of laws, unknown force, joint reference</h2>{comparison(page.group('joint'), False)}",
              f"<h2>The three phases of the force</h2>{phase_table(known)}"
              "<p class=note>Rising: contact to the largest force before it is stable. Decreasing: until it stays within 5 % of what is "
              "finally desired, for 0.3 s at least. Stable: from then on. A force that comes from below without overshoot has no decreasing "
              "phase.</p>"]
    parts += [panel(figure, draw, pair, folder) for figure, draw, pair in page.pictures()]
    for name, pair in (("known force, (42) and (44)", page.pair("known")), ("unknown force, (45) and (46)", page.pair("unknown"))):
        data = pictures.png(pictures.bookkeeping, pair)
        (folder / f"lyapunov-{name.split()[0]}.png").write_bytes(data)
        parts.append(f'<section><h2>Stability bookkeeping, {name}</h2><figure><img alt="V" src="{pictures.inline(data)}"></figure>'
                     f'<p class="note">{html.escape(captions.BOOKKEEPING[name.split()[0]])}</p></section>')
    path = folder / "paper.html"
    drawn = sorted(file.name for file in folder.glob("*.png"))
    parts.append("<h2>The same page again</h2>" + again("tools/reed paper", drawn, versions.all_of_them(in_memory.programs())))
    write_text(path, whole_page("the paper's experiments", "\n".join(parts), f"<style>{EXTRA_STYLE}</style>"))
    return path
