"""How a run starts and ends: bad input, exit statuses, Ctrl-C, buses. The two programs are stand-ins (conftest.py)."""

import json
import os
import shlex
import signal
import subprocess
import time

import own_address
import pytest

from reed_tools import cli
from reed_tools.errors import UsageError
from reed_tools.paths import PYTHON, ROOT
from reed_tools.record import run_folder
from reed_tools.run import bus_choice, hil, origin

BUS = own_address.bus()


def one_line(done, status):
    assert done.returncode == status, done.stdout + done.stderr
    lines = done.stderr.splitlines()
    assert len(lines) == 1 and lines[0].startswith("reed: "), done.stderr
    return lines[0]


@pytest.mark.parametrize("argv, told", [
    (["run", "press_knwon"], "press_known"),
    (["run", "/nowhere/x.toml"], "/nowhere/x.toml"),
    (["run", "--arm", "a99"], "a5"),
    (["run", "--set", "wall.stifness_Npm=1"], "stiffness_Npm"),
    (["run", "--set", "wall.stiffness_Npm=stiff"], "stiffness_Npm"),
    (["run", "--duration", "nan"], "duration_s"),
    (["run", "--rate", "-5"], "rate_hz"),
    (["run", "--seed", "1.5"], "seed"),
    (["run", "--clock", "sundial"], "realtime"),
    (["run", "--bus", "token-ring"], "socketcan:IFACE"),
    (["run", "--bus", "udp:10.0.0.1:4000"], "multicast"),
    (["run", "--bus", "udp:239.74.163.2:0"], "65535"),
    (["run", "--bus", "udp:239.74.163.2"], "GROUP"),
    (["run", "--bus", "socketcan:can77"], "can77"),
    (["run", "--out", "/proc/nowhere"], "/proc/nowhere"),
    (["run", "--bogus"], "--bogus"),
    (["report", "/nowhere"], "effective.toml"),
    (["frobnicate"], "commands:"),
])
def test_bad_input_is_one_line_and_status_2(reed, argv, told):
    argv = [*argv, "--bus", BUS] if argv[0] == "run" and "--bus" not in argv else argv
    assert told in one_line(reed(*argv), 2)


def test_a_refused_configuration_leaves_no_run_folder(reed, tmp_path):
    one_line(reed("run", "--bus", BUS, "--out", tmp_path / "run", "--duration", "-1"), 2)
    assert not (tmp_path / "run").exists()


def test_somebody_elses_report_is_not_replaced(reed, tmp_path):
    (tmp_path / "report.html").write_text("mine")
    assert "report.html would be replaced" in one_line(reed("run", "--bus", BUS, "--out", tmp_path), 2)
    assert (tmp_path / "report.html").read_text() == "mine"


def test_a_damaged_run_folder_is_one_line_and_its_result_stays(reed, tmp_path):
    assert reed("run", "--bus", BUS, "--out", tmp_path).returncode in (0, 1)
    before = (tmp_path / "summary.json").read_text()
    log = tmp_path / "telemetry.lcmlog"
    whole = log.read_bytes()
    log.write_bytes(whole[:-1000])
    assert "is damaged" in one_line(reed("report", tmp_path), 2)
    log.write_bytes(whole)
    (tmp_path / "effective.toml").write_text("[scenario\n")
    assert "effective.toml is damaged" in one_line(reed("report", tmp_path), 2)
    assert (tmp_path / "summary.json").read_text() == before


def test_what_the_machine_refuses_is_one_line_and_status_3(monkeypatch, capsys):
    def full(argv):
        raise OSError(28, "No space left on device", "/full/telemetry.lcmlog")

    monkeypatch.setattr(cli, "dispatch", full)
    assert cli.main(["run"]) == 3
    assert capsys.readouterr().err == "reed: /full/telemetry.lcmlog: no space left on device\n"


def test_an_unknown_check_is_refused_with_the_known_ones(reed, tmp_path):
    scenario = tmp_path / "odd.toml"
    text = (bus_choice.Path(__file__).parents[2] / "config/scenarios/press_known.toml").read_text()
    scenario.write_text(text + '[[checks]]\nname = "beauty"\nlimit = 1.0\n')
    line = one_line(reed("run", scenario, "--bus", BUS), 2)
    assert "beauty" in line and "impact_peak_N" in line


