"""The margins that gains leave, and what the configuration's rules say of gains that leave too little."""

import json
from dataclasses import dataclass

from reed_tools.run import scenario


@dataclass(frozen=True)
class Margin:
    gain: float       # least over the joints
    phase_deg: float  # likewise


def of(name: str, entries: list[str]) -> Margin:
    """Raises UsageError with the rule that the gains break."""
    joints = json.loads(scenario.judged(name, entries, "--margins"))
    return Margin(min(joint["gain_margin"] for joint in joints), min(joint["phase_margin_deg"] for joint in joints))
