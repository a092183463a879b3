"""Which bus a run uses, made ready: the interface or the route that is missing is made where we may."""

import errno
import ipaddress
import os
import re
import socket
import subprocess
from contextlib import contextmanager
from pathlib import Path

from reed_tools.errors import UsageError
from reed_tools.run import hil

DEFAULT_GROUP, DEFAULT_PORT = "239.74.163.2", 43113
VCAN = "vcan0"
ALLOWED = "auto, socketcan:IFACE, udp, udp:GROUP:PORT, vm or memory"
INTERFACE_NAME = re.compile(r"[A-Za-z0-9_.-]{1,15}")
IFF_UP, IFF_MULTICAST = 0x1, 0x1000
ROUTE_FIX = ("ip link set lo up multicast on", "ip route add 224.0.0.0/4 dev lo")


def choose(wanted: str) -> str:
    """The `--bus` value for the two programs, "vm", or "memory"."""
    if wanted == "auto":
        return f"socketcan:{VCAN}" if vcan_ready(VCAN) else udp("udp")
    if wanted in ("vm", hil.MEMORY):
        return wanted
    if wanted.startswith("socketcan:"):
        return socketcan(wanted)
    if wanted == "udp" or wanted.startswith("udp:"):
        return udp(wanted)
    raise UsageError(f"--bus {wanted}: allowed are {ALLOWED}")


def simulated(bus: str) -> bool:
    """Whether no real drive can be on it, by the rule of bus/transport/transport.h."""
    return bus == "vm" or bus.startswith(("udp", "socketcan:vcan"))


def socketcan(wanted: str) -> str:
    name = wanted.removeprefix("socketcan:")
    if not INTERFACE_NAME.fullmatch(name):
        raise UsageError(f"--bus {wanted}: IFACE is the name of an interface: 1 to 15 letters, digits, '_', '.' or '-'")
    if not kernel_has_can():
        raise UsageError(f"--bus {wanted}: this machine's kernel has no SocketCAN; --bus vm or --bus udp works here")
    if not (interface_exists(name) or (name.startswith("vcan") and make_vcan(name))):
        raise UsageError(f"--bus {wanted}: there is no interface {name}; `ip -br link show type vcan` and `type can` "
                         "list those there are")
    if not (flags(name) & IFF_UP or (name.startswith("vcan") and bring_up(name))):
        raise UsageError(f"--bus {wanted}: {name} is down; as root: ip link set {name} up (a real interface needs its bit rates first, docs/hil.md)")
    return wanted


def udp(wanted: str) -> str:
    parts = wanted.split(":")[1:] or [DEFAULT_GROUP, str(DEFAULT_PORT)]
    try:
        group, port = ipaddress.IPv4Address(parts[0]), int(parts[1])
        if len(parts) != 2 or not group.is_multicast or not 0 < port < 65536:
            raise ValueError
    except (ValueError, IndexError):
        raise UsageError(f"--bus {wanted}: GROUP is an IPv4 multicast address (224.0.0.0 to 239.255.255.255), "
                         "PORT is 1 to 65535") from None
    require_multicast_route()
    return f"udp:{group}:{port}"


def kernel_has_can() -> bool:
    try:
        socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW).close()
        return True
    except OSError:
        return False


def interface_exists(name: str) -> bool:
    return bool(name) and Path("/sys/class/net", name).exists()


def flags(name: str) -> int:
    """Of an interface; 0 where the system does not say."""
    try:
        return int(Path("/sys/class/net", name, "flags").read_text(), 16)
    except (OSError, ValueError):
        return 0


def vcan_ready(name: str) -> bool:
    """Exists and is up, or could be made so."""
    if not kernel_has_can():
        return False
    return flags(name) & IFF_UP != 0 or bring_up(name) if interface_exists(name) else make_vcan(name)


def bring_up(name: str) -> bool:
    return as_root(f"ip link set {name} up")


def make_vcan(name: str) -> bool:
    return as_root(f"ip link add {name} type vcan") and as_root(f"ip link set {name} mtu 72") and bring_up(name)


def as_root(command: str) -> bool:
    prefix = [] if os.geteuid() == 0 else ["sudo", "-n"]
    try:
        return subprocess.run([*prefix, *command.split()], capture_output=True).returncode == 0
    except OSError:
        return False


def multicast_works() -> bool:
    """Whether the kernel lets a datagram leave for a group through the loopback interface."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
            probe.sendto(b"", (DEFAULT_GROUP, 9))
            return flags("lo") & (IFF_UP | IFF_MULTICAST) == IFF_UP | IFF_MULTICAST
        except OSError:
            return False


def require_multicast_route() -> None:
    """Software bus and telemetry need a route for 224.0.0.0/4 and multicast on lo."""
    if multicast_works():
        return
    for command in ROUTE_FIX:
        as_root(command)  # one of them may be done already, and fail
    if not multicast_works():
        raise UsageError(f"no multicast on this machine's loopback; as root: {' && '.join(ROUTE_FIX)}")


@contextmanager
def held(bus: str):
    """Two runs on one bus would drive each other's arm: the second one is refused before it starts. The name is an abstract
    socket: it belongs to the network, as the bus does, whoever runs and whatever files there are, and ends with its process. Memory is
    each run's own."""
    if bus == hil.MEMORY:
        yield
        return
    name = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    try:
        name.bind(f"\0reed-bus-{bus}")
    except OSError as error:
        name.close()
        if error.errno != errno.EADDRINUSE:
            raise
        raise UsageError(f"another run is using {bus}; wait for it or choose another, like "
                         f"--bus udp:{DEFAULT_GROUP}:{DEFAULT_PORT + 1}") from None
    with name:
        yield
