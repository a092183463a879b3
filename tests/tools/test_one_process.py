"""Controller and plant in one process (`--bus memory`): the same run as by two programs, and it ends as they do."""

import json
import os
import signal
import subprocess
import time

import own_address
import pytest

from reed_tools.paths import BUILD, PYTHON, ROOT
from reed_tools.record.telemetry_log import events

ENVIRONMENT = {**os.environ, "REED_BUILD_DIR": str(BUILD)}
SHORT = ["--duration", "0.8", "--seed", "77", "--clock", "lockstep"]
UDP = own_address.bus()
PROGRAM = BUILD / "bin" / "reed_one_process"
FIGURES = ("checks", "verdict", "windows", "modes", "parameters", "digest", "cycles", "sim_s", "config_sha256", "missed_cycles", "law")


def reed(*argv):
    return [*PYTHON, str(ROOT / "tools" / "reed_tools" / "__main__.py"), *map(str, argv)]


def call(*argv):
    return subprocess.run(reed(*argv), env=ENVIRONMENT, capture_output=True, text=True, timeout=240)


def run(folder, bus, *argv):
    done = call("run", *argv, "--bus", bus, "--out", folder)
    assert done.returncode in (0, 1), done.stdout + done.stderr
    return json.loads((folder / "summary.json").read_text())


@pytest.fixture(scope="module")
def both(tmp_path_factory):
    """Folder and summary of the same run on either bus."""
    folders = {"memory": tmp_path_factory.mktemp("memory"), UDP: tmp_path_factory.mktemp("udp")}
    return {bus.split(":")[0]: (folder, run(folder, bus, *SHORT)) for bus, folder in folders.items()}


def test_a_run_in_memory_is_the_same_run_bit_by_bit(both):
    (_, memory), (_, udp) = both["memory"], both["udp"]
    assert {key: memory[key] for key in FIGURES} == {key: udp[key] for key in FIGURES}
    assert {key: value for key, value in memory["bus"].items() if key not in ("kind", "interface")} == \
        {key: value for key, value in udp["bus"].items() if key not in ("kind", "interface")}
    assert (memory["bus"]["kind"], memory["clock"]) == ("memory", "lockstep")


def test_frames_are_those_of_any_bus(both):
    """With their counters and checksums: identifier and payload of every line."""
    lines = [[line.split()[-1] for line in (both[bus][0] / "bus.candump").read_text().splitlines()] for bus in ("memory", "udp")]
    assert len(lines[0]) > 5000 and lines[0] == lines[1]


def test_both_sides_record_all_they_did(both):
    recorded = {bus: [(channel, data) for _, channel, data in events(folder / "telemetry.lcmlog")
                      if channel in ("REED_MEASURED", "REED_CONTROL", "REED_ADAPTATION", "REED_PLANT", "REED_EVENT", "REED_PLANT_EVENT")]
                for bus, (folder, _) in both.items()}
    cycles = both["memory"][1]["cycles"]
    assert sum(channel == "REED_PLANT" for channel, _ in recorded["memory"]) == cycles
    assert sorted(recorded["memory"]) == sorted(recorded["udp"])
    assert {path.name for path in both["memory"][0].iterdir()} - {"one_process.txt"} == \
        {path.name for path in both["udp"][0].iterdir()} - {"firmware.txt", "plant.txt"}


def test_what_the_plant_asks_of_heap_and_kernel_is_not_the_controllers(both):
    loop = both["memory"][1]["loop"]
    assert (loop["heap_allocations"], loop["page_faults"], loop["telemetry_dropped"]) == (0, 0, 0)


def test_lockstep_is_its_clock_unless_another_is_asked_for(tmp_path):
    assert run(tmp_path, "memory", "--duration", "0.1")["clock"] == "lockstep"


