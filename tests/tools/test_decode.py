"""tools/reed decode against frames that cantools encodes here, with CRCs by crccheck; live over the software bus by python-can."""

import json
import subprocess
import threading
import time

import can
import cantools
import numpy as np
import own_address
import pytest
from crccheck.crc import Crc16CcittFalse

from reed_tools.paths import PYTHON, ROOT

GROUP, PORT = own_address.group(), own_address.port()
DATABASE = cantools.database.load_file(ROOT / "bus" / "reed.dbc")
POSITION = float(np.float32(0.25))


def reed(*argv, **options):
    return subprocess.run([*PYTHON, str(ROOT / "tools" / "reed_tools" / "__main__.py"), "decode", *map(str, argv)], capture_output=True,
                          text=True, timeout=60, **options)


def payload(name, **values):
    message = DATABASE.get_message_by_name(name)
    data = bytes(message.encode({signal.name: 0 for signal in message.signals} | values, strict=False))
    identity = message.dbc.attributes["E2EDataId"].value.to_bytes(2, "little")
    return Crc16CcittFalse.calc(data[2:] + identity).to_bytes(2, "little") + data[2:]


JOINT = payload("JOINT_STATE_3", counter=17, drive_state=2, cycle_low4=5, position=POSITION, velocity=-1.5, torque=12.0)
SPOILT = JOINT[:-1] + bytes([JOINT[-1] ^ 1])
LINES = (f"(12.000250) vcan0 103##1{JOINT.hex().upper()}\n"
         f"(12.001250) vcan0 103##1{SPOILT.hex().upper()}\n"
         f"(12.002000) vcan0 080##1{payload('SYNC', cycle=4000000000).hex().upper()}\n"
         "(12.003000) vcan0 7FF##1AABB\n"
         "(12.004000) vcan0 103##10011\n")


def test_recorded_frames_are_in_engineering_units(tmp_path):
    (tmp_path / "bus.candump").write_text(LINES)
    done = reed(tmp_path)
    assert done.returncode == 0, done.stderr
    first, spoilt, sync, unknown, short = done.stdout.splitlines()
    assert first.split()[:3] == ["12.000250", "103", "JOINT_STATE_3"]
    for part in ("position=0.25 rad", "velocity=-1.5 rad/s", "torque=12 Nm", "drive_state=Enabled", "counter=17", "crc ok"):
        assert part in first, first
    assert reed(tmp_path, "--count", "2").stdout.splitlines() == [first, spoilt]
    assert "crc WRONG" in spoilt and "cycle=4000000000 cycles" in sync
    assert "unknown" in unknown and "aabb" in unknown and "unknown" in short


def test_json_lines_from_a_pipe_and_a_filter(tmp_path):
    done = reed("-", "--json", "--message", "JOINT_STATE_3", input=LINES)
    rows = [json.loads(line) for line in done.stdout.splitlines()]
    assert [row["crc"] for row in rows] == [True, False]
    assert rows[0]["signals"]["position"] == POSITION and rows[0]["units"]["position"] == "rad" and rows[0]["t_s"] == 12.00025


def test_live_frames_of_the_software_bus():
    stop = threading.Event()

    def send():
        with can.Bus(interface="udp_multicast", channel=GROUP, port=PORT, hop_limit=0, fd=True) as bus:
            while not stop.is_set():
                bus.send(can.Message(arbitration_id=0x103, data=JOINT, is_fd=True, bitrate_switch=True, is_extended_id=False))
                time.sleep(0.02)

    sender = threading.Thread(target=send)
    sender.start()
    try:
        done = reed("--bus", f"udp:{GROUP}:{PORT}", "--count", "3", "--duration", "20")
    finally:
        stop.set()
        sender.join()
    assert done.returncode == 0, done.stderr
    assert len(done.stdout.splitlines()) == 3 and "position=0.25 rad" in done.stdout


@pytest.mark.parametrize("argv, told", [
    (["/nowhere"], "/nowhere"),
    (["--message", "BREAKFAST", "x"], "JOINT_STATE_1"),
    (["--bus", "token-ring"], "socketcan:IFACE"),
    (["--bus", "vm"], "bus.candump"),
    (["--count", "0"], "above 0"),
    (["--duration", "nan"], "above 0"),
])
def test_bad_input_is_one_line_and_status_2(argv, told):
    done = reed(*argv)
    assert done.returncode == 2 and told in done.stderr and len(done.stderr.splitlines()) == 1, done.stderr


def test_a_line_that_is_no_frame_is_named():
    done = reed("-", input=LINES + "hello\n")
    assert done.returncode == 2 and "standard input:6:" in done.stderr
