"""reed_firmware and reed_plant_sim as processes: bad input and bad surroundings give one clear line and the right status."""

import contextlib
import os
import pathlib
import select
import shutil
import signal
import subprocess
import time

import own_address
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("REED_BUILD_DIR", ROOT / "build" / "release"))
FIRMWARE, PLANT = BUILD / "bin" / "reed_firmware", BUILD / "bin" / "reed_plant_sim"
GROUP = own_address.group()
PROGRAMS = {"reed_firmware": FIRMWARE, "reed_plant_sim": PLANT}


def bus(port):
    return f"udp:{GROUP}:{port}"


def run(*command, timeout=30):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=timeout)
    return done.returncode, done.stderr


def start(*command):
    return subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def end(process, sig=signal.SIGINT):
    if process.poll() is None:
        process.send_signal(sig)
    out, err = process.communicate(timeout=30)
    return process.returncode, out, err


def await_controller(plant):
    """Until the plant has heard the SYNC of a new controller."""
    while "SYNC " not in (line := plant.stdout.readline()):
        assert line, "the plant has ended"


@pytest.fixture
def plant():
    """Starts the plant on a port of its own; ends it in order."""
    running = []

    def begin(port, *options):
        process = start(PLANT, "--config", "press_known", "--bus", bus(port), "--no-lcm", *options)
        assert "waiting for SYNC" in process.stdout.readline()
        running.append(process)
        return process

    yield begin
    for process in running:
        end(process)


BAD_INPUT = {
    "an unknown scenario": (["--config", "nope"], ["'nope'", "press_known"]),
    "no scenario": ([], ["--config"]),
    "an unknown option": (["--config", "press_known", "--colour", "red"], ["--colour", "--help"]),
    "an unknown clock": (["--config", "press_known", "--clock", "sundial"], ["--clock", "realtime", "wall", "lockstep"]),
    "an unknown bus": (["--config", "press_known", "--bus", "pigeon"], ["pigeon", "socketcan:IFACE"]),
    "a missing interface": (["--config", "press_known", "--bus", "socketcan:no_such0"], ["no_such0"]),
    "a port that is no number": (["--config", "press_known", "--bus", f"udp:{GROUP}:x"], ["udp"]),
    "a group that is no multicast address": (["--config", "press_known", "--bus", "udp:10.0.0.1:43000"], ["10.0.0.1"]),
    "an unknown arm": (["--config", "press_known", "--arm", "a99"], ["a99", "a5"]),
    "a missing arm file": (["--config", "press_known", "--arm", "/no/such.toml"], ["/no/such.toml", "no such file"]),
    "an unknown key": (["--config", "press_known", "--set", "wall.colour=1"], ["wall.colour", "unknown key"]),
    "NaN": (["--config", "press_known", "--set", "control.k_p=nan"], ["control.k_p", "finite"]),
    "a unit with a number": (["--config", "press_known", "--set", "timing.rate_hz=1 kHz"], ["timing.rate_hz", "number"]),
    "a log that cannot be written": (["--config", "press_known", "--bus", bus(43301), "--log", "/no/such/folder/x"],
                                     ["/no/such/folder/x"]),
}


@pytest.mark.parametrize("program", PROGRAMS)
@pytest.mark.parametrize("case", BAD_INPUT)
def test_bad_input_is_one_line_and_exit_2(program, case):
    arguments, words = BAD_INPUT[case]
    status, error = run(PROGRAMS[program], *arguments)
    assert status == 2, error
    assert len(error.splitlines()) == 1 and error.startswith(f"{program}: "), error
    for word in words:
        assert word in error, error


def test_host_pauses_are_refused_where_no_clock_is_followed():
    status, error = run(FIRMWARE, "--config", "press_known", "--bus", bus(43312), "--clock", "lockstep", "--host-pause")
    assert status == 2 and len(error.splitlines()) == 1, error
    assert "--host-pause" in error and "--clock realtime" in error, error


def test_a_rate_that_no_wire_could_carry_is_refused_with_the_highest_one():
    slower = ["--set", "timing.rx_budget_us=80", "--set", "timing.compute_budget_us=50", "--set", "timing.tx_budget_us=50"]
    status, error = run(FIRMWARE, "--config", "press_known", "--bus", bus(43302), "--set", "timing.rate_hz=5000",
                        "--set", "control.K_d=5", *slower)
    assert status == 2 and len(error.splitlines()) == 1, error
    for word in ("timing.rate_hz", "5000 Hz", "%", "allowed: up to", "allow_wire_overload"):
        assert word in error, error


def test_a_leg_that_the_arm_cannot_follow_is_refused_on_the_ground():
    status, error = run(FIRMWARE, "--config", "press_known", "--bus", bus(43303), "--set", "reference.legs.1.frequency_hz=20")
    assert status == 2 and len(error.splitlines()) == 1, error
    for word in ("reference.legs", "joint", "too fast", "rad/s"):
        assert word in error, error