@pytest.mark.parametrize("argv, told", [
    (["--clock", "wall"], "--clock lockstep"),
    (["--arm", "a99"], "a5"),
    (["--set", "reference.legs.1.frequency_hz=20"], "too fast"),
    (["--rate", "5000", "--set", "control.K_d=5"], "timing.rate_hz"),
])
def test_bad_input_is_one_line_and_status_2(tmp_path, argv, told):
    done = call("run", "--bus", "memory", "--out", tmp_path / "run", *argv)
    assert done.returncode == 2 and done.stderr.startswith("reed: ") and len(done.stderr.splitlines()) == 1, done.stderr
    assert told in done.stderr
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("argv, told", [
    ([], "--config"),
    (["--config", "press_known", "--clock", "wall"], "--help"),
    (["--config", "press_known", "--set", "wall.colour=1"], "wall.colour"),
    (["--config", "press_known", "--log", "/no/such/folder/x"], "/no/such/folder/x"),
    (["--config", "press_known", "--plant-log", "/no/such/folder/x"], "/no/such/folder/x"),
])
def test_the_program_refuses_bad_input_in_one_line(argv, told):
    done = subprocess.run([PROGRAM, *argv, "--no-lcm"], capture_output=True, text=True, timeout=60)
    assert done.returncode == 2 and done.stderr.startswith("reed_one_process: ") and len(done.stderr.splitlines()) == 1, done.stderr
    assert told in done.stderr


def test_an_arm_that_stops_is_status_1_with_its_reason(tmp_path):
    done = call("run", "--bus", "memory", "--out", tmp_path, "--duration", "1", "--set", "plant.payload_step_kg=60",
                "--set", "plant.payload_step_s=0.3")
    assert done.returncode == 1 and "reed_firmware: the arm stopped: " in done.stdout, done.stdout + done.stderr
    assert json.loads((tmp_path / "summary.json").read_text())["modes"][-1]["mode"] == "fault"


def test_a_plant_that_diverges_is_status_3_and_its_record_is_kept(tmp_path):
    done = call("run", "free_motion", "--bus", "memory", "--out", tmp_path, "--set", "plant.stiffness_scale=0.02",
                "--set", "plant.payload_step_kg=100", "--set", "plant.payload_step_s=0.2")
    assert done.returncode == 3 and "the simulated arm diverged: " in done.stderr and ", t = 0.3" in done.stderr, done.stderr
    assert len(done.stderr.splitlines()) == 1
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["verdict"] == "fail" and summary["sim_s"] > 0.2


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_run_closes_the_brakes_and_writes_its_figures(tmp_path, number):
    process = subprocess.Popen(reed("run", "--bus", "memory", "--out", tmp_path, "--duration", "600"), env=ENVIRONMENT,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    wait_for_size(tmp_path / "firmware.lcmlog", 2_000_000)  # of some 1500 cycles: the arm is active
    process.send_signal(number)
    out, err = process.communicate(timeout=120)
    assert process.returncode == 1 and "interrupted" in out, out + err
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["cycles"] > 0 and summary["modes"][-1]["mode"] == "off"
    assert [check["ok"] for check in summary["checks"] if check["name"] == "missing_s"] == [False]
    assert "brakes closed" in (tmp_path / "one_process.txt").read_text()


@pytest.mark.parametrize("option, status, told", [("--log", 0, "reed_firmware: /dev/full: "), ("--plant-log", 3, "reed_plant_sim: /dev/full: ")])
def test_a_full_disk_is_told_and_the_run_goes_on_to_its_end(option, status, told):
    """As by two programs: the controller counts what it lost, a plant's incomplete truth is an error."""
    done = subprocess.run([PROGRAM, "--config", "press_known", "--set", "scenario.duration_s=0.2", "--no-lcm", "--enable", option, "/dev/full"],
                          capture_output=True, text=True, timeout=60)
    assert done.returncode == status and told in done.stderr, done.stderr
    assert done.stdout.count("done: 274 cycles") == 2, done.stdout


def test_two_runs_in_memory_do_not_know_of_each_other(tmp_path):
    folders = [tmp_path / "a", tmp_path / "b"]
    running = [subprocess.Popen(reed("run", "--bus", "memory", "--out", folder, *SHORT), env=ENVIRONMENT, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE) for folder in folders]
    assert [process.communicate(timeout=240) and process.returncode in (0, 1) for process in running] == [True, True]
    first, second = (json.loads((folder / "summary.json").read_text())["digest"] for folder in folders)
    assert first == second


def wait_for_size(path, size):
    deadline = time.monotonic() + 60
    while not (path.exists() and path.stat().st_size > size):
        assert time.monotonic() < deadline
        time.sleep(0.02)
