"""The curves of the page, as they were recorded: what show/page/curves.js draws. One time axis for all of them."""

from dataclasses import dataclass

import numpy as np

from reed_tools.figures import lyapunov, marks
from reed_tools.figures.parameter_units import unit_of
from reed_tools.record.signals import Signals
from reed_tools.record.telemetry_log import Recording
from reed_tools.robots.arm_frames import rows_at
from reed_tools.show.interactive import floats

MOST_ROWS = 6000
NEAR_LIMIT = 0.5  # share of a torque limit from which on its line is drawn: one far away would flatten the curves


ON_PURPOSE = "While the arm presses, the force loop moves it off the plan along the force direction D on purpose: no failure."
CHECKED = "The checks apply to these curves."
YIELDS = "Along the wall's normal the arm yields until the force is right."
NEED_NOT = "They need not converge to the truth."
BALANCE = "The equations contain no Coulomb friction and no bending: V converges to where they balance."


@dataclass
class Panel:
    title: str
    unit: str
    curves: dict[str, np.ndarray]           # by name, one value per row of Signals
    limits: tuple[tuple[float, int], ...] = ()  # dashed: value, number of the curve that it limits
    note: str = ""


def panels(signals: Signals, recording: Recording, effective: dict) -> list[Panel]:
    """In reading order; angles in mrad and lengths in mm, as in the tables."""
    joints = [f"joint {j + 1}" for j in range(signals.dof)]
    found = [Panel("Joint error: planned reference − motor angle", "mrad", by(joints, 1e3 * signals.joint_error), note=ON_PURPOSE if signals.has_wall else "")]
    if signals.has_wall:
        found.append(Panel("Joint error without the part along D", "mrad", by(joints, 1e3 * signals.tangential_joint), note=CHECKED))
        force = {"desired": signals.force_desired, "measured": signals.force_measured, "true": signals.force_true}
        found.append(Panel("Normal force of the wall on the robot", "N", force))
        found.append(Panel("Force error", "N", {"desired − true": signals.force_desired - signals.force_true}))
    found.append(Panel("Tip error: true bent tip − planned tip", "mm", by("xyz", 1e3 * signals.tip_error), note=YIELDS if signals.has_wall else ""))
    found.append(Panel("Torque as commanded", "N·m", by(joints, signals.torque), torque_limits(signals, effective["arm"]["torque_limit"])))
    names, arm = effective["arm"]["param_names"], effective["arm"]
    if signals.p_hat.shape[1] == len(names):
        for unit in dict.fromkeys(unit_of(arm, name) for name in names):
            numbers = [k for k, name in enumerate(names) if unit_of(arm, name) == unit]
            truth = tuple((arm["p_true"][k], place) for place, k in enumerate(numbers))
            found.append(Panel("Estimated parameters; dashed: the truth", unit, by([names[k] for k in numbers], signals.p_hat[:, numbers]), truth, NEED_NOT))
    if (book := lyapunov.of_run(signals, effective)) is not None and len(book.t) == len(signals.t):
        found.append(Panel("Stability: V and its parts", "J", {"V": book.V, **book.parts}, note=BALANCE))
    if recording.has("REED_TIMING"):
        table = recording.tables["REED_TIMING"]
        rows = rows_at(table, signals.cycle)
        found.append(Panel("Time per cycle", "µs", {name: table[f"{name}_ns"][rows] / 1e3 for name in ("cycle", "rx", "compute", "tx")}))
    return found


def by(names, values: np.ndarray) -> dict[str, np.ndarray]:
    return dict(zip(names, values.T))


def torque_limits(signals: Signals, limits: list[float]) -> tuple[tuple[float, int], ...]:
    used = np.abs(signals.torque).max(axis=0)
    return tuple((sign * limit, j) for j, limit in enumerate(limits[:signals.dof]) if used[j] > NEAR_LIMIT * limit for sign in (1.0, -1.0))


def data(signals: Signals | None, recording: Recording, effective: dict, reason: dict | None, colours) -> dict | None:
    """For the page. Of a long run every n-th sample."""
    if signals is None:
        return None
    every = 1 + len(signals.t) // MOST_ROWS
    return {"t": floats(signals.t[::every]), "every": every, "colours": list(colours),
            "marks": [[round(t, 6), text, colour if colour.startswith("#") else "#595959"] for t, text, colour in marks.times(signals, reason)],
            "panels": [{"title": panel.title, "note": panel.note, "unit": panel.unit, "names": list(panel.curves), "limits": panel.limits,
                        "values": floats(np.stack([curve[::every] for curve in panel.curves.values()]))}
                       for panel in panels(signals, recording, effective)]}
