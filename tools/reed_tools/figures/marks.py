"""What happened, drawn into every picture over time: contact, another active law, the stop; and where joints reverse."""

import numpy as np

from reed_tools.figures.run_data import CONTACT_N
from reed_tools.record.signals import SOURCES, Signals

LOST_S = 0.1             # contact that is lost for a shorter time is part of an impact
LABELS_APART = 0.025     # of the time shown
STILL = 0.05             # share of a joint's largest speed below which it counts as standing
MOST = 12                # marks of a kind: more would hide the curves
STOP_COLOUR, MARK_COLOUR = "#b00020", "0.35"


def times(signals: Signals, reason: dict | None) -> list[tuple[float, str, str]]:
    """(t, text, colour) in s since active."""
    marks = [(t, text, MARK_COLOUR) for t, text in contacts(signals)[:MOST]]
    for k in np.flatnonzero(np.diff(signals.source) != 0)[:MOST]:
        marks.append((float(signals.t[k + 1]), f"force: {SOURCES[signals.source[k + 1]]}", MARK_COLOUR))
    if reason and reason["t_s"] >= 0.0:
        marks.append((reason["t_s"], f"stopped: {reason['name']}", STOP_COLOUR))
    return sorted(marks)


def contacts(signals: Signals) -> list[tuple[float, str]]:
    """Contact made, and lost for longer than an impact takes."""
    rows = np.flatnonzero(signals.force_true > CONTACT_N)
    if not len(rows):
        return []
    gaps = np.flatnonzero(np.diff(signals.t[rows]) > LOST_S)
    found = [(float(signals.t[rows[0]]), "contact")]
    for k in gaps:
        found += [(float(signals.t[rows[k]]), "contact lost"), (float(signals.t[rows[k + 1]]), "contact")]
    return found + ([(float(signals.t[rows[-1]]), "contact lost")] if signals.t[-1] - signals.t[rows[-1]] > LOST_S else [])


def reversals(speed: np.ndarray) -> np.ndarray:
    """Rows at which a joint turns round: its Coulomb friction changes sign there."""
    moving = np.flatnonzero(np.abs(speed) > STILL * max(np.max(np.abs(speed), initial=0.0), 1e-6))
    turned = np.flatnonzero(np.diff(np.sign(speed[moving])) != 0)
    return (moving[turned] + moving[turned + 1]) // 2


def draw(figure, signals: Signals, reason: dict | None) -> None:
    labelled = -np.inf
    for t, text, colour in times(signals, reason):
        for axis in figure.axes:
            axis.axvline(t, color=colour, linewidth=0.8, linestyle="--", zorder=0)
        if t - labelled > LABELS_APART * (signals.t[-1] - signals.t[0]) or colour == STOP_COLOUR:
            labelled = t
            figure.axes[0].annotate(text, (t, 0.99), xycoords=("data", "axes fraction"), xytext=(-1, 0), textcoords="offset points",
                                    rotation=90, ha="right", va="top", fontsize=6.5, color=colour)


def draw_reversals(axis, signals: Signals, curves: np.ndarray, colours) -> None:
    """A triangle on each joint's curve; one entry in the legend."""
    label = "joint turns round"
    for joint in range(signals.dof):
        rows = reversals(signals.reference_speed[:, joint])[:MOST]
        if len(rows):
            axis.plot(signals.t[rows], curves[rows, joint], "v", color=colours[joint % len(colours)], markersize=4,
                      markeredgecolor="black", markeredgewidth=0.4, label=label)
            label = None
