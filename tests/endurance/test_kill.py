"""kill -9 of each program at any moment: the other one ends or goes on as it should, the brakes close in time, and what was recorded
until a second before is there."""

import random
import signal
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from long_mode import how_many

from reed_tools.paths import build, program
from reed_tools.record import tape, telemetry_log
from reed_tools.run import hil, plans, scenario

KILLS = how_many(4, 1000)  # of each program
SIDE_BY_SIDE = 4
STATED_LOSS_S = 1.0
LATE_BYTES = 2_000_000  # of records; the controller's are 1.3 kB in a cycle
RATE_HZ = 1000.0
BRAKE_CYCLES = 20           # drives.command_timeout_cycles
SETTINGS = ["timing.max_missed_in_row=1000", "timing.overrun=skip", "limits.stop_age_cycles=900", "scenario.duration_s=30"]


@pytest.fixture(scope="module")
def config(tmp_path_factory):
    build("reed_firmware", "reed_plant_sim", "reed_one_process")
    path = tmp_path_factory.mktemp("config") / "effective.toml"
    scenario.write_effective("free_motion", None, SETTINGS, path)
    return path


def side_by_side(one, kills: int = KILLS) -> list:
    """one(lane, numbers of its kills) in several threads: the programs wait for most of their time."""
    shares = [range(lane * kills // SIDE_BY_SIDE, (lane + 1) * kills // SIDE_BY_SIDE) for lane in range(SIDE_BY_SIDE)]
    with ThreadPoolExecutor(SIDE_BY_SIDE) as lanes:
        return [found for part in lanes.map(one, range(SIDE_BY_SIDE), shares) for found in part]


class Pair:
    """Both programs by the clock, on a bus of their own."""

    def __init__(self, config, folder, lane):
        self.config, self.folder, self.bus = config, folder, f"udp:239.74.163.34:{43914 + lane}"
        self.output = open(folder / "output.txt", "ab")

    def start(self, name, *options):
        command = [program(name), "--config", self.config, "--bus", self.bus, "--clock", "realtime", "--no-lcm", *options]
        return subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=self.output, stderr=self.output)

    def plant(self):
        heard = (self.folder / "output.txt").stat().st_size
        process = self.start("reed_plant_sim", "--log", self.folder / "plant.lcmlog")
        end = time.monotonic() + 20
        while b"waiting for SYNC" not in (self.folder / "output.txt").read_bytes()[heard:] and time.monotonic() < end:
            time.sleep(0.005)
        return process

    def firmware(self):
        for name in ("firmware.lcmlog", tape.NAME):
            (self.folder / name).unlink(missing_ok=True)
        return self.start("reed_firmware", "--enable", "--log", self.folder / "firmware.lcmlog", "--tape", self.folder / tape.NAME)


def wait_for_moment(number: int, chance, records: Path) -> None:
    """Until the kill with this number: one of four in the start-up, one later than what a crash may cost, two in between. By what is
    recorded, not by the clock: a busy machine is slow to start."""
    if number % 4 == 3:
        time.sleep(chance.uniform(0.0, 0.2))
        return
    size, end = LATE_BYTES * (1.0 if number % 4 == 0 else chance.uniform(0.0, 0.5)), time.monotonic() + 60
    while (not records.exists() or records.stat().st_size <= size) and time.monotonic() < end:
        time.sleep(0.005)
    time.sleep(chance.uniform(0.0, 0.05))


def rows(folder, name: str) -> dict:
    """What the controller or the plant has recorded."""
    path = folder / f"{name}.lcmlog"
    channel = "REED_PLANT" if name == "plant" else "REED_MEASURED"
    if not path.exists() or path.stat().st_size == 0:
        return {"cycle": np.zeros(0), "age": np.zeros((0, 5))}
    return telemetry_log.load(path).tables[channel]


def test_a_controller_that_is_killed_leaves_closed_brakes_and_its_records(config, tmp_path):
    def kills(lane, numbers):
        folder = tmp_path / str(lane)
        folder.mkdir()
        pair, chance, found, before = Pair(config, folder, lane), random.Random(lane), [], 0
        plant = pair.plant()
        try:
            for number in numbers:
                controller = pair.firmware()
                wait_for_moment(number, chance, folder / "firmware.lcmlog")
                alive = controller.poll() is None
                controller.kill()
                controller.wait()
                time.sleep(0.2)  # the plant's own records reach their file
                answered = len(rows(folder, "plant")["cycle"])
                found.append((alive, answered - before, len(rows(folder, "firmware")["cycle"]), whole_tape(folder)))
                before = answered
            assert plant.poll() is None, "the arm outlives its controllers"
        finally:
            plant.send_signal(signal.SIGINT)
            assert plant.wait(20) == 0
        opened.append(closed_in_time(telemetry_log.load(folder / "plant.lcmlog")))
        return found

    opened = []
    found = side_by_side(kills)
    assert sum(opened) >= 0.25 * KILLS, "brakes that nobody opened prove nothing"
    assert len(found) == KILLS and sum(alive for alive, *_ in found) >= 0.75 * KILLS
    assert max(answered for _, answered, *_ in found) > 1.1 * RATE_HZ, "some were killed later than what a crash may cost"
    for _, answered, logged, taped in found:
        assert min(logged, taped) >= answered - STATED_LOSS_S * RATE_HZ, found


def whole_tape(folder) -> int:
    path = folder / tape.NAME
    return len(tape.read(path)) if path.exists() and path.stat().st_size > 500 else 0


def closed_in_time(recording) -> int:
    """The brakes that a controller had opened are closed again before the silence is longer than the drives allow. Returns how often."""
    plant, events = recording.tables["REED_PLANT"], recording.singles["REED_PLANT_EVENT"]
    opened = [event for event in events if "released" in event.text]
    closed = [event for event in events if "brakes closed" in event.text]
    assert len(opened) == len(closed)
    for event in closed:
        at_s = float(event.text.split(" at ")[1].removesuffix(" s"))
        earlier = plant["t_s"][(plant["cycle"] == event.cycle) & (plant["t_s"] <= at_s + 1e-9)]
        assert len(earlier) and np.min(at_s - earlier) <= (BRAKE_CYCLES + 2) / RATE_HZ, event.text
    return len(closed)


def test_a_controller_whose_plant_is_killed_stops_and_keeps_all_its_records(config, tmp_path):
    def kills(lane, numbers):
        folder = tmp_path / str(lane)
        folder.mkdir()
        pair, chance, found = Pair(config, folder, 10 + lane), random.Random(100 + lane), []
        for number in numbers:
            plant = pair.plant()
            controller = pair.firmware()
            wait_for_moment(number, chance, folder / "firmware.lcmlog")
            alive = plant.poll() is None
            plant.kill()
            plant.wait()
            status = controller.wait(60)
            recording = telemetry_log.load(folder / "firmware.lcmlog")
            assert status in (hil.STOPPED, 3), (folder / "output.txt").read_text()
            assert recording.finished_run is not None and tape.read(folder / tape.NAME).complete, "its records are whole"
            assert not recording.tables["REED_CONTROL"]["tau"][-1].any(), "the last torque is zero"
            answered = np.count_nonzero((recording.tables["REED_MEASURED"]["age"] == 0).all(axis=1))
            found.append((alive, answered, len(rows(folder, "plant")["cycle"])))
        return found

    found = side_by_side(kills)
    assert len(found) == KILLS and all(alive for alive, *_ in found)
    assert max(answered for _, answered, _ in found) > 1.1 * RATE_HZ
    for _, answered, recorded in found:
        assert recorded >= answered - STATED_LOSS_S * RATE_HZ, found


def test_both_in_one_process_are_killed_and_their_records_are_there(config, tmp_path):
    def kills(lane, numbers):
        folder = tmp_path / str(lane)
        folder.mkdir()
        chance, found = random.Random(200 + lane), []
        effective = scenario.write_effective(str(config), None, [], folder / "effective.toml")
        for number in numbers:
            plan = plans.make(effective, config, hil.MEMORY, "lockstep", folder, lcm=False)
            for old in (plan.log("firmware"), plan.log("plant"), folder / tape.NAME):
                old.unlink(missing_ok=True)
            process = hil.start("one_process", plan, ["--log", str(plan.log("firmware")), "--plant-log", str(plan.log("plant")), *hil.controls(plan)])
            wait_for_moment(number, chance, plan.log("plant"))
            process.kill()
            process.wait()
            found.append((len(rows(folder, "firmware")["cycle"]), len(rows(folder, "plant")["cycle"]), whole_tape(folder)))
        return found

    found = side_by_side(kills)
    assert len(found) == KILLS and sum(all(part) for part in found) >= 0.5 * KILLS, found
