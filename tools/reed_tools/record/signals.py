"""The recorded channels joined by cycle: what the figures and the plots are made from. SI units."""

from dataclasses import dataclass, field

import numpy as np

from reed_tools.record.telemetry_log import Recording

MODES = ("off", "ready", "active", "fault")
SOURCES = ("none", "known", "unknown", "observer")
ACTIVE = MODES.index("active")
FAULT = MODES.index("fault")


@dataclass
class Signals:
    """Rows: cycles in which measurement, control, adaptation and the plant's truth were all recorded and the arm was
    active (t in s since then)."""

    t: np.ndarray                 # s
    cycle: np.ndarray
    joint_error: np.ndarray       # rad, planned reference minus motor-side angle, [n, dof]
    tangential_joint: np.ndarray  # rad, without the component along D, [n, dof]
    tip_error: np.ndarray         # m, true bent tip minus planned tip, [n, 3]
    tangential_tip: np.ndarray    # m, without the component along the wall's normal, [n, 3]
    force_desired: np.ndarray     # N
    force_measured: np.ndarray    # N, by the wrist sensor, tared
    force_true: np.ndarray        # N, normal force of the wall on the robot
    force_integral: np.ndarray    # N·s, of the force error, as the controller has it
    contact_force: np.ndarray     # N, true force of wall and disturbance on the robot, world axes, [n, 3]
    stiffness: np.ndarray         # N/m, estimate of the wall's (51)
    position: np.ndarray          # rad, motor-side angle as measured, [n, dof]
    reference_speed: np.ndarray   # rad/s, of the desired angle, [n, dof]
    error: np.ndarray             # rad, e (22), [n, dof]
    s: np.ndarray                 # rad/s, (23), [n, dof]
    observer: np.ndarray          # N·m, r (47), [n, dof]
    torque: np.ndarray            # N·m, as commanded, [n, dof]
    p_hat: np.ndarray             # [n, number of parameters]
    eta_hat: np.ndarray           # (39), [n, number of parameters]
    sigma: np.ndarray             # N·m·s/rad, N·m: (40), (41), [n, 2]
    source: np.ndarray            # index into SOURCES
    has_wall: bool
    law_names: np.ndarray = field(default_factory=lambda: np.array([], dtype=str))  # of the values that a law from outside shows
    law_values: np.ndarray = field(default_factory=lambda: np.empty((0, 0)))        # units of the law, [n, number of names]

    @property
    def dof(self) -> int:
        return self.joint_error.shape[1]


def remove_component(x: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """x - d (dᵀx)/(dᵀd) row by row; x where d is zero."""
    square = np.sum(direction * direction, axis=1, keepdims=True)
    along = np.sum(direction * x, axis=1, keepdims=True)
    return x - direction * np.divide(along, square, out=np.zeros_like(along), where=square > 0)


def join(recording: Recording) -> Signals | None:
    """None when no active cycle was recorded on all sides."""
    measured, control, adaptation, plant = (
        recording.tables[name] for name in ("REED_MEASURED", "REED_CONTROL", "REED_ADAPTATION", "REED_PLANT"))
    if not all(recording.has(name) for name in ("REED_MEASURED", "REED_CONTROL", "REED_ADAPTATION", "REED_PLANT")):
        return None
    cycles = np.unique(control["cycle"][control["mode"] == ACTIVE])
    for table in (measured, adaptation, plant):
        cycles = cycles[np.isin(cycles, table["cycle"])]
    if not len(cycles):
        return None

    def rows(table):
        order = np.argsort(table["cycle"], kind="stable")
        return order[np.searchsorted(table["cycle"], cycles, sorter=order)]

    rows_of = {id(table): rows(table) for table in (measured, control, adaptation, plant)}

    def pick(table, name):
        return table[name][rows_of[id(table)]]

    position = pick(measured, "position")
    joint_error = pick(control, "theta_plan") - position
    tip_error = pick(plant, "tip") - pick(control, "tip_plan")
    return Signals(
        t=pick(control, "t_s"), cycle=cycles, joint_error=joint_error,
        tangential_joint=remove_component(joint_error, pick(control, "D")),
        tip_error=tip_error, tangential_tip=remove_component(tip_error, pick(control, "normal")),
        force_desired=pick(control, "f_d"), force_measured=pick(control, "f"), force_true=pick(plant, "normal_force"),
        force_integral=pick(control, "e_f_integral"), contact_force=pick(plant, "contact_force"),
        stiffness=pick(control, "k_hat_e"), position=position, reference_speed=pick(control, "theta_d_dot"), error=pick(control, "e"), s=pick(control, "s"),
        observer=pick(control, "observer"), torque=pick(control, "tau"), p_hat=pick(adaptation, "p_hat"),
        eta_hat=pick(adaptation, "eta_hat"),
        sigma=np.stack([pick(adaptation, "sigma0"), pick(adaptation, "sigma1")], axis=1), source=pick(control, "force_source"),
        has_wall=bool(np.any(pick(plant, "gap") < 1e8)), law_names=np.array(recording.law_names, dtype=str),
        law_values=law_values(recording, cycles))


def law_values(recording: Recording, cycles: np.ndarray) -> np.ndarray:
    """One column per name; a cycle that was not recorded is no number."""
    law = recording.tables["REED_LAW"]
    found = np.full((len(cycles), len(recording.law_names)), np.nan)
    if found.size and len(law["cycle"]):
        _, to, row = np.intersect1d(cycles, law["cycle"], return_indices=True)
        found[to] = law["values"][row]
    return found
