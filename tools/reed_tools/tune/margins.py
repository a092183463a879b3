"""The margins that gains leave, and what the configuration's rules say of gains that leave too little."""

import json
import subprocess
from dataclasses import dataclass

from reed_tools.errors import RunError, UsageError
from reed_tools.paths import program

REFUSED = 2


@dataclass(frozen=True)
class Margin:
    gain: float       # least over the joints
    phase_deg: float  # likewise


def of(scenario: str, entries: list[str]) -> Margin:
    """Raises UsageError with the rule that the gains break."""
    command = [str(program("reed_config")), "--config", scenario, "--margins"]
    for entry in entries:
        command += ["--set", entry]
    done = subprocess.run(command, capture_output=True, text=True, errors="surrogateescape")
    if done.returncode == REFUSED:
        raise UsageError(done.stderr.strip())
    if done.returncode:
        raise RunError(f"reed_config ended with status {done.returncode}: {done.stderr.strip()}")
    joints = json.loads(done.stdout)
    return Margin(min(joint["gain_margin"] for joint in joints), min(joint["phase_margin_deg"] for joint in joints))
