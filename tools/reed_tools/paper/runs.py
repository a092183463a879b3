"""Runs experiments in lockstep, some side by side, and keeps the signals of each. What was run once with the same
configuration and the same programs is not run again."""

import hashlib
import io
import shutil
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from reed_tools.errors import RunError
from reed_tools.paper.catalogue import Experiment
from reed_tools.record import configuration
from reed_tools.record.signals import Signals, join
from reed_tools.record.whole_file import replacing
from reed_tools.run import hil, in_memory, scenario
from reed_tools.run.command import last_line, what_failed

CONFIG = "effective.toml"


@dataclass
class Result:
    experiment: Experiment
    effective: dict
    signals: Signals | None
    stopped: str | None      # why the arm stopped before the end


def prepare(experiments: list[Experiment], cache: Path) -> dict[str, Path]:
    """Folder of each experiment, named by what decides its outcome and what is kept of it; every configuration is checked before the first run."""
    cache.mkdir(parents=True, exist_ok=True)
    kept, folders = (in_memory.build() + " ".join(Signals.__dataclass_fields__)).encode(), {}
    for experiment in experiments:
        draft = cache / "draft.toml"
        scenario.write_effective(experiment.scenario, None, experiment.entries(), draft)
        name = hashlib.sha256(draft.read_bytes() + kept).hexdigest()[:20]
        folders[experiment.key] = cache / name
        folders[experiment.key].mkdir(exist_ok=True)
        draft.replace(folders[experiment.key] / CONFIG)
    return folders


def done(folder: Path) -> bool:
    return (folder / "signals.npz").exists()


def run_all(engine_of, experiments: list[Experiment], cache: Path, report) -> list[Result]:
    """`engine_of()` is entered where something has to run. report(event, experiment, seconds): "kept" or "done"."""
    folders = prepare(experiments, cache)
    waiting = {experiment.key: experiment for experiment in experiments if not done(folders[experiment.key])}
    for experiment in experiments:
        if experiment.key not in waiting:
            report("kept", experiment, 0.0)
    if waiting:
        with engine_of() as engine:
            for (key, _), (content, seconds) in engine.map(run_one, [(key, text_of(folders[key])) for key in waiting]):
                keep(folders[key], content)
                report("done", waiting[key], seconds)
            if engine.interrupted:
                raise KeyboardInterrupt
    return [load(experiment, folders[experiment.key]) for experiment in experiments]


def text_of(folder: Path) -> str:
    return (folder / CONFIG).read_text(encoding="utf-8")


def keep(folder: Path, content: bytes) -> None:
    """Whole or not at all: what is there counts as done."""
    with replacing(folder / "signals.npz") as file:
        file.write(content)


def run_one(job: tuple[str, str], interrupted: list) -> tuple[bytes, float] | None:
    """In a worker: (an experiment's key, its configuration) to its signals as a file's content, and the seconds that it took."""
    (key, text), started = job, time.monotonic()
    with tempfile.TemporaryDirectory(prefix="reed-paper-") as scratch:
        config = Path(scratch, CONFIG)
        config.write_text(text, encoding="utf-8")
        ended = in_memory.run(configuration.load(config), config, Path(scratch), interrupted)
        if ended.outcome.interrupted:
            return None
        if complaint := what_failed(ended.plan, ended.outcome):
            raise RunError(f"{key}: {complaint}")
        signals = join(ended.recording())
        if signals is None:
            raise RunError(f"{key}: the arm never became active: {last_line(ended.plan, ended.plan.controller)}")
        stopped = last_line(ended.plan, ended.plan.controller) if ended.status == hil.STOPPED else ""
    content = io.BytesIO()
    np.savez(content, stopped=stopped, **vars(signals))
    return content.getvalue(), time.monotonic() - started


def load(experiment: Experiment, folder: Path) -> Result:
    with np.load(folder / "signals.npz") as kept:
        values = {name: kept[name] for name in kept.files}
    stopped = str(values.pop("stopped"))
    values["has_wall"] = bool(values["has_wall"])
    return Result(experiment, configuration.load(folder / CONFIG), Signals(**values), stopped or None)


def forget(cache: Path) -> None:
    """The next call runs everything again."""
    if cache.exists():
        shutil.rmtree(cache)