def test_a_bus_on_which_nobody_answers_is_lost_and_exit_3():
    status, error = run(FIRMWARE, "--config", "press_known", "--bus", bus(43304), "--clock", "lockstep", "--no-lcm")
    assert status == 3
    assert "bus is lost" in error and "43304" in error


def test_a_second_firmware_on_the_same_bus_is_refused_and_the_first_goes_on(plant):
    """Unless the machine holds the first one up while the second listens: then both hear of each other, stop, and it is
    tried again."""
    arm = plant(43305, "--clock", "wall")
    for _ in range(5):
        first = start(FIRMWARE, "--config", "press_known", "--bus", bus(43305), "--no-lcm")
        await_controller(arm)
        status, error = run(FIRMWARE, "--config", "press_known", "--bus", bus(43305), "--no-lcm")
        first_goes_on = first.poll() is None
        first_status, out, _ = end(first)
        if status != 1:
            break
    assert status == 3
    assert error.splitlines()[-1].startswith("reed_firmware: another controller") and "43305" in error, error
    assert first_goes_on and first_status == 0 and "done: " in out


def test_an_arm_with_other_joints_than_the_configurations_is_refused_before_its_brakes_open():
    arm = start(PLANT, "--config", "joints6", "--bus", bus(43310), "--clock", "lockstep", "--no-lcm")
    assert "waiting for SYNC" in arm.stdout.readline()
    status, error = run(FIRMWARE, "--config", "press_known", "--bus", bus(43310), "--clock", "lockstep", "--no-lcm", "--enable")
    assert status == 1 and "joint that this arm does not have" in error and "(joint 6" in error, error
    assert "released" not in end(arm)[1]


