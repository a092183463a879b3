"""reed_plant_sim as a process: what a user types, what a controller sends, what is left behind."""

import os
import pathlib
import signal
import struct
import subprocess
import sys
import time

import can
import lcm
import own_address
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("REED_BUILD_DIR", ROOT / "build" / "release"))
PROGRAM = BUILD / "bin" / "reed_plant_sim"
GROUP = own_address.group()
SYNC_ID, SYNC_SIZE = 128, 8

sys.path.insert(0, str(BUILD / "lcmtypes" / "python"))


def crc16(data):
    """CRC-16 CCITT-FALSE bit by bit."""
    crc = 0xFFFF
    for byte in data:
        crc ^= byte << 8
        for _ in range(8):
            crc = (crc << 1 ^ 0x1021 if crc & 0x8000 else crc << 1) & 0xFFFF
    return crc


def sync_data_id():
    for line in (ROOT / "bus" / "reed.dbc").read_text().splitlines():
        if line.startswith('BA_ "E2EDataId" BO_ %d ' % SYNC_ID):
            return int(line.split()[-1].rstrip(";"))
    raise AssertionError("bus/reed.dbc gives SYNC no E2EDataId")


def layout_id():
    for header in (BUILD / "bus").rglob("reed_layout.h"):
        for line in header.read_text().splitlines():
            if "kLayoutId" in line and "=" in line:
                return int(line.split("=")[1].split(";")[0].strip(), 0)
    raise AssertionError("no kLayoutId in reed_layout.h")


def sync_frame(cycle, layout):
    body = struct.pack("<BBI", cycle & 0xFF, layout, cycle)  # E2E counter, layout, cycle
    data = struct.pack("<H", crc16(body + struct.pack("<H", sync_data_id()))) + body
    return can.Message(arbitration_id=SYNC_ID, data=data, is_fd=True, bitrate_switch=True, is_extended_id=False)


class Plant:
    """The program in lockstep on its own port, and a controller that only says SYNC."""

    def __init__(self, port, *extra, config="press_known"):
        self.bus = can.Bus(interface="udp_multicast", channel=GROUP, port=port, fd=True)
        self.process = subprocess.Popen(
            [PROGRAM, "--config", config, "--clock", "lockstep", "--bus", f"udp:{GROUP}:{port}", *extra],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.first_line = self.process.stdout.readline()  # printed when the bus is open

    def exchange(self, cycle, layout, answers=6):
        """Sends SYNC and returns the plant's frames."""
        got = []
        self.bus.send(sync_frame(cycle, layout))
        deadline = time.monotonic() + 10.0
        while len(got) < answers and time.monotonic() < deadline:
            message = self.bus.recv(0.5)
            if message is None:
                if self.process.poll() is not None:
                    break
            elif message.arbitration_id != SYNC_ID:
                got.append(message)
        return got

    def end(self, sig=signal.SIGTERM):
        self.bus.shutdown()
        if self.process.poll() is None:
            self.process.send_signal(sig)
        out, err = self.process.communicate(timeout=20)
        return self.process.returncode, out, err


def run(*arguments):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=20)
    return done.returncode, done.stderr


@pytest.mark.parametrize("arguments, words", [
    (["--config", "no_such_scenario"], ["no_such_scenario", "press_known"]),
    ([], ["--config"]),
    (["--config", "press_known", "--colour", "red"], ["--colour"]),
    (["--config", "press_known", "--clock", "sundial"], ["--clock", "realtime", "wall", "lockstep"]),
    (["--config", "press_known", "--bus", "carrier_pigeon"], ["carrier_pigeon", "socketcan:IFACE"]),
    (["--config", "press_known", "--bus", "socketcan:no_such0"], ["no_such0"]),
    (["--config", "press_known", "--arm", "a99"], ["a99", "a5"]),
    (["--config", "press_known", "--set", "plant.max_step_s=nan"], ["plant.max_step_s", "finite"]),
    (["--config", "press_known", "--duration", "nan"], ["--duration", "finite"]),
    (["--config", "press_known", "--bus", f"udp:{GROUP}:43201", "--log", "/no/such/folder/x.lcmlog"],
     ["/no/such/folder/x.lcmlog", "No such file"]),
])
def test_bad_input_is_one_clear_line_and_exit_2(arguments, words):
    status, error = run(*arguments)
    assert status == 2, error
    assert len(error.strip().splitlines()) == 1, error
    assert error.startswith("reed_plant_sim: ")
    for word in words:
        assert word in error


@pytest.mark.parametrize("sig", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_while_waiting_ends_in_order(sig):
    plant = Plant(43202, "--no-lcm")
    assert "waiting for SYNC" in plant.first_line
    status, out, err = plant.end(sig)
    assert (status, err) == (0, "")
    assert "done: 0 cycles" in out


def test_a_controller_of_another_layout_is_refused_in_one_line_with_exit_2():
    plant = Plant(43203, "--no-lcm")
    assert plant.exchange(0, layout_id() ^ 0xFF) == []
    status, out, err = plant.end()
    assert status == 2
    assert len(err.strip().splitlines()) == 1 and "layout" in err and str(layout_id()) in err
    assert "done: 0 cycles" in out


def log_of_a_run(path, port, cycles):
    plant = Plant(port, "--no-lcm", "--log", str(path))
    ids = [[m.arbitration_id for m in plant.exchange(k, layout_id())] for k in range(cycles)]
    status, _, err = plant.end()
    assert (status, err) == (0, "")
    assert ids == [[257, 258, 259, 260, 261, 320]] * cycles
    return path


def test_python_cans_software_bus_drives_it_and_the_log_holds_every_cycle(tmp_path):
    from reed import plant_t  # generated by the build
    log = lcm.EventLog(str(log_of_a_run(tmp_path / "plant.lcmlog", 43204, 60)), "r")
    truths = [(event.timestamp, plant_t.decode(event.data)) for event in log if event.channel == "REED_PLANT"]
    assert [truth.cycle for _, truth in truths] == list(range(60))
    assert [truth.utime for _, truth in truths] == [1000 * k for k in range(60)]
    assert all(timestamp == truth.utime and truth.braked and truth.dof == 5 for timestamp, truth in truths)


def test_two_equal_runs_leave_equal_bytes(tmp_path):
    first = log_of_a_run(tmp_path / "first.lcmlog", 43205, 40).read_bytes()
    second = log_of_a_run(tmp_path / "second.lcmlog", 43206, 40).read_bytes()
    assert first == second and len(first) > 40 * 300


def test_an_lcm_address_that_is_not_used_costs_one_line_and_nothing_else():
    environment = dict(os.environ, LCM_DEFAULT_URL="udpm://10.0.0.1:7667?ttl=0")  # not a multicast address
    process = subprocess.Popen([PROGRAM, "--config", "press_known", "--bus", f"udp:{GROUP}:43207"], text=True,
                               env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert "waiting for SYNC" in process.stdout.readline()
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=20)
    assert process.returncode == 0
    lines = [line for line in err.splitlines() if "LCM" in line or "route" in line]
    assert len(lines) == 1 and "10.0.0.1" in lines[0] and "allowed: udpm:" in lines[0]
