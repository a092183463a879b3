"""The C++ codec and cantools' own Python codec read the same DBC: their numbers and bytes must be equal.
The CRC is compared with the one of Python's standard library."""

import binascii
import random
import subprocess
import sys

import numpy
import pytest

FLOATS = {"position": 32, "velocity": 64, "torque": 2048, "force": 4096, "moment": 1024}


def uniform(rng, name):
    bound = FLOATS[name.split("_")[0]]
    return float(numpy.float32(rng.uniform(-bound, bound)))


def messages(rng):
    """(C++ kind, C++ arguments, frame name, signals), every signal of every frame with random content."""
    cycle = rng.getrandbits(32)
    layout = rng.getrandbits(8)
    yield "sync", [cycle, layout], "SYNC", {"cycle": cycle, "layout": layout}
    for joint in range(8):
        state = {"position": uniform(rng, "position"), "velocity": uniform(rng, "velocity"),
                 "torque": uniform(rng, "torque"), "drive_state": rng.randrange(5), "cycle_low4": rng.randrange(16)}
        yield "joint", [joint, *state.values()], f"JOINT_STATE_{joint + 1}", state
    axes = {f"{kind}_{axis}": uniform(rng, kind) for kind in ("force", "moment") for axis in "xyz"}
    saturated = rng.randrange(2)
    yield "wrench", [cycle, saturated, *axes.values()], "WRENCH", {"cycle": cycle, "saturated": saturated, **axes}
    torques = {f"torque_{i}": uniform(rng, "torque") for i in range(1, 9)}
    request = rng.randrange(3)
    yield "command", [cycle, request, *torques.values()], "COMMAND", {"cycle": cycle, "request": request, **torques}


def protect(message, data, counter):
    """E2E profile 5, written from its description and not from the C++."""
    body = bytes([counter]) + data[3:]
    data_id = message.dbc.attributes["E2EDataId"].value
    crc = binascii.crc_hqx(body + data_id.to_bytes(2, "little"), 0xFFFF)
    return crc.to_bytes(2, "little") + body


def test_messages_name_every_signal_of_the_dbc(database):
    named = {name: set(signals) for _, _, name, signals in messages(random.Random(0))}
    for message in database.messages:
        assert named[message.name] == {s.name for s in message.signals} - {"crc", "counter"}


def test_cantools_reads_what_cpp_writes(codec, database):
    rng = random.Random(1)
    for round_ in range(30):
        for kind, arguments, name, signals in messages(rng):
            identifier, data = codec.encode(kind, *arguments)
            message = database.get_message_by_frame_id(identifier)
            assert message.name == name and len(data) == message.length
            decoded = message.decode(data, decode_choices=False)
            assert {s: decoded[s] for s in signals} == signals
            assert decoded["counter"] == round_
            assert data == protect(message, data, round_)


def test_cpp_reads_what_cantools_writes(codec, database):
    rng = random.Random(2)
    for round_ in range(30):
        for kind, arguments, name, signals in messages(rng):
            message = database.get_message_by_name(name)
            data = message.encode({**signals, "crc": 0, "counter": 0})
            assert codec.decode(message.frame_id, protect(message, data, round_)) == (kind, arguments)


@pytest.mark.parametrize("name, change, reason", [
    ("COMMAND", {"torque_3": float("nan")}, 6),
    ("COMMAND", {"torque_8": 1e9}, 6),
    ("COMMAND", {"request": 3}, 6),
    ("WRENCH", {"force_z": float("-inf")}, 6),
    ("JOINT_STATE_4", {"drive_state": 7}, 6),
    ("JOINT_STATE_8", {"position": 32.0001}, 6),
])
def test_cpp_refuses_numbers_that_the_dbc_does_not_allow(codec, database, name, change, reason):
    message = database.get_message_by_name(name)
    signals = {s.name: 0 for s in message.signals} | change
    data = message.encode(signals, strict=False)
    assert codec.decode(message.frame_id, protect(message, data, 0)) == ("reject", [reason])


def test_python_crc_is_the_one_of_the_catalogue():
    assert binascii.crc_hqx(b"123456789", 0xFFFF) == 0x29B1


def test_candump_text_is_decoded_by_cantools(codec, dbc):
    """What users type: candump -L | cantools decode."""
    identifier, data = codec.encode("command", 7, 2, 1.5, -2.25, 0, 0, 0, 0, 0, 1024)
    line = f"(1700000000.000000) vcan0 {identifier:03X}##1{data.hex().upper()}\n"
    text = subprocess.run([sys.executable, "-m", "cantools", "decode", str(dbc)], input=line, capture_output=True,
                          text=True, check=True).stdout
    for expected in ("COMMAND(", "cycle: 7", "request: Enable", "torque_1: 1.5 Nm", "torque_2: -2.25 Nm", "torque_8: 1024"):
        assert expected in text
