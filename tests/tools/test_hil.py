"""Whole runs of the two real programs, on the software bus and on real SocketCAN (the kernel's vcan0, else the small
VM's), with foreign programs as witnesses: candump, cantools, python-can, lcm-logger."""

import json
import os
import re
import subprocess
import sys
import time

import can
import numpy as np
import own_address
import pytest

from reed_tools.paths import ROOT
from reed_tools.record.telemetry_log import events, load
from reed_tools.run import bus_choice, vm

DBC = ROOT / "bus" / "reed.dbc"
UDP_GROUP, UDP_PORT = own_address.group(), own_address.port()
LCM_URL = own_address.lcm_url()
LOCKSTEP = ["--clock", "lockstep", "--duration", "1.5"]
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(ROOT / "tools"), "LCM_DEFAULT_URL": LCM_URL}


def reed(*argv):
    return [sys.executable, "-m", "reed_tools", *map(str, argv)]


def run(folder, *argv, bus=f"udp:{UDP_GROUP}:{UDP_PORT}"):
    done = subprocess.run(reed("run", "--bus", bus, "--out", folder, *argv), env=ENVIRONMENT, capture_output=True, text=True,
                          timeout=400)
    assert done.returncode in (0, 1), done.stdout + done.stderr
    return json.loads((folder / "summary.json").read_text())


def on_can(script):
    """Runs a shell script where vcan0 is: here if the kernel has it, else in the small VM. Never skips."""
    command = ["bash", "-ec", script]
    native = bus_choice.vcan_ready(bus_choice.VCAN)
    done = subprocess.run(command if native else vm.command(command), env=ENVIRONMENT, capture_output=True, text=True, timeout=400)
    assert done.returncode in (0, 1), done.stdout + done.stderr


@pytest.fixture(scope="module")
def udp_run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("udp")
    return folder, run(folder, *LOCKSTEP)


@pytest.fixture(scope="module")
def can_run(tmp_path_factory):
    """A lockstep run on vcan0, with candump listening."""
    folder = tmp_path_factory.mktemp("can")
    on_can(f"candump -L -r 33554432 vcan0 > {folder}/witness.candump & witness=$!; sleep 0.5; status=0;"
           f" {' '.join(reed('run', '--bus', 'socketcan:vcan0', '--out', folder, *LOCKSTEP))} || status=$?;"
           " sleep 0.5; kill $witness; exit $status")
    return folder, json.loads((folder / "summary.json").read_text())


def frames(path):
    """(identifier, payload) of every line of candump -L text, CAN FD."""
    pattern = re.compile(r"^\(\d+\.\d{6}\) \S+ ([0-9A-F]{3})##[0-9A-F]((?:[0-9A-F]{2})*)$")
    return [pattern.match(line).groups() for line in path.read_text().splitlines()]


def test_lockstep_holds_every_check_and_repeats_itself_bit_by_bit(udp_run, tmp_path):
    folder, first = udp_run
    assert first["digest"] == run(tmp_path / "again", *LOCKSTEP)["digest"]
    assert first["digest"] != run(tmp_path / "other", *LOCKSTEP, "--seed", "2")["digest"]
    assert (first["loop"]["heap_allocations"], first["loop"]["telemetry_dropped"], first["bus"]["lost"]) == (0, 0, 0)


def test_press_known_holds_its_checks_over_three_seconds(tmp_path):
    summary = run(tmp_path, "--clock", "lockstep")
    assert summary["verdict"] == "pass", summary["checks"]


def test_socketcan_gives_the_same_digest_as_the_software_bus(udp_run, can_run):
    (_, udp), (_, can) = udp_run, can_run
    assert (can["bus"]["kind"], can["bus"]["interface"]) == ("socketcan", "vcan0")
    assert can["digest"] == udp["digest"]
    assert can["windows"] == udp["windows"]


def test_candump_saw_the_bytes_that_the_firmware_recorded(can_run):
    folder, _ = can_run
    witnessed = frames(folder / "witness.candump")
    own = frames(folder / "bus.candump")
    assert len(own) > 10_000
    # The plant may answer once more after the controller's last cycle, and candump may begin before it.
    start = witnessed.index(own[0])
    assert witnessed[start:start + len(own)] == own


