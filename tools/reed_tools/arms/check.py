"""An arm file judged: whether bodies can have its inertias, whether its numbers are in the units they should be in, whether its
limits let it work, and whether its resonances suit the control rate. What the file's reader refuses is refused here too."""

import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from reed_tools.errors import RunError, UsageError
from reed_tools.paths import program
from reed_tools.robots import nominal
from reed_tools.robots.nominal import NominalArm
from reed_tools.robots.pseudo_inertia import matrix_of
from reed_tools.robots.regressor import PER_LINK, inverse_dynamics

MODES = 4
POSES, SEED = 300, 4
SMALLEST_m, LARGEST_m = 0.05, 5.0  # reach
HEAVIEST_kg = 300.0
SLOWEST_Hz = 4.0                  # first mode: below it K_d and Lambda by rule excite it
SAMPLES_PER_MODE = 20.0           # periods of the loop in one of the first mode
STILL = 1e-12


def judge(name: str, rate_hz: float) -> dict:
    if not rate_hz > 0:
        raise UsageError(f"--rate {rate_hz:g}: has to be above 0")
    path = nominal.path_of(name)
    arm = nominal.load(name)
    modes = modes_of(path)
    warnings = [*bodies(arm), *units(arm), *limits(arm), *resonances(modes, rate_hz)]
    return {"arm": arm.name, "dof": arm.dof, "mass_kg": float(arm.inertial[::PER_LINK].sum()), "reach_m": float(reach(arm)),
            "warnings": warnings, "modes_hz": modes}


def modes_of(path: Path) -> list[float]:
    """By the program that knows the flexible arm; it reads the file as a run does. Empty for an arm without stiffness."""
    done = subprocess.run([str(program("reed_inspect")), "--arm", str(path), "--modes", str(MODES)], capture_output=True, text=True)
    if done.returncode == 0:
        return json.loads(done.stdout)["freq_hz"]
    if done.returncode == 2 and "joint_stiffness" in done.stderr:
        with tempfile.NamedTemporaryFile("w", suffix=".json") as states:  # still: does the reader take the file?
            states.write('{"cases": []}')
            states.flush()
            done = subprocess.run([str(program("reed_inspect")), "--arm", str(path), "--states", states.name], capture_output=True, text=True)
        if done.returncode == 0:
            return []
    if done.returncode == 2:
        raise UsageError(done.stderr.strip().removeprefix("reed_inspect: "))
    raise RunError(f"reed_inspect ended with status {done.returncode}: {done.stderr.strip()}")


def bodies(arm: NominalArm) -> list[str]:
    """Nominal links; the reader has checked shapes and bodies one by one, not what they add up to."""
    found = []
    for link, body in enumerate(arm.inertial.reshape(arm.dof, PER_LINK)):
        if body[0] <= 0:
            if np.abs(body[:4]).max() > STILL:
                found.append(f"link {link + 1}: mass {body[0]:g} kg with a first moment")
            continue
        least = np.linalg.eigvalsh(matrix_of(body))
        if least[0] < -1e-6 * least[-1]:
            found.append(f"link {link + 1}: no body has its nominal mass {body[0]:.3g} kg, first moment and inertia")
    return found


def units(arm: NominalArm) -> list[str]:
    found, far = [], reach(arm)
    if not SMALLEST_m <= far <= LARGEST_m:
        found.append(f"reach {far:.3g} m: lengths in metres?")
    mass = arm.inertial[::PER_LINK].sum()
    if mass > HEAVIEST_kg or (mass > 0 and mass < 1e-3):
        found.append(f"{mass:.3g} kg in all: masses in kilograms?")
    for link, body in enumerate(arm.inertial.reshape(arm.dof, PER_LINK)):
        if body[0] > 0:
            radius = np.sqrt(max(matrix_of(body)[:3, :3].trace() / body[0], 0.0))
            if radius > max(far, SMALLEST_m):
                found.append(f"link {link + 1}: radius of gyration {radius:.3g} m is beyond the arm's reach: inertia in kg·m², first moment in kg·m?")
    span = arm.position_max - arm.position_min
    found += [f"joint {joint + 1}: its range is {width:.2g} rad: limits in radians?" for joint, width in enumerate(span) if width < 0.05]
    return found


def limits(arm: NominalArm) -> list[str]:
    if not np.isfinite(arm.torque_limit).all():
        return ["torque_limit is missing: no run without it"]
    q = np.random.default_rng(SEED).uniform(arm.position_min, arm.position_max, (POSES, arm.dof))
    held = np.abs(inverse_dynamics(arm.chain, q, 0 * q, 0 * q) @ arm.inertial)
    return [f"joint {joint + 1}: its torque limit {arm.torque_limit[joint]:g} N·m holds the arm's weight in {100 * share:.0f} % of poses"
            for joint, share in enumerate((held < arm.torque_limit).mean(axis=0)) if share < 0.9]


def resonances(modes: list[float], rate_hz: float) -> list[str]:
    if not modes:
        return []
    first = modes[0]
    if first < SLOWEST_Hz:
        return [f"the first mode with locked motors has {first:.2g} Hz, below {SLOWEST_Hz:g} Hz: gains by rule excite it"]
    if rate_hz < SAMPLES_PER_MODE * first:
        return [f"{rate_hz:g} Hz are {rate_hz / first:.3g} cycles in a period of the first mode, {first:.3g} Hz; {SAMPLES_PER_MODE:g} and more are needed"]
    return []


def reach(arm: NominalArm) -> float:
    return float(np.linalg.norm(arm.chain.offset[1:], axis=1).sum() + np.linalg.norm(arm.chain.tool_offset))
