"""The software bus is python-can's: frames written by one side are read by the other, byte for byte."""

import os
import random
import socket
import subprocess
import time

import can
import pytest
from can.interfaces.udp_multicast.utils import pack_message, unpack_message

SIZES = [0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64]


def frames(seed):
    rng = random.Random(seed)
    return [(rng.randrange(0x800), rng.randbytes(size)) for size in SIZES for _ in range(4)]


def text(frame):
    return f"{frame[0]:03X}#{frame[1].hex().upper()}"


@pytest.fixture
def address(request):
    """A group and port that no other test on this machine uses at the same time."""
    number = abs(hash(request.node.name)) % 200
    return f"239.75.{os.getpid() % 200}.{1 + number}", 40000 + os.getpid() % 20000


@pytest.fixture
def bus(address):
    group, port = address
    bus = can.Bus(interface="udp_multicast", channel=group, port=port, hop_limit=0, fd=True)
    yield bus
    bus.shutdown()


def test_python_can_reads_what_cpp_writes(bus, address, peer):
    sent = frames(1)
    before = time.time()
    subprocess.run([peer, "send", "udp:%s:%d" % address], input="".join(text(f) + "\n" for f in sent), text=True, check=True)
    for identifier, data in sent:
        message = bus.recv(10)
        assert message is not None
        assert (message.arbitration_id, bytes(message.data), message.dlc) == (identifier, data, len(data))
        assert message.is_fd and message.bitrate_switch
        assert not (message.is_extended_id or message.is_remote_frame or message.is_error_frame)
        assert before - 1 < message.timestamp < time.time() + 1


def test_cpp_reads_what_python_can_writes(bus, address, peer):
    sent = frames(2)
    listener = subprocess.Popen([peer, "listen", "udp:%s:%d" % address, str(len(sent) + 1)], stdout=subprocess.PIPE, text=True)
    assert listener.stdout.readline() == "ready\n"
    bus.send(can.Message(arbitration_id=1, data=b"classic", is_extended_id=False))
    bus.send(can.Message(arbitration_id=0x12345, data=b"extended", is_extended_id=True, is_fd=True))
    for identifier, data in sent:
        bus.send(can.Message(arbitration_id=identifier, data=data, is_extended_id=False, is_fd=True))
    got = listener.stdout.read().splitlines()
    assert listener.wait(10) == 0
    assert got == ["00012345#" + b"extended".hex().upper(), *(text(f) for f in sent), "malformed 1"]


def test_identifiers_of_29_bits_travel_as_python_can_writes_them(bus, address, peer):
    subprocess.run([peer, "send", "udp:%s:%d" % address], input="1F008105#0102\n", text=True, check=True)
    message = bus.recv(10)
    assert (message.arbitration_id, message.is_extended_id, bytes(message.data), message.is_fd) == (0x1F008105, True, b"\1\2", True)


def test_bytes_of_a_datagram_are_those_of_python_can(address, peer):
    """Same keys, same order, same types: only the width that an integer takes may differ."""
    group, port = address
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        receiver.bind((group, port))
        loopback = socket.inet_aton(group) + socket.inet_aton("127.0.0.1")
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, loopback)
        receiver.settimeout(10)
        subprocess.run([peer, "send", f"udp:{group}:{port}"], input="7FF#0102030405060708\n", text=True, check=True)
        data = receiver.recv(1000)
    message = unpack_message(data, check=True)
    assert data == pack_message(message)