def test_a_run_folder_holds_everything_and_both_programs_got_the_same_options(reed, tmp_path):
    done = reed("run", "--bus", BUS, "--clock", "lockstep", "--seed", "5", "--out", tmp_path)
    assert done.returncode == 1, done.stderr  # the stand-in's force error fails the scenario's checks
    present = {path.name for path in tmp_path.iterdir()}
    assert {"summary.json", "report.html", "telemetry.lcmlog", "effective.toml", "joint_error.png", "force.png", "torque.png",
            "parameters.png", "timing.png"} <= present
    assert not {"firmware.lcmlog", "plant.lcmlog"} & present
    common = f"--bus {BUS} --clock lockstep --log {tmp_path}/"
    assert (tmp_path / "plant.options").read_text() == f"--config {tmp_path}/plant.toml {common}plant.lcmlog"
    options = (tmp_path / "firmware.options").read_text()
    assert options.startswith(f"--config {tmp_path}/controller.toml {common}firmware.lcmlog --enable --candump {tmp_path}/bus.candump --tape {tmp_path}/tape.reed")
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert (summary["scenario"], summary["arm"], summary["seed"], summary["clock"]) == ("press_known", "a5", 5, "lockstep")
    assert "FAIL" in done.stdout and summary["digest"][:16] in done.stdout
    assert summary["command"] == f"tools/reed run press_known --seed 5 --bus {BUS} --clock lockstep"
    assert summary["versions"]["reed"] and len(summary["versions"]["build"]) == 12 and summary["machine"]["cores"] >= 1
    assert summary["versions"]["law"] is None
    sealed = [line.split()[1] for line in (tmp_path / "SHA256SUMS").read_text().splitlines()]
    assert set(hil.HALVES.values()) == set(run_folder.HALVES) <= set(sealed)
    assert summary["cause"] and summary["cause"] in done.stdout
    assert "\x1b" not in done.stdout  # no terminal: plain lines


def test_the_line_that_repeats_a_run_survives_the_shell(tmp_path, monkeypatch):
    scenario, law = tmp_path / "my own.toml", tmp_path / "law.so"
    scenario.write_text("")
    law.write_text("")
    monkeypatch.chdir(tmp_path)

    class Arguments:
        arm, law, duration, rate, seed, bus, clock = "a5", "law.so:gain=2", "2.5", None, "7", "auto", "wall"
        set = ["wall.normal=[0,0,-1]", "scenario.name=\"it's\""]

    Arguments.scenario = scenario.name
    assert shlex.split(origin.command(Arguments)) == ["tools/reed", "run", str(scenario), "--arm", "a5", "--law", f"{law}:gain=2", "--duration", "2.5", "--seed", "7",
                                                      "--bus", "auto", "--clock", "wall", "--set", "wall.normal=[0,0,-1]",
                                                      "--set", "scenario.name=\"it's\""]


def test_only_a_controller_in_realtime_on_a_simulated_bus_measures_host_pauses(reed, tmp_path):
    """`wall` is the old name of the clock."""
    for clock in ("realtime", "wall"):
        folder = tmp_path / clock
        done = reed("run", "--bus", BUS, "--clock", clock, "--out", folder)
        assert done.returncode == 1, done.stderr
        firmware, plant = ((folder / f"{name}.options").read_text() for name in ("firmware", "plant"))
        assert "--clock realtime" in firmware and "--clock realtime" in plant
        assert "--host-pause" in firmware.split() and "--host-pause" not in plant
        assert json.loads((folder / "summary.json").read_text())["clock"] == "wall"
    assert [bus_choice.simulated(bus) for bus in ("udp:239.74.163.2:43113", "vm", "socketcan:vcan0", "socketcan:can0")] == [True, True, True, False]


def test_report_rebuilds_the_same_summary(reed, tmp_path):
    reed("run", "--bus", BUS, "--out", tmp_path)
    before = (tmp_path / "summary.json").read_text()
    (tmp_path / "summary.json").unlink()
    (tmp_path / "report.html").unlink()
    assert reed("report", tmp_path).returncode == 1
    assert (tmp_path / "summary.json").read_text() == before
    assert (tmp_path / "report.html").exists()


@pytest.mark.parametrize("who", ["FIRMWARE", "PLANT"])
def test_a_program_that_dies_is_status_3_and_its_record_is_kept(reed, tmp_path, who):
    done = reed("run", "--bus", BUS, "--out", tmp_path, **{f"REED_FAKE_{who}": "die"})
    line = one_line(done, 3)
    assert "ended with status 3: bus lost" in line and {"FIRMWARE": "firmware", "PLANT": "plant"}[who] in line
    assert json.loads((tmp_path / "summary.json").read_text())["cycles"] == 1100