def test_cantools_reads_the_numbers_that_the_firmware_used(can_run):
    """candump's text through `cantools decode`, joined with the telemetry by cycle: equal to the last bit of a float32."""
    folder, _ = can_run
    head = (folder / "witness.candump").read_text().splitlines(keepends=True)[:4000]
    decoded = subprocess.run([sys.executable, "-m", "cantools", "decode", "--single-line", str(DBC)], input="".join(head),
                             capture_output=True, text=True, check=True, timeout=120).stdout
    tables = load(folder / "telemetry.lcmlog").tables
    measured, control = tables["REED_MEASURED"], tables["REED_CONTROL"]
    row = {cycle: k for k, cycle in enumerate(measured["cycle"])}
    cycle, compared = None, 0
    for line in decoded.splitlines():
        name, fields = re.search(r":: (\w+)\((.*)\)", line).groups()
        signal = {key: value for key, value in re.findall(r"(\w+): (-?[\w.+-]+)", fields)}
        if name == "SYNC":
            cycle = int(signal["cycle"])
        k = row[cycle]
        if name.startswith("JOINT_STATE_") and measured["age"][k][int(name[-1]) - 1] == 0:
            joint = int(name[-1]) - 1
            for field, key in (("position", "position"), ("velocity", "velocity"), ("torque", "torque")):
                assert np.float32(signal[field]) == np.float32(measured[key][k][joint]), (cycle, name, field)
                compared += 1
        elif name == "WRENCH" and measured["wrench_age"][k] == 0:
            for axis, letter in enumerate("xyz"):
                assert np.float32(signal[f"force_{letter}"]) == np.float32(measured["force"][k][axis])
                compared += 1
        elif name == "COMMAND":
            for joint, tau in enumerate(control["tau"][k]):
                assert np.float32(signal[f"torque_{joint + 1}"]) == np.float32(tau), (cycle, joint)
                compared += 1
    assert compared > 5000


def test_wall_clock_run_on_socketcan_ends_without_a_fault_and_says_what_it_measured(tmp_path):
    """In the small VM two programs share one CPU that the host takes away now and then. Where its timers are too coarse to
    measure that, 20 missed cycles rightly stop an arm: three runs in a row that meet one are no accident."""
    bus = "socketcan:vcan0" if bus_choice.vcan_ready(bus_choice.VCAN) else "vm"
    for attempt in range(3):
        summary = run(tmp_path / str(attempt), "--clock", "wall", "--duration", "2", bus=bus)
        assert summary["bus"]["kind"] == "socketcan" and summary["bus"]["frames_rx"] > 0
        assert summary["timing_us"]["wake"] is not None and summary["loop"]["heap_allocations"] == 0
        modes = [change["mode"] for change in summary["modes"]]
        if "active" in modes and "fault" not in modes:
            before = modes[:modes.index("active")]  # once more from off where a pause braked the drives
            assert before == ["off", "ready"] * (len(before) // 2)
            assert summary["windows"][-1]["force_rms_N"] is not None
            return
    pytest.fail(f"every run ended in a fault: {summary['modes']}")


def test_bus_vm_is_the_same_run_with_its_folder_outside(udp_run, tmp_path):
    assert run(tmp_path, *LOCKSTEP, bus="vm")["digest"] == udp_run[1]["digest"]


def test_python_can_reads_the_frames_of_a_run_folder(udp_run):
    folder, _ = udp_run
    read = [(f"{message.arbitration_id:03X}", message.data.hex().upper()) for message in can.LogReader(folder / "bus.log")]
    assert len(read) > 10_000 and read == frames(folder / "bus.candump")


def until_it_stops_growing(path):
    size = -1
    while size != path.stat().st_size:
        size = path.stat().st_size
        time.sleep(1.0)


def test_foreign_programs_read_a_run_on_the_software_bus(tmp_path):
    """lcm-logger hears what the run recorded; python-can's logger hears the frames. Their queues take much of a run, or the
    machine would decide what they hear."""
    logger = subprocess.Popen(["lcm-logger", "-f", "-q", "--lcm-url", f"{LCM_URL}&recv_buf_size={32 << 20}", str(tmp_path / "witness.lcmlog")])
    listener = subprocess.Popen([sys.executable, "-c", LISTENER, str(tmp_path / "witness.txt"), UDP_GROUP, str(UDP_PORT)],
                                stdout=subprocess.PIPE, text=True)
    try:
        assert listener.stdout.readline() == "listening\n"
        time.sleep(1.0)  # lcm-logger does not say when it listens
        run(tmp_path, "--clock", "wall", "--duration", "1")
        until_it_stops_growing(tmp_path / "witness.txt")
    finally:
        for process in (logger, listener):
            process.terminate()
            process.wait(timeout=20)
    own = {}
    for _, channel, data in events(tmp_path / "telemetry.lcmlog"):
        own.setdefault(channel, set()).add(data)
    for channel in ("REED_MEASURED", "REED_CONTROL", "REED_PLANT"):
        heard = {data for _, name, data in events(tmp_path / "witness.lcmlog") if name == channel}
        assert len(heard) > 500 and heard <= own[channel], channel
    own_frames = set(frames(tmp_path / "bus.candump"))
    heard_frames = [tuple(line.split()) for line in (tmp_path / "witness.txt").read_text().splitlines()[:-1]]
    recorded = [frame for frame in heard_frames if frame in own_frames]
    assert len(recorded) > 0.9 * len(own_frames)


LISTENER = """
import socket, sys, can
bus = can.Bus(interface="udp_multicast", channel=sys.argv[2], port=int(sys.argv[3]), fd=True)
for option in (socket.SO_RCVBUF, 33):  # as much as everybody may, as much as root may (SO_RCVBUFFORCE)
    try:
        bus._multicast._socket.setsockopt(socket.SOL_SOCKET, option, 32 << 20)
    except PermissionError:
        pass
print("listening", flush=True)
with open(sys.argv[1], "w", buffering=1) as out:
    for message in bus:
        out.write(f"{message.arbitration_id:03X} {message.data.hex().upper()}\\n")
"""
