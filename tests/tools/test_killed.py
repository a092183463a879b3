"""kill -9 of a program at any moment: every file that it wrote is readable, lacks at most a second, and report and replay say what is missing."""

import json
import os
import re
import signal
import subprocess
import time

import numpy as np
import own_address
import pytest

from reed_tools import cli
from reed_tools.figures import animation, curves, plots, report_page
from reed_tools.paths import build, program
from reed_tools.record import event_file, tape
from reed_tools.run import scenario

MOST_LOST_s = 1.0
VICTIMS = {"one process": ["both"], "controller": ["firmware"], "plant": ["plant"], "controller and plant": ["plant", "firmware"]}
RUN_s = 60.0


@pytest.fixture(scope="module", autouse=True)
def built():
    build("reed_firmware", "reed_plant_sim", "reed_one_process", "reed_replay", "reed_lcmtypes_generate")


@pytest.fixture(autouse=True)
def no_pictures(monkeypatch):
    """They take seconds each and are no record."""
    monkeypatch.setattr(plots, "draw_all", lambda *_: [])
    monkeypatch.setattr(animation, "data", lambda *_: None)
    monkeypatch.setattr(curves, "data", lambda *_: None)
    monkeypatch.setattr(report_page, "write", lambda *_: None)


@pytest.fixture(scope="module")
def configuration(tmp_path_factory):
    path = tmp_path_factory.mktemp("configuration") / "effective.toml"
    scenario.write_effective("press_known", None, [f"scenario.duration_s={RUN_s}"], path, halves=True)
    return path


def start(names, configuration, folder) -> dict[str, subprocess.Popen]:
    """Programs by name, as tools/reed run starts them; they run."""
    for name in ("effective.toml", "controller.toml", "plant.toml"):
        (folder / name).write_bytes((configuration.parent / name).read_bytes())
    keeps = ["--candump", str(folder / "bus.candump"), "--tape", str(folder / tape.NAME), "--enable"]
    logs = {name: ["--log", str(folder / f"{name}.lcmlog")] for name in ("firmware", "plant")}
    bus = ["--bus", own_address.bus(), "--clock", "realtime"]
    commands = {"both": [program("reed_one_process"), "--config", folder / "effective.toml", *logs["firmware"], "--plant-log", folder / "plant.lcmlog", *keeps]} \
        if names == ["both"] else {"plant": [program("reed_plant_sim"), "--config", folder / "plant.toml", *bus, *logs["plant"]],
                                   "firmware": [program("reed_firmware"), "--config", folder / "controller.toml", *bus, *logs["firmware"], *keeps]}
    started = {}
    for name, command in commands.items():
        with open(folder / f"{name}.txt", "wb") as said:
            started[name] = subprocess.Popen([*map(str, command), "--no-lcm"], stdout=said, stderr=said)
        if name == "plant":
            wait_for(lambda: b"waiting for SYNC" in (folder / "plant.txt").read_bytes())
    wait_for(lambda: (folder / tape.NAME).exists() and (folder / tape.NAME).stat().st_size > 100_000)
    return started


def wait_for(met) -> None:
    end = time.monotonic() + 60
    while not met():
        assert time.monotonic() < end
        time.sleep(0.01)


def of_tape(path, row: int) -> float:
    """Time of day of a cycle, in s; the clock of a tape is the loop's."""
    return tape.read(path)["time_ns"][row] / 1e9 + time.time() - time.monotonic()


def last_of(path) -> float:
    """Time of day of the last record that can be read, in s; of the first cycle where there is none yet."""
    if path.name == tape.NAME:
        return of_tape(path, -1)
    if path.suffix == ".lcmlog":
        return max((event.time_us / 1e6 for event in event_file.read(path)), default=of_tape(path.with_name(tape.NAME), 0))
    lines = path.read_text().splitlines()
    shape = re.compile(r"\((\d+\.\d{6})\) \S+ [0-9A-F]{3}##1[0-9A-F]+$")
    assert all(map(shape.match, lines[:-1])), "every line but the one that was cut"
    return float(shape.match(lines[-2])[1])


def kill_at(moment_s: float, victims, configuration, folder, capsys) -> dict[str, float]:
    """Seconds that each file lacks; -1 where no clock paces the run."""
    running = start(victims, configuration, folder)
    time.sleep(moment_s)
    killed_s = time.time()
    for victim in victims:
        running[victim].send_signal(signal.SIGKILL)
    for victim in victims:
        running[victim].wait()
    for other in running.values():
        if other.poll() is None:
            other.send_signal(signal.SIGINT)
            other.wait(20)
    of_victims = {"both": [tape.NAME, "firmware.lcmlog", "plant.lcmlog", "bus.candump"], "firmware": [tape.NAME, "firmware.lcmlog", "bus.candump"],
                  "plant": ["plant.lcmlog"]}
    lost = {name: killed_s - last_of(folder / name) for victim in victims for name in of_victims[victim]}
    statuses = [cli.main(["report", str(folder), "--json"]), cli.main(["replay", str(folder), "--json"])]
    said = capsys.readouterr()
    summary, replayed = map(json.loads, said.out.splitlines())
    assert statuses == [1, 0], said.err
    missing = {check["name"]: check["value"] for check in summary["checks"]}["missing_s"]
    assert 0.0 < missing <= RUN_s, "the report's check says how much of the run is missing"
    assert replayed["same"] and replayed["cycles"] > 50
    if victims != ["plant"]:
        assert re.search("without its end|cut or damaged", replayed["missing"])
    return dict.fromkeys(lost, -1.0) if victims == ["both"] else lost


@pytest.mark.parametrize("victims", VICTIMS.values(), ids=VICTIMS)
def test_a_killed_program_leaves_its_records(victims, configuration, tmp_path, capsys):
    lost = kill_at(0.3, victims, configuration, tmp_path, capsys)
    assert max(lost.values()) < MOST_LOST_s


@pytest.mark.long
def test_at_many_random_moments(configuration, tmp_path, capsys):
    times, generator, most = int(os.environ.get("REED_LONG_TIMES", "200")), np.random.default_rng(5), {}
    for number in range(times):
        name = list(VICTIMS)[number % len(VICTIMS)]
        folder = tmp_path / str(number)
        folder.mkdir()
        for file, seconds in kill_at(generator.uniform(0.0, 1.2), VICTIMS[name], configuration, folder, capsys).items():
            most.setdefault((name, file), []).append(seconds)
        for path in folder.iterdir():
            path.unlink()
        if number % 20 == 19:
            with capsys.disabled():
                print(f"\n{number + 1}: most lost, s: " + ", ".join(f"{file} of {name} {max(values):.3f}" for (name, file), values in most.items()), flush=True)
    assert max(max(values) for values in most.values()) < MOST_LOST_s