@pytest.mark.parametrize("sig", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_a_run_that_only_watches(plant, sig):
    arm = plant(43306, "--clock", "wall")
    process = start(FIRMWARE, "--config", "press_known", "--bus", bus(43306), "--no-lcm")
    await_controller(arm)
    status, out, _ = end(process, sig)
    assert status == 0 and "done: " in out


def test_a_run_that_nohup_started_outlives_its_terminal(plant):
    arm = plant(43311, "--clock", "wall")
    process = start("nohup", FIRMWARE, "--config", "press_known", "--bus", bus(43311), "--no-lcm")
    await_controller(arm)
    process.send_signal(signal.SIGHUP)
    with pytest.raises(subprocess.TimeoutExpired):
        process.wait(timeout=0.3)
    assert end(process)[0] == 0


def without_rights(*command):
    """The same program without the right to raise its priority or to lock memory."""
    dropped = "-sys_nice,-ipc_lock,-sys_resource"
    prefix = ["setpriv", f"--bounding-set={dropped}", f"--inh-caps={dropped}"] if os.geteuid() == 0 else []
    return ["bash", "-c", 'ulimit -r 0; ulimit -l 64; exec "$@"', "_", *prefix, *command]


def test_a_refused_priority_and_memory_lock_cost_a_line_each_and_nothing_else(plant):
    assert shutil.which("setpriv"), "util-linux is part of every Debian"
    arm = plant(43307, "--clock", "wall")
    process = start(*without_rights(FIRMWARE, "--config", "press_known", "--bus", bus(43307), "--no-lcm"))
    await_controller(arm)
    status, out, error = end(process)
    assert status == 0 and "done: " in out, error
    assert "SCHED_FIFO" in error and "memory" in error.lower(), error
    for line in error.splitlines():
        assert line.startswith("reed_firmware: "), error


def in_a_new_network(*command, loopback):
    """A network namespace with nothing but a loopback that has no routes."""
    rights = [] if os.geteuid() == 0 else ["--user", "--map-root-user"]
    setup = "ip link set lo up; " if loopback == "up" else ""
    return ["unshare", *rights, "--net", "bash", "-c", setup + 'exec "$@"', "_", *command]


@pytest.mark.parametrize("program", PROGRAMS)
def test_without_multicast_on_loopback_the_line_says_how_to_have_it(program):
    status, error = run(*in_a_new_network(PROGRAMS[program], "--config", "press_known", "--bus", bus(43308), loopback="down"))
    assert status == 2, error
    assert len(error.splitlines()) == 1 and error.startswith(f"{program}: udp:"), error
    for word in ("no multicast on loopback", "ip link set lo up multicast on", "ip route add 224.0.0.0/4 dev lo"):
        assert word in error, error


def test_without_a_multicast_route_telemetry_is_off_with_the_fix_and_the_bus_works():
    status, error = run(*in_a_new_network(FIRMWARE, "--config", "press_known", "--bus", bus(43308), "--clock", "lockstep",
                                          loopback="up"))
    assert status == 3 and "nothing heard" in error, "the bus opened, but there is no plant: " + error
    first = error.splitlines()[0]
    assert "LCM" in first and "ip route add 224.0.0.0/4 dev lo" in first, error


def test_a_whole_run_by_hand_records_and_ends_by_itself(plant, tmp_path):
    plant(43309, "--clock", "lockstep")
    log, candump = tmp_path / "firmware.lcmlog", tmp_path / "bus.candump"
    firmware = start(FIRMWARE, "--config", "press_known", "--bus", bus(43309), "--clock", "lockstep", "--enable", "--no-lcm",
                     "--set", "scenario.duration_s=0.3", "--log", log, "--candump", candump)
    out, error = firmware.communicate(timeout=120)
    assert firmware.returncode == 0, error
    assert " 0 missed" in out and " 0 heap allocations" in out
    lines = candump.read_text().splitlines()
    assert len(lines) >= 8 * 300 and " 080##" in lines[0]
    assert log.stat().st_size > 300 * 500


@pytest.mark.parametrize("program", PROGRAMS)
def test_a_disk_that_takes_nothing_cannot_keep_a_stopped_lockstep_run(program, plant, tmp_path):
    """A pipe whose reader has stopped reading stands for the disk: the program obeys SIGINT, names the file and ends with 3."""
    stuck = tmp_path / "stuck"
    os.mkfifo(stuck)
    reader = os.open(stuck, os.O_RDONLY | os.O_NONBLOCK)
    own = {name: ["--log", stuck] if name == program else ["--log", tmp_path / name] for name in PROGRAMS}
    arm = start(PLANT, "--config", "press_known", "--bus", bus(43312), "--clock", "lockstep", "--no-lcm", *own["reed_plant_sim"])
    assert "waiting for SYNC" in arm.stdout.readline()
    firmware = start(FIRMWARE, "--config", "press_known", "--bus", bus(43312), "--clock", "lockstep", "--no-lcm", *own["reed_firmware"])
    time.sleep(3.0)  # the pipe is full, then the queue, then the program waits
    stopped = {"reed_firmware": firmware, "reed_plant_sim": arm}[program]
    status, _, error = end(stopped)
    for other in (firmware, arm):
        other.kill()
        other.wait()
    os.close(reader)
    assert status == 3, error
    assert f"{program}: {stuck}: takes nothing any more" in error, error


@pytest.mark.parametrize("limit", ["file size", "reader"])
def test_a_log_that_cannot_go_on_costs_its_records_and_no_run(limit, plant, tmp_path):
    """A file that may not grow (SIGXFSZ) and a reader that leaves (SIGPIPE): the loop goes on to its end, the loss is counted."""
    plant(43313, "--clock", "lockstep")
    candump = tmp_path / "bus.candump"
    command = [FIRMWARE, "--config", "press_known", "--bus", bus(43313), "--clock", "lockstep", "--enable", "--no-lcm",
               "--set", "scenario.duration_s=0.5", "--candump", candump]
    if limit == "file size":
        firmware = start("bash", "-c", 'ulimit -f 100; exec "$@"', "_", *command)
    else:
        os.mkfifo(candump)
        reader = os.open(candump, os.O_RDONLY | os.O_NONBLOCK)
        firmware = start(*command)
        while not select.select([reader], [], [], 10.0)[0] or not os.read(reader, 1):
            assert firmware.poll() is None
        os.close(reader)
    out, error = firmware.communicate(timeout=120)
    assert firmware.returncode == 0, error
    assert "done: " in out and int(out.split()[1]) > 500
    lost = [line for line in error.splitlines() if "lost" in line]
    assert len(lost) == 1 and lost[0].startswith(f"reed_firmware: {candump}: ") and "frames lost" in lost[0], error


@pytest.mark.parametrize("program", PROGRAMS)
def test_closed_standard_streams_leave_a_whole_log(program, tmp_path):
    """A log that is opened as number 2 would get the complaints."""
    log = tmp_path / "log"
    arguments = ["--config", "press_known", "--bus", bus(43314), "--clock", "lockstep", "--log", log]
    closed = start("bash", "-c", 'exec "$@" <&- >&- 2>&-', "_", PROGRAMS[program], *arguments)
    if program == "reed_plant_sim":
        time.sleep(0.5)
        closed.send_signal(signal.SIGINT)
    assert closed.wait(timeout=30) == (3 if program == "reed_firmware" else 0)  # nobody answers the controller
    raw = log.read_bytes()
    assert not raw or raw.startswith(b"\xed\xa1\xda\x01"), raw[:80]
    assert b"reed_" not in raw.replace(b"REED_", b"")


def test_a_second_arm_on_the_same_bus_is_refused_before_it_answers(plant):
    """Unless the machine holds the first pair up while the second arm listens: then it is tried again."""
    arm = plant(43315, "--clock", "lockstep")
    for _ in range(5):
        firmware = start(FIRMWARE, "--config", "press_known", "--bus", bus(43315), "--clock", "lockstep", "--no-lcm")
        await_controller(arm)
        second = start(PLANT, "--config", "press_known", "--bus", bus(43315), "--clock", "lockstep", "--no-lcm")
        with contextlib.suppress(subprocess.TimeoutExpired):
            second.wait(timeout=5)
        status, _, error = end(second)
        end(firmware)
        if status == 3:
            break
    assert status == 3
    assert error == f"reed_plant_sim: another arm already answers on {bus(43315)}; end it, or choose another bus with --bus\n"
