"""From a scenario and overrides to effective.toml and the halves of it that the programs read.

Names, keys, units and ranges are checked by the C++ reader (program reed_config): there is no second reader here.
"""

import subprocess
from pathlib import Path

from reed_tools.errors import RunError, UsageError
from reed_tools.figures import checks
from reed_tools.paths import program
from reed_tools.record import configuration
from reed_tools.robots.joint_frames import dof
from reed_tools.run import hil, joints

SHORT_OPTIONS = {"rate": "timing.rate_hz", "duration": "scenario.duration_s", "seed": "scenario.seed"}


def overrides(arguments) -> list[str]:
    """--set entries, then the options that are a number of the scenario under a shorter name."""
    given = {key: getattr(arguments, option) for option, key in SHORT_OPTIONS.items()}
    return [*arguments.set, *(f"{key}={value}" for key, value in given.items() if value is not None)]


def judged(scenario: str, entries: list[str], *options: str) -> str:
    """What reed_config prints of a scenario with `entries` over it; raises UsageError with its line where it refuses that."""
    command = [str(program("reed_config")), "--config", scenario, *options]
    for entry in entries:
        command += ["--set", entry]
    done = subprocess.run(command, capture_output=True, text=True, errors="surrogateescape")
    message = done.stderr.strip() or done.stdout.strip()
    if done.returncode == hil.REFUSED:
        raise UsageError(message)
    if done.returncode != 0:
        raise RunError(f"reed_config ended with status {done.returncode}: {message}")
    return done.stdout


def checked(scenario: str, arm: str | None, entries: list[str], target: Path, halves: bool = False) -> dict:
    """Validates everything, writes `target` and, with `halves`, beside it what each program may know; returns it parsed."""
    written = ["--write", str(target)]
    for name in hil.HALVES.values() if halves else ():
        written += [f"--write-{Path(name).stem}", str(target.with_name(name))]
    if arm:
        written += ["--arm", arm]
    judged(scenario, entries, *written)
    effective = configuration.load(target)
    checks.require_known(effective["checks"], where=scenario)
    return effective


def write_effective(scenario: str, arm: str | None, entries: list[str], target: Path, halves: bool = False) -> dict:
    """For a run: checked, and with the controller built for that many joints."""
    effective = checked(scenario, arm, entries, target, halves)
    joints.need(dof(effective["arm"]))
    return effective
