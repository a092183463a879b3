"""Frames of the bus in engineering units, by bus/reed.dbc, live or from a recording."""

import json
import math
import sys
import time
from pathlib import Path

import can
import cantools
from crccheck.crc import Crc16CcittFalse

from reed_tools.errors import RunError, UsageError
from reed_tools.export import can_logs
from reed_tools.paths import ROOT
from reed_tools.run import bus_choice

DBC = ROOT / "bus" / "reed.dbc"
CRC_BYTES = 2
POLL_S = 0.2

_database = None


def database():
    global _database
    if _database is None:
        _database = cantools.database.load_file(DBC)
    return _database


def recorded(source: str):
    if source == "-":
        return can_logs.frames(sys.stdin, "standard input")
    path = Path(source)
    path = path / "bus.candump" if path.is_dir() else path
    if not path.is_file():
        raise UsageError(f"{path} is missing: RUN_DIR is a folder that tools/reed run wrote, FILE what candump -L wrote")
    return can_logs.frames(open(path, encoding="ascii", errors="replace"), str(path))


def live(wanted: str, duration_s: float | None):
    if wanted == "vm":
        raise UsageError("--bus vm: a run's VM cannot be listened to; its frames are in the run folder's bus.candump")
    kind, _, rest = bus_choice.choose(wanted).partition(":")
    options = {"interface": "socketcan", "channel": rest}
    if kind == "udp":
        group, port = rest.split(":")
        options = {"interface": "udp_multicast", "channel": group, "port": int(port), "hop_limit": 0}
    end = math.inf if duration_s is None else time.monotonic() + duration_s
    try:
        with can.Bus(fd=True, **options) as bus:
            while time.monotonic() < end:
                if (frame := bus.recv(POLL_S)) is not None:
                    yield frame
    except can.CanError as error:
        raise RunError(f"--bus {wanted}: {error}") from None


def decode(frame: can.Message) -> dict:
    """What one frame says. `crc` is None for a frame that the DBC does not know or that is too short for it."""
    decoded = {"t_s": frame.timestamp, "id": frame.arbitration_id, "message": None, "crc": None, "signals": {}, "units": {}}
    known = None
    if not (frame.is_extended_id or frame.is_error_frame or frame.is_remote_frame):
        known = next((message for message in database().messages if message.frame_id == frame.arbitration_id), None)
    if known is None or len(frame.data) != known.length:
        return decoded | {"data": bytes(frame.data or b"").hex()}
    signals = known.decode(bytes(frame.data), decode_choices=True)
    return decoded | {"message": known.name, "crc": crc_holds(known, bytes(frame.data)),
                      "signals": {name: str(value) if not isinstance(value, (int, float)) else value for name, value in signals.items()},
                      "units": {signal.name: signal.unit or "" for signal in known.signals}}


def crc_holds(message, data: bytes) -> bool:
    """AUTOSAR E2E profile 5: over everything behind the CRC, then the Data ID, which is not sent."""
    identity = message.dbc.attributes["E2EDataId"].value.to_bytes(2, "little")
    return Crc16CcittFalse.calc(data[CRC_BYTES:] + identity) == int.from_bytes(data[:CRC_BYTES], "little")


def as_text(decoded: dict) -> str:
    head = f"{decoded['t_s']:17.6f}  {decoded['id']:03X}"
    if decoded["message"] is None:
        return f"{head}  unknown        {decoded['data']}"
    values = " ".join(f"{name}={number(value)}{' ' * bool(decoded['units'][name])}{decoded['units'][name]}"
                      for name, value in decoded["signals"].items() if name != "crc")
    return f"{head}  {decoded['message']:<13}  {values}  crc {'ok' if decoded['crc'] else 'WRONG'}"


def number(value) -> str:
    return f"{value:.7g}" if isinstance(value, float) else str(value)


def as_json(decoded: dict) -> str:
    signals = {name: str(value) if isinstance(value, float) and not math.isfinite(value) else value for name, value in decoded["signals"].items()}
    return json.dumps(decoded | {"signals": signals})
