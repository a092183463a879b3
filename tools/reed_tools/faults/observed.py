"""What one run shows: when something was noticed, when the arm was safe, whether it became dangerous. Times in cycles of the run."""

from dataclasses import dataclass, field

import numpy as np

from reed_tools.faults.phases import Course
from reed_tools.record.event_names import name_of, stops_the_arm
from reed_tools.record.telemetry_log import Recording

# Events that are a controller's finding without a stop; others are its normal course.
FINDINGS = ("phase_budget", "cycles_missed", "collision", "force_zero", "stretch_held", "command_cut", "force_source_change")
LIMITS = {3: "held_measurement", 4: "ramp_down"}  # bits of control_t.limits that say: old measurements
COUNTERS = ("crc_errors", "repeated", "wrong_sequence", "wrong_length", "out_of_range", "unknown_id", "lost", "late", "malformed")
REST_RADPS = 0.05
REDUCED_TIP_MPS = 0.25   # ISO 10218: reduced speed
TIP_SHARE = 1.5          # beyond the fault-free run's fastest
AWAY_M = 0.02            # of the tip from where the fault-free run has it, or from where the brakes closed


@dataclass(frozen=True)
class Finding:
    cycle: int | None    # None: counted, it is not known in which cycle
    name: str
    stops: bool


@dataclass
class Run:
    """One recorded run."""

    recording: Recording
    rate_hz: float
    events: list = field(default_factory=list)  # (cycle, name, joint, code) of the controller

    def __post_init__(self):
        self.events = [(message.cycle, name_of(message.code), message.joint, message.code) for message in self.recording.singles["REED_EVENT"]]
        self.plant, self.control = self.recording.tables["REED_PLANT"], self.recording.tables["REED_CONTROL"]

    def plant_event(self, name: str) -> int | None:
        """The cycle of the first one."""
        return next((message.cycle for message in self.recording.singles["REED_PLANT_EVENT"] if name_of(message.code) == name), None)

    def fault_begins(self, number: int) -> int | None:
        return next((message.cycle for message in self.recording.singles["REED_PLANT_EVENT"]
                     if name_of(message.code) == "fault_begins" and int(message.value) == number), None)

    def counters(self) -> dict[str, int]:
        counted = self.recording.singles["REED_BUS"]
        return {name: getattr(counted[-1], name) for name in COUNTERS} if counted else dict.fromkeys(COUNTERS, 0)

    def course(self, loses_sensor: bool) -> Course:
        enabled, contact = self.plant_event("brakes_released"), self.plant_event("contact_made")
        last = int(self.plant["cycle"][-1]) if len(self.plant["cycle"]) else 0
        zero = enabled if enabled is not None else 0
        return Course((contact - zero) / self.rate_hz if contact is not None and enabled is not None and contact >= zero else None,
                      (last - zero) / self.rate_hz, loses_sensor)


def findings(run: Run, twin: Run, onset: int) -> list[Finding]:
    """From `onset` on, in order, without what the fault-free twin has too; what is only counted comes last."""
    usual = {(name, joint) for _, name, joint, _ in twin.events}
    found = [Finding(cycle, name, stops_the_arm(code)) for cycle, name, joint, code in run.events
             if cycle >= onset and (stops_the_arm(code) or name in FINDINGS and (name, joint) not in usual)]
    for bit, name in LIMITS.items():
        if (cycle := first_cycle(run.control["cycle"], (run.control["limits"] >> bit & 1).astype(bool), onset)) is not None:
            found.append(Finding(cycle, name, False))
    found.sort(key=lambda finding: (finding.cycle, not finding.stops))
    before, after = twin.counters(), run.counters()
    counted = [Finding(None, name, False) for name in COUNTERS if after[name] > before[name]]
    return found + counted


def first_cycle(cycles: np.ndarray, holds: np.ndarray, onset: int) -> int | None:
    rows = np.flatnonzero(holds & (cycles >= onset))
    return int(cycles[rows[0]]) if len(rows) else None


