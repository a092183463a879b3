"""Runs experiments in lockstep, some side by side, and keeps the signals of each. What was run once with the same
configuration and the same programs is not run again."""

import hashlib
import json
import shutil
import subprocess
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from reed_tools import versions
from reed_tools.errors import RunError
from reed_tools.paper.catalogue import Experiment
from reed_tools.paths import PYTHON
from reed_tools.record import configuration, telemetry_log
from reed_tools.record.signals import Signals, join
from reed_tools.run import hil, plans, scenario
from reed_tools.run.command import STOPPED, last_line, what_failed

POLL_S = 0.05


@dataclass
class Result:
    experiment: Experiment
    effective: dict
    signals: Signals | None
    stopped: str | None      # why the arm stopped before the end


@dataclass
class Job:
    experiment: Experiment
    folder: Path
    plan: hil.Plan
    process: subprocess.Popen
    started: float


def prepare(experiments: list[Experiment], cache: Path) -> dict[str, Path]:
    """Folder of each experiment, named by what decides its outcome and what is kept of it; every configuration is checked before the first run."""
    cache.mkdir(parents=True, exist_ok=True)
    kept, folders = (versions.build(plans.names(hil.MEMORY).values()) + " ".join(Signals.__dataclass_fields__)).encode(), {}
    for experiment in experiments:
        draft = cache / "draft.toml"
        scenario.write_effective(experiment.scenario, None, experiment.entries(), draft)
        name = hashlib.sha256(draft.read_bytes() + kept).hexdigest()[:20]
        folders[experiment.key] = cache / name
        folders[experiment.key].mkdir(exist_ok=True)
        draft.replace(folders[experiment.key] / "effective.toml")
    return folders


def done(folder: Path) -> bool:
    return (folder / "signals.npz").exists()


def run_all(experiments: list[Experiment], cache: Path, jobs: int, report) -> list[Result]:
    """report(event, experiment, seconds): "kept", "started", "at" (seconds into the run) or "done"."""
    folders = prepare(experiments, cache)
    waiting = [experiment for experiment in experiments if not done(folders[experiment.key])]
    for experiment in experiments:
        if experiment not in waiting:
            report("kept", experiment, 0.0)
    active: list[Job] = []
    try:
        while waiting or active:
            while waiting and len(active) < jobs:
                active.append(start(waiting[0], folders[waiting[0].key]))
                report("started", waiting.pop(0), 0.0)
            time.sleep(POLL_S)
            for job in list(active):
                if job.process.poll() is None:
                    report("at", job.experiment, seconds_into(job))
                    continue
                active.remove(job)
                keep(job)
                report("done", job.experiment, time.monotonic() - job.started)
    finally:
        for job in active:
            hil.stop(job.process)
    return [load(experiment, folders[experiment.key]) for experiment in experiments]


def start(experiment: Experiment, folder: Path) -> Job:
    for stale in folder.iterdir():  # of a run that did not end well
        if stale.name != "effective.toml":
            stale.unlink() if stale.is_file() else shutil.rmtree(stale)
    config = folder / "effective.toml"
    plan = plans.make(configuration.load(config), config, hil.MEMORY, "lockstep", folder, lcm=False, candump=False)
    (folder / "plan.json").write_text(json.dumps(asdict(plan)))
    with open(folder / "progress.txt", "wb") as output:
        process = subprocess.Popen([*PYTHON, str(hil.PROGRAM), str(folder / "plan.json")],
                                   stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                                   start_new_session=True, preexec_fn=hil.die_with_parent)
    return Job(experiment, folder, plan, process, time.monotonic())


def seconds_into(job: Job) -> float:
    lines = (job.folder / "progress.txt").read_text(errors="replace").splitlines()
    marks = [line for line in lines if line.startswith(hil.PROGRESS_MARK)]
    return float(marks[-1].split()[-1]) if marks else 0.0


def keep(job: Job) -> None:
    """Signals into the cache, then the raw records go: a page needs a tenth of them."""
    path = job.folder / "outcome.json"
    if job.process.returncode != 0 or not path.exists():
        raise RunError(f"{job.experiment.key}: {(job.folder / 'progress.txt').read_text(errors='replace')[-500:].strip()}")
    outcome = hil.Outcome(**json.loads(path.read_text()))
    complaint = what_failed(job.plan, outcome)
    if outcome.interrupted or complaint:
        raise RunError(f"{job.experiment.key}: {complaint or 'interrupted'}")
    logs = [job.plan.log("firmware"), job.plan.log("plant")]
    signals = join(telemetry_log.load(*logs))
    if signals is None:
        raise RunError(f"{job.experiment.key}: the arm never became active: {last_line(job.plan, job.plan.controller)}")
    stopped = last_line(job.plan, job.plan.controller) if STOPPED in outcome.statuses.values() else ""
    np.savez(job.folder / "part.npz", stopped=stopped, **vars(signals))
    (job.folder / "part.npz").replace(job.folder / "signals.npz")
    for raw in logs:
        raw.unlink(missing_ok=True)


def load(experiment: Experiment, folder: Path) -> Result:
    with np.load(folder / "signals.npz") as kept:
        values = {name: kept[name] for name in kept.files}
    stopped = str(values.pop("stopped"))
    values["has_wall"] = bool(values["has_wall"])
    return Result(experiment, configuration.load(folder / "effective.toml"), Signals(**values), stopped or None)


def forget(cache: Path) -> None:
    """The next call runs everything again."""
    if cache.exists():
        shutil.rmtree(cache)