@pytest.mark.parametrize("who", ["FIRMWARE", "PLANT"])
def test_a_program_that_refuses_its_options_is_status_2(reed, tmp_path, who):
    done = reed("run", "--bus", BUS, "--out", tmp_path, **{f"REED_FAKE_{who}": "refuse"})
    assert "at most 8 are allowed" in one_line(done, 2)


@pytest.mark.parametrize("who, program", [("FIRMWARE", "reed_firmware"), ("PLANT", "reed_plant_sim")])
def test_what_the_machine_refused_is_told_with_its_fix_beside_the_result(reed, tmp_path, who, program):
    done = reed("run", "--bus", BUS, "--out", tmp_path, **{f"REED_FAKE_{who}": "complain"})
    assert f"{program}: SCHED_FIFO 80 not granted; fix: rtprio 80" in done.stdout.splitlines()


def test_the_firmware_starts_when_the_plant_hears_the_bus(reed, tmp_path):
    assert reed("run", "--bus", BUS, "--out", tmp_path, REED_FAKE_PLANT="late").returncode in (0, 1)
    assert "waiting for SYNC" in (tmp_path / "plant_had_said").read_text()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_interrupting_stops_firmware_then_plant_and_writes_the_figures(reed, tmp_path, number):
    process = reed.start("run", "--bus", BUS, "--out", tmp_path, REED_FAKE_FIRMWARE="endless")
    wait_for(tmp_path / "plant.lcmlog", tmp_path / "firmware.lcmlog")
    process.send_signal(number)
    out, err = process.communicate(timeout=60)
    assert (tmp_path / "stopped").read_text() == "firmware\nplant\n"
    assert process.returncode == 1 and "interrupted" in out, err
    assert json.loads((tmp_path / "summary.json").read_text())["cycles"] == 1100


def test_a_killed_tool_leaves_no_program_behind(reed, tmp_path):
    """Without the kernel's signal, which programs with file capabilities do not get."""
    process = reed.start("run", "--bus", BUS, "--out", tmp_path, REED_FAKE_FIRMWARE="endless")
    wait_for(tmp_path / "firmware.lcmlog")
    process.kill()
    process.communicate(timeout=60)
    numbers = [int((tmp_path / f"{name}.pid").read_text()) for name in ("firmware", "plant")]
    deadline = time.monotonic() + 30
    while any(running(number) for number in numbers):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    assert sorted((tmp_path / "stopped").read_text().splitlines()) == ["firmware", "plant"]  # in order, not killed
    with bus_choice.held(BUS):
        pass


def running(number: int) -> bool:
    """A program that ended and that nobody waits for is still listed."""
    try:
        return bus_choice.Path(f"/proc/{number}/stat").read_text().rpartition(") ")[2][0] != "Z"
    except OSError:
        return False


def test_programs_get_stacks_of_the_usual_size(reed, tmp_path):
    """They lock their memory, and the caller's limit may be a gigabyte."""
    for limit, found in (("1048576", 8 << 20), ("4096", 4 << 20)):
        run = reed.command(["run", "--bus", BUS, "--out", tmp_path / limit])
        done = subprocess.run(["bash", "-c", f'ulimit -Ss {limit}; exec "$@"', "bash", *run],
                              env=reed.environment({}), capture_output=True, text=True)
        assert done.returncode == 1, done.stderr
        assert int((tmp_path / limit / "firmware.stack").read_text()) == found


def test_a_bus_in_use_by_another_run_is_refused(reed, tmp_path):
    first = reed.start("run", "--bus", BUS, "--out", tmp_path, REED_FAKE_FIRMWARE="endless")
    try:
        wait_for(tmp_path / "firmware.lcmlog")
        line = one_line(reed("run", "--bus", BUS), 2)
        assert "another run is using" in line and "--bus udp:" in line
    finally:
        first.send_signal(signal.SIGINT)
        first.communicate(timeout=60)