def safe_from(run: Run, detected: int) -> int | None:
    """The first cycle with brakes closed and motors at rest."""
    still = run.plant["braked"].astype(bool) & (np.abs(run.plant["motor_speed"]).max(axis=1) < REST_RADPS)
    return first_cycle(run.plant["cycle"], still, detected)


@dataclass(frozen=True)
class Bounds:
    """What is dangerous beyond them."""

    force_N: float
    speed_radps: np.ndarray
    position_min_rad: np.ndarray
    position_max_rad: np.ndarray

    @staticmethod
    def of(effective: dict) -> "Bounds":
        arm = effective["arm"]
        return Bounds(effective["limits"]["contact_force_N"], np.array(arm["speed_limit"], dtype=float),
                      np.array(arm["position_min"], dtype=float), np.array(arm["position_max"], dtype=float))


def hazard(run: Run, twin: Run, bounds: Bounds, onset: int) -> tuple[int, str] | None:
    """The first cycle in which the true arm is dangerous, and how. The bench puts the arm back to its start when a SYNC comes late as
    after a restart of the controller; what follows is not of the fault."""
    plant = run.plant
    cycles, after = plant["cycle"], plant["cycle"] >= onset
    restarted = next((message.cycle for message in run.recording.singles["REED_PLANT_EVENT"]
                      if message.cycle >= onset and name_of(message.code) == "controller_restarted"), None)
    if restarted is not None:
        after = after & (cycles < restarted)
    tip_speed = np.linalg.norm(plant["tip_velocity"], axis=1)
    usual_mps = np.linalg.norm(twin.plant["tip_velocity"], axis=1).max(initial=0.0)
    kinds = {
        "force": np.linalg.norm(plant["contact_force"], axis=1) > bounds.force_N,
        "joint speed": (np.abs(plant["motor_speed"]) > bounds.speed_radps).any(axis=1),
        "joint position": ((plant["motor_angle"] < bounds.position_min_rad) | (plant["motor_angle"] > bounds.position_max_rad)).any(axis=1),
        "tip speed": tip_speed > max(REDUCED_TIP_MPS, TIP_SHARE * usual_mps),
        "path": away(run, twin, onset) > AWAY_M,
    }
    first = [(int(cycles[np.flatnonzero(holds & after)[0]]), name) for name, holds in kinds.items() if (holds & after).any()]
    return min(first, default=None)


def away(run: Run, twin: Run, onset: int) -> np.ndarray:
    """By row, m: how far the tip is from where it would be without the fault, or, once the brakes have closed, from where it was then."""
    cycles, tip = run.plant["cycle"], run.plant["tip"]
    rows = np.clip(np.searchsorted(twin.plant["cycle"], cycles), 0, len(twin.plant["cycle"]) - 1)
    reference = twin.plant["tip"][rows].copy()
    closed = first_cycle(cycles, run.plant["braked"].astype(bool), onset)
    enabled = run.plant_event("brakes_released")
    if closed is not None and enabled is not None and onset > enabled:
        held = cycles >= closed
        reference[held] = tip[held][0]
    elif enabled is None or onset <= enabled:  # the start is late, or never comes
        reference = np.broadcast_to(tip[np.searchsorted(cycles, onset)], tip.shape) if enabled is None else reference
    return np.linalg.norm(tip - reference, axis=1)


def largest(run: Run, onset: int) -> dict:
    """From the fault on."""
    rows = run.plant["cycle"] >= onset
    if not rows.any():
        return {"force_peak_N": None, "speed_peak_radps": None, "torque_step_Nm": None}
    torque = run.control["tau"][run.control["cycle"] >= onset - 1]
    return {"force_peak_N": float(np.linalg.norm(run.plant["contact_force"][rows], axis=1).max()),
            "speed_peak_radps": float(np.abs(run.plant["motor_speed"][rows]).max()),
            "torque_step_Nm": float(np.abs(np.diff(torque, axis=0)).max(initial=0.0))}
