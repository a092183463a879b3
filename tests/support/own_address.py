"""Software buses and LCM addresses of this process alone: no other worker and no other checkout on this machine has them."""

import itertools
import os

_numbers = itertools.count()
_FIRST_PORT, _PORTS, _STEP = 20_000, 12_000, 1009  # below those that the kernel gives out


def group() -> str:
    """By the process. A bus hears its own group alone."""
    return f"239.76.{os.getpid() // 250 % 250}.{1 + os.getpid() % 250}"


def port() -> int:
    """Another one with every call. LCM hears every group on its port, so the port is by the process as well."""
    return _FIRST_PORT + (os.getpid() + _STEP * next(_numbers)) % _PORTS


def bus() -> str:
    """For --bus; another one with every call."""
    return f"udp:{group()}:{port()}"


def lcm_url() -> str:
    return f"udpm://{group()}:{port()}?ttl=0"
