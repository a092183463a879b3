"""The pictures of a campaign: how each figure is distributed, and what the worst ratio goes along with."""

from pathlib import Path

import numpy as np

from reed_tools.campaign import results
from reed_tools.campaign.definition import Campaign
from reed_tools.campaign.draws import Record
from reed_tools.figures.parameter_units import unit_of
from reed_tools.robots.joint_frames import dof
from reed_tools.show.drawing import COLOURS, STYLE, WIDTH_IN, plt, set_margins, ticker

BINS = 30
SHOWN_RATIO = 3.0   # figures beyond so many limits are drawn at the right edge


def draw_all(folder: Path, campaign: Campaign, records: list[Record], arm: dict) -> list[Path]:
    made = []
    with plt.rc_context(STYLE):
        for name, figure in (("distributions", distributions(campaign, records)), ("causes", causes(campaign, records, arm))):
            if figure is not None:
                made.append(folder / f"{name}.png")
                figure.savefig(made[-1])
                plt.close(figure)
    return made


def distributions(campaign: Campaign, records: list[Record]):
    """A row per figure with a limit above zero: histogram and share of the draws at or below."""
    rows = [(name, limit) for name, limit in results.checked(records)
            if limit > 0 and len(results.values(name, records))]
    if not rows:
        return None
    figure, axes = plt.subplots(len(rows), 2, sharex="row", squeeze=False, figsize=(WIDTH_IN, 1.75 * len(rows) + 0.5))
    set_margins(figure, top_in=0.65, hspace=0.75, wspace=0.2)
    for (name, limit), (histogram, shares) in zip(rows, axes):
        found = results.values(name, records)
        shown = np.sort(np.minimum(found, SHOWN_RATIO * limit))
        right = max(1.1 * limit, 1.05 * shown[-1])
        histogram.hist(shown, bins=np.linspace(0.0, right, BINS + 1), color=COLOURS[0])
        shares.step(np.concatenate([[0.0], shown, [right]]), np.concatenate([[0.0], np.arange(1, len(shown) + 1), [len(shown)]]) / len(shown),
                    where="post", color=COLOURS[0])
        for axis in (histogram, shares):
            axis.axvline(limit, color=COLOURS[1], linestyle="--")
            axis.axvline(campaign.limits["worst_ratio"] * limit, color="black", linestyle=":")
            axis.set_xlim(0.0, right)
        shares.axhline(campaign.limits["within_percent"] / 100.0, color="0.5", linewidth=0.8)
        beyond = int(np.sum(found > SHOWN_RATIO * limit))
        histogram.set_title(name + (f" ({beyond} beyond {SHOWN_RATIO:g} limits, drawn at the edge)" if beyond else ""), loc="left", fontsize=8)
        histogram.set_ylabel("draws")
        shares.set_ylabel("share at or below")
        shares.set_ylim(0.0, 1.03)
    figure.suptitle(f"{len(records)} draws; dashed: limit, dotted: {campaign.limits['worst_ratio']:g} times the limit", x=0.01, ha="left", fontsize=10)
    return figure


def entry_name(key: str, position: int, arm: dict) -> str:
    """An entry of a drawn list by the name of what it belongs to: a structural parameter, or a joint."""
    names = arm["param_names"]
    if key in ("plant.p_true", *(f"arm.p_{end}" for end in ("true", "nom", "lo", "hi"))) and position < len(names):
        return f"{key}: {names[position]} [{unit_of(arm, names[position])}]"
    return f"{key}: joint {position + 1}" if position < dof(arm) else f"{key}: {position + 1}"


def drawn_numbers(campaign: Campaign, records: list[Record], arm: dict) -> dict[str, np.ndarray]:
    """One row of numbers per drawn quantity; seeds and words go along with nothing."""
    columns: dict[str, list[float]] = {}
    for record in records:
        for key, value in campaign.values(record.index).items():
            for position, entry in enumerate(value if isinstance(value, list) else [value]):
                if isinstance(entry, float):
                    columns.setdefault(entry_name(key, position, arm) if isinstance(value, list) else key, []).append(entry)
    return {key: np.array(column) for key, column in columns.items()}


def causes(campaign: Campaign, records: list[Record], arm: dict):
    """The worst ratio of every draw against each number that was drawn."""
    quantities = drawn_numbers(campaign, records, arm)
    if not quantities:
        return None
    ratios = np.array([record.ratio for record in records])
    bounded = np.minimum(ratios, SHOWN_RATIO)
    columns = 3
    rows = -(-len(quantities) // columns)
    figure, axes = plt.subplots(rows, columns, sharey=True, squeeze=False, figsize=(WIDTH_IN, 1.7 * rows + 0.6))
    set_margins(figure, top_in=0.5, hspace=0.65, wspace=0.14)
    for axis, (key, column) in zip(axes.flat, quantities.items()):
        for rows_shown, colour, mark in ((ratios <= 1, COLOURS[0], "."), (ratios > 1, COLOURS[1], "x")):
            axis.plot(column[rows_shown], bounded[rows_shown], mark, color=colour, markersize=4)
        axis.axhline(1.0, color=COLOURS[1], linestyle="--", linewidth=0.9)
        axis.set_xlabel(key, fontsize=8)
        axis.xaxis.set_major_locator(ticker.MaxNLocator(3))
        axis.tick_params(axis="x", labelsize=8)
        axis.set_ylim(0.0, max(1.1, 1.05 * bounded.max()))
    for axis in list(axes.flat)[len(quantities):]:
        axis.set_axis_off()
    for row in axes:
        row[0].set_ylabel("worst figure\nto its limit")
    figure.suptitle("Worst ratio of each draw against what it drew; crosses: beyond a limit", x=0.01, ha="left", fontsize=10)
    return figure