def test_a_bus_is_held_by_its_name_whatever_the_files_and_users(tmp_path, monkeypatch):
    """Another TMPDIR, a umask of 077 or a FIFO in /tmp make no difference, and a bus is free when its holder was killed."""
    hold = ("import sys; sys.path.insert(0, sys.argv[1])\nfrom reed_tools.run import bus_choice\n"
            "with bus_choice.held('udp:x:1'): print('held', flush=True); sys.stdin.read()")
    first = subprocess.Popen([*PYTHON, "-c", hold, ROOT / "tools"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                             env={**os.environ, "TMPDIR": str(tmp_path)}, umask=0o077)
    assert first.stdout.readline() == "held\n" and list(tmp_path.iterdir()) == []
    with pytest.raises(UsageError, match="another run is using udp:x:1"), bus_choice.held("udp:x:1"):
        pass
    with bus_choice.held("udp:x:2"):
        pass
    first.kill()
    first.communicate()
    with bus_choice.held("udp:x:1"):
        pass


@pytest.mark.parametrize("name", ["vcan%d", "can 0", "../lo", "", "a" * 16, "vcan0\n"])
def test_what_is_no_name_of_an_interface_is_refused_before_anything_is_made(monkeypatch, name):
    monkeypatch.setattr(bus_choice, "as_root", lambda command: pytest.fail(command))
    with pytest.raises(UsageError, match="IFACE is the name of an interface"):
        bus_choice.choose(f"socketcan:{name}")


@pytest.mark.parametrize("may_be_made_up", [True, False])
def test_an_interface_that_is_down_is_made_up_or_named(monkeypatch, may_be_made_up):
    asked = []
    monkeypatch.setattr(bus_choice, "kernel_has_can", lambda: True)
    monkeypatch.setattr(bus_choice, "interface_exists", lambda name: True)
    monkeypatch.setattr(bus_choice, "flags", lambda name: 0x1000 if name == "lo" else 0)
    monkeypatch.setattr(bus_choice, "as_root", lambda command: asked.append(command) or may_be_made_up)
    monkeypatch.setattr(bus_choice, "multicast_works", lambda: True)
    assert bus_choice.choose("auto") == ("socketcan:vcan0" if may_be_made_up else "udp:239.74.163.2:43113")
    assert asked == ["ip link set vcan0 up"]
    if may_be_made_up:
        assert bus_choice.choose("socketcan:vcan0") == "socketcan:vcan0"
    for name in ("can0",) if may_be_made_up else ("can0", "vcan0"):
        with pytest.raises(UsageError, match=f"{name} is down; as root: ip link set {name} up"):
            bus_choice.choose(f"socketcan:{name}")


def test_a_missing_multicast_route_is_told_with_its_fix(monkeypatch):
    monkeypatch.setattr(bus_choice, "multicast_works", lambda: False)
    monkeypatch.setattr(bus_choice, "as_root", lambda command: False)
    with pytest.raises(UsageError, match="ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo"):
        bus_choice.choose("udp")


@pytest.mark.skipif(subprocess.run(["unshare", "-rn", "true"], capture_output=True).returncode != 0, reason="no network of one's own here")
def test_the_fix_works_where_the_loopback_is_down_and_where_half_of_it_is_done():
    """In a network of its own, whose lo is down and has no route."""
    mend = ("import sys; sys.path.insert(0, sys.argv[1])\nfrom reed_tools.run import bus_choice\n"
            "assert not bus_choice.multicast_works()\nbus_choice.as_root(bus_choice.ROUTE_FIX[int(sys.argv[2])])\n"
            "print(bus_choice.choose('udp'))")
    for first in (0, 1):
        done = subprocess.run(["unshare", "-rn", *PYTHON, "-c", mend, ROOT / "tools", str(first)], capture_output=True, text=True)
        assert (done.returncode, done.stdout) == (0, "udp:239.74.163.2:43113\n"), done.stderr


def test_auto_prefers_vcan_and_falls_back_to_udp(monkeypatch):
    monkeypatch.setattr(bus_choice, "vcan_ready", lambda name: True)
    assert bus_choice.choose("auto") == "socketcan:vcan0"
    monkeypatch.setattr(bus_choice, "vcan_ready", lambda name: False)
    monkeypatch.setattr(bus_choice, "multicast_works", lambda: True)
    assert bus_choice.choose("auto") == "udp:239.74.163.2:43113"


def test_doctor_names_a_fix_for_everything_that_is_missing(reed):
    done = reed("doctor")
    assert done.returncode == 0
    for subject in ("SocketCAN", "loopback multicast", "SCHED_FIFO", "memory lock", "CPU governor", "Java for spy"):
        assert subject in done.stdout
    missing = [line.split("  ")[0].strip() for line in done.stdout.splitlines() if " no  " in line]
    assert all(f"\n{subject}: " in done.stdout for subject in missing)


def wait_for(*paths):
    deadline = time.monotonic() + 60
    while not all(path.exists() for path in paths):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    time.sleep(0.2)
