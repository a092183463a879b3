"""The phases of a scenario in which a fault begins, as its trigger. Which of them a scenario has, its fault-free run shows."""

from dataclasses import dataclass

PHASES = ("idle", "free", "approach", "contact", "pressing", "switch")
FREE_S = 0.1            # after the drives were enabled: the arm moves, nothing is touched
BEFORE_CONTACT_S = 0.05
PRESSING_S = 0.8        # after contact: the ramp of the force is over
SETTLED_S = 0.01


@dataclass(frozen=True)
class Course:
    """Of a fault-free run: when contact was made, in s since the drives were enabled; None without one."""

    contact_s: float | None
    end_s: float
    loses_sensor: bool


def triggers(course: Course) -> dict[str, dict]:
    """Phase -> keys of a [[fault]]."""
    found = {"idle": {"from_mode": "ready", "delay_s": SETTLED_S}, "free": {"from_s": FREE_S}}
    contact_s = course.contact_s
    if contact_s is not None and contact_s > FREE_S + BEFORE_CONTACT_S:
        found["approach"] = {"from_s": round(contact_s - BEFORE_CONTACT_S, 4)}
    if contact_s is not None:
        found["contact"] = {"from_event": "contact_made", "delay_s": SETTLED_S}
        if contact_s + PRESSING_S < course.end_s:
            found["pressing"] = {"from_event": "contact_made", "delay_s": PRESSING_S}
    if course.loses_sensor:
        found["switch"] = {"from_event": "wrench_lost", "delay_s": SETTLED_S}
    return found
