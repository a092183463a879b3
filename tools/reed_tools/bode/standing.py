"""A scenario that stands still once it is there: its slides, sines and Fourier series become a hold, so that only the excitation moves the arm."""

from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.robots.joint_frames import dof

MOVING = ("joint", "cartesian")


def text(effective: Path) -> str:
    """Of a configuration as reed_config writes it."""
    blocks = effective.read_text(encoding="utf-8").split("[[reference.legs]]")
    return "[[reference.legs]]".join([blocks[0], *map(leg, blocks[1:])])


def leg(block: str) -> str:
    own, bracket, rest = block.partition("\n[")
    if not any(f"kind = {quote}{kind}{quote}" in own for kind in ("slide", "sine", "fourier") for quote in "'\""):
        return block
    kept = [line for line in own.splitlines() if line.split("=")[0].strip() == "duration_s"]
    return "\nkind = 'hold'\n" + "\n".join(kept) + "\n" + bracket + rest


def there_s(effective: dict) -> float:
    """When nothing is asked to move any more, after enabling."""
    end = 0.0
    for entry in effective["reference"].get("legs", []):
        if entry["kind"] not in MOVING:
            break
        end += entry["duration_s"]
    force = effective["force"]
    return max(end, force["start_s"] + force["ramp_s"]) if force["source"] != "none" and force["desired_N"] > 0 else end


def require_joint(effective: dict, joint: int) -> None:
    count = dof(effective["arm"])
    if not 1 <= joint <= count:
        raise UsageError(f"--joint {joint}: allowed: 1 to {count}")
