"""Scenarios that run at once and are meant to be edited: a press on a floor, or a motion in free space."""

import numpy as np

from reed_tools.robots.nominal import NominalArm
from reed_tools.scenarios import gains
from reed_tools.scenarios.pose import FREQUENCY_HZ, Pose, find, follow, reach_of

NORMAL = np.array([0.0, 0.0, 1.0])  # a floor
APPROACH_m, APPROACH_s = 0.004, 0.4
WALL_LOWER_m = 0.001           # than believed
STIFFNESS_Npm = 10000.0
PRESS_SLIDE, FREE_SLIDE = 0.025, 0.05  # amplitude as a share of the reach, above 2 cm nothing is gained by more when pressing
LARGEST_SLIDE_m = 0.02
PEAK = 1.875                   # largest speed of a leg, times its mean
FOLLOWING_SHARE, IMPACT = 0.1, 1.5  # limits.following_error_share as it is, and what an impact may make of a joint's speed
FORCE_LIMIT = (60.0, 2.5)      # N, and times the desired force: contact force that trips
LOOP_CHECKS = """[[checks]]
name = "torque_ripple_percent_last_second"   # more is an oscillation
limit = 2.0
[[checks]]
name = "faults"
limit = 0
[[checks]]
name = "heap_allocations"
limit = 0
"""


def press(arm: NominalArm, arm_file: str, force_N: float) -> str:
    pose = find(arm, NORMAL, force_N, min(PRESS_SLIDE * reach_of(arm.chain), LARGEST_SLIDE_m))
    wall = pose.tip - APPROACH_m * NORMAL
    limit = max(FORCE_LIMIT[0], FORCE_LIMIT[1] * force_N)

    def text(chosen: gains.Gains) -> str:
        return f"""# {arm.name} presses its tip on a floor that it believes {1e3 * WALL_LOWER_m:g} mm too high, and slides along it. Made by
# `tools/reed scenario new`, to be edited. Keys: config/README.md.
arm = "{arm_file}"

[scenario]
name = "press_{arm.name}"
description = "Press {force_N:g} N on a floor with the measured force, sliding along it."
duration_s = 3.0
seed = 1

[reference]
start_rad = {row(pose.q)}   # tip at {', '.join(f'{x:.3f}' for x in pose.tip)} m, {1e3 * APPROACH_m:g} mm above the believed floor
[[reference.legs]]
kind = "cartesian"                 # approach: down to the believed floor
duration_s = {APPROACH_s}
by_m = {row(-APPROACH_m * NORMAL)}
[[reference.legs]]
kind = "slide"                     # along the floor
duration_s = 60.0
amplitude_m = {row(pose.slide)}
frequency_hz = {FREQUENCY_HZ}

[wall]
present = true
point_m = {row(wall)}
normal = {row(NORMAL)}
offset_m = {-WALL_LOWER_m}
stiffness_Npm = {STIFFNESS_Npm}
damping_Nspm = 20.0
friction = 0.1

[force]
source = "known"
desired_N = {force_N:g}
start_s = 0.3
ramp_s = 0.5

[limits]
contact_force_N = {limit:g}
{following_error(arm, pose)}
[sensors]
force_range_N = {max(200.0, 2 * limit):g}
{plant(arm)}
{chosen.lines()}
[[checks]]
name = "tangential_joint_rms_mrad_last_second"
limit = 1.0
[[checks]]
name = "force_rms_percent_last_second"
limit = 3.0
{LOOP_CHECKS}"""

    return gains.accepted(gains.by_rule(arm, pose.q), text)


def following_error(arm: NominalArm, pose: Pose) -> str:
    """A wall that is met early stops the joints at once. Where that is more than the usual following error, it is allowed."""
    below = follow(arm.chain, pose.q, -APPROACH_m * NORMAL, pose.q)
    if below is None:
        return ""
    share = float((IMPACT * PEAK * np.abs(below - pose.q) / APPROACH_s / arm.speed_limit).max())
    return f"following_error_share = {np.ceil(100 * share) / 100:g}   # a wall that is met early stops the joints at once\n" if share > FOLLOWING_SHARE else ""


def free(arm: NominalArm, arm_file: str) -> str:
    pose = find(arm, NORMAL, 0.0, FREE_SLIDE * reach_of(arm.chain))

    def text(chosen: gains.Gains) -> str:
        return f"""# {arm.name} swings its tip through free space. Made by `tools/reed scenario new`, to be edited. Keys: config/README.md.
arm = "{arm_file}"

[scenario]
name = "free_{arm.name}"
description = "A slide of the tip through free space."
duration_s = 3.0
seed = 1

[reference]
start_rad = {row(pose.q)}   # tip at {', '.join(f'{x:.3f}' for x in pose.tip)} m
[[reference.legs]]
kind = "slide"
duration_s = 60.0
amplitude_m = {row(pose.slide)}
frequency_hz = {FREQUENCY_HZ}
{plant(arm)}
{chosen.lines()}
[[checks]]
name = "joint_rms_mrad_last_second"   # static deflection compensation included
limit = 4.0
{LOOP_CHECKS}"""

    return gains.accepted(gains.by_rule(arm, pose.q), text)


def plant(arm: NominalArm) -> str:
    return "" if arm.bends else "\n[plant]\nflexible_links = false   # the arm file has no members\n"


def row(values) -> str:
    return f"[{', '.join(f'{value:.6g}' for value in values)}]"
