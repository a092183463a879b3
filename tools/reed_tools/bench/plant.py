"""The bending plant beside MuJoCo: simulated over processor time of the arm a5 pressing on a wall, one core, one run.
`tools/reed bench plant`.

MuJoCo has the same motors and elastic joints; its members are rigid pieces joined by elastic hinges (mujoco_chain.py).
Each of its integrators runs at the largest step of 4 ms / √2^k at which the state stays bounded. The error of a step is the
largest distance between the tip's path to rest and the same side's path at steps of 10 us: what the step costs in accuracy, not
what the model does."""

import functools
import importlib.util
import json
import subprocess
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from reed_tools.bench import programs
from reed_tools.bench.rows import Found, Row
from reed_tools.errors import RunError
from reed_tools.paths import program

DEFAULT_STEP_S = 1e-3        # plant.max_step_s
ELEMENTS = (1, 2, 3, 4)      # per member; 1 is the default
JOINTS = (2, 3, 4, 5, 6, 7, 8)   # of a chain of equal links, one element each
CUTS = (1, 2, 4)             # of MuJoCo's members: 16, 22, 34 coordinates
STEPS_S = [4e-3 / 2 ** (k / 2) for k in range(22)]
INTEGRATORS = ("RK4", "implicit", "implicitfast")
FINE_STEP_S = 1e-5
PATH_S, PATH_EVERY_S = 0.3, 0.01
FASTEST_RADPS = 50.0         # a held arm that moves faster than this has come apart
SLICE_S, SLICES = 0.05, 30     # simulated; the quickest counts


@dataclass
class Cost:
    side: str
    coordinates: int
    step_s: float
    times_real_time: float
    error_mm: float | None = None    # of the tip's path, against steps of FINE_STEP_S


def measure(_arguments, folder: Path) -> Found:
    """Both sides; draws folder/plant_speed.png. Every anchor has fewer coordinates than the plant."""
    if not importlib.util.find_spec("mujoco"):
        return Found(notes=["the plant is not compared: MuJoCo is missing, it comes with tools/requirements-test.txt"])
    programs.build("plant_probe")
    ours = [plant(0, elements, step) for elements in ELEMENTS for step in (DEFAULT_STEP_S, DEFAULT_STEP_S / 2)]
    joints = [plant(count, 1, DEFAULT_STEP_S) for count in JOINTS]
    theirs = mujoco_costs(probe("arm"))
    from reed_tools.bench import plant_plot  # matplotlib: after the measurement

    plant_plot.draw(ours, joints, theirs, folder / "plant_speed.png")
    default = next(cost for cost in ours if cost.step_s == DEFAULT_STEP_S)
    rows = [Row(f"bending plant, {default.coordinates} coordinates, step error {default.error_mm:.2g} mm, × real time",
                default.times_real_time, cost.times_real_time, "×", 1.0,
                f"MuJoCo {cost.side}, {cost.coordinates} coordinates, step error {cost.error_mm:.2g} mm", less_is_better=False)
            for cost in theirs]
    return Found(rows, details={"plant": [asdict(cost) for cost in (*ours, *joints, *theirs)]})


def probe(*arguments) -> dict:
    done = subprocess.run([program("plant_probe"), *map(str, arguments)], capture_output=True, text=True)
    if done.returncode:
        raise RunError(f"plant_probe ended with status {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def plant(joints: int, elements: int, step_s: float) -> Cost:
    """a5, or a chain of so many equal links where `joints` is not zero."""
    found = probe("bench", joints, 1, elements, step_s, SLICES * SLICE_S)
    side = f"{joints} joints" if joints else f"{elements} element{'s' if elements > 1 else ''} per member"
    error_mm = None if joints else farthest_mm(path(found), fine_path(elements))
    return report(Cost(side, found["coordinates"], step_s, 1.0 / found["cpu_per_simulated_s"], error_mm), "plant")


@functools.cache
def fine_path(elements: int) -> np.ndarray:
    return path(probe("bench", 0, 1, elements, FINE_STEP_S, PATH_S))


def path(found: dict) -> np.ndarray:
    return np.reshape(found["path_m"], (-1, 3))[:round(PATH_S / PATH_EVERY_S)]


def farthest_mm(tips_m: np.ndarray, reference_m: np.ndarray) -> float:
    return 1e3 * float(np.linalg.norm(tips_m - reference_m, axis=1).max())


def report(cost: Cost, whose: str) -> Cost:
    error = "" if cost.error_mm is None else f"{cost.error_mm:9.2g} mm step error"
    print(f"  {whose:7}{cost.side:23}{cost.coordinates:4} coordinates{1e6 * cost.step_s:6.0f} us{cost.times_real_time:8.1f} x real time{error}", flush=True)
    return cost


def mujoco_costs(arm: dict) -> list[Cost]:
    import mujoco
    from reed_tools.robots.mujoco_chain import Chain, at_pose
    mujoco.set_mju_user_warning(lambda _: None)   # what comes apart is counted here, not written into files
    costs = []
    for cuts in CUTS:
        for integrator in INTEGRATORS:
            chain = Chain(arm, cuts, integrator)
            floor = float(at_pose(chain.model(FINE_STEP_S, None)).site("tip").xpos[2]) - 0.0015
            reference = mujoco_path(mujoco, chain.model(FINE_STEP_S, floor))
            for step in STEPS_S:
                model = chain.model(step, floor)
                if (spent := processor_time(mujoco, model, at_pose(model), step)) is not None:
                    error_mm = farthest_mm(mujoco_path(mujoco, model), reference)
                    costs.append(report(Cost(integrator, model.nv, step, 1.0 / spent, error_mm), "MuJoCo"))
                    break
    return costs


def mujoco_path(mujoco, model) -> np.ndarray:
    """The tip every PATH_EVERY_S; between two steps on the straight line that joins them."""
    from reed_tools.robots.mujoco_chain import at_pose
    data, times, tips = at_pose(model), [0.0], []
    tips.append(data.site("tip").xpos.copy())
    while times[-1] < PATH_S:
        mujoco.mj_step(model, data)
        mujoco.mj_kinematics(model, data)   # mj_step leaves the positions of its start
        times.append(data.time)
        tips.append(data.site("tip").xpos.copy())
    at = PATH_EVERY_S * np.arange(1, round(PATH_S / PATH_EVERY_S) + 1)
    return np.stack([np.interp(at, times, axis) for axis in np.transpose(tips)], axis=1)


def processor_time(mujoco, model, data, step_s: float) -> float | None:
    """Per simulated second, of the quickest slice; None when the arm comes apart."""
    fewest, steps = np.inf, max(1, round(SLICE_S / step_s))
    for _ in range(SLICES):
        start = time.process_time()
        mujoco.mj_step(model, data, nstep=steps)
        fewest = min(fewest, time.process_time() - start)
        if not np.isfinite(data.qpos).all() or not np.abs(data.qvel).max() < FASTEST_RADPS:
            return None
    if data.ncon == 0:
        raise RunError("MuJoCo's tool lost its contact: the comparison would not be one")
    return fewest / (steps * step_s)
