"""Writes reed_layout.h: what cantools' C source leaves out of a DBC.

usage: generate_layout.py DBC HEADER

Identifiers, sizes and E2E Data IDs per frame, bounds of every float signal, and the DBC's SHA-256.
Names that differ only by a trailing number (JOINT_STATE_1 .. 8, torque_1 .. 8) become one array; such frames must
have the same signals, because bus/messages.cc uses the codec of the first for all of them.
"""

import hashlib
import pathlib
import re
import sys

import cantools

CAN_FD_SIZES = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64}


def camel(name):
    return "".join(part.capitalize() for part in name.split("_"))


def families(items):
    """Groups items by name without trailing number, in order; a plain name is a family of one."""
    grouped = {}
    for item in items:
        grouped.setdefault(re.sub(r"_\d+$", "", item.name), []).append(item)
    return grouped


def signature(message):
    signals = [(s.name, s.start, s.length, s.is_float, s.minimum, s.maximum, s.conversion.scale, s.conversion.offset)
            for s in message.signals]
    return message.length, signals


def check(database):
    data_ids = {}
    for message in database.messages:
        if not message.is_fd or message.is_extended_frame or message.length not in CAN_FD_SIZES:
            raise SystemExit(f"{message.name}: must be a CAN FD frame with an 11-bit identifier and a CAN FD size")
        data_id = message.dbc.attributes.get("E2EDataId")
        if data_id is None:
            raise SystemExit(f"{message.name}: no attribute E2EDataId")
        if data_id.value in data_ids:
            raise SystemExit(f"{message.name}: E2EDataId {data_id.value} is already that of {data_ids[data_id.value]}")
        data_ids[data_id.value] = message.name
        head = [(s.name, s.start, s.length, s.byte_order) for s in message.signals[:2]]
        if head != [("crc", 0, 16, "little_endian"), ("counter", 16, 8, "little_endian")]:
            raise SystemExit(f"{message.name}: must begin with crc (16 bit) and counter (8 bit) of E2E profile 5")
        for signal in message.signals:
            if signal.is_float and None in (signal.minimum, signal.maximum):
                raise SystemExit(f"{message.name}.{signal.name}: a float signal needs a range")
    for name, members in families(database.messages).items():
        if any(signature(m) != signature(members[0]) for m in members):
            raise SystemExit(f"{name}: its numbered frames must have the same size and signals")


def frame_literal(message):
    return f"{{0x{message.frame_id:03X}, {message.length}, 0x{message.dbc.attributes['E2EDataId'].value:04X}}}"


def constant(type_name, name, literals):
    if len(literals) == 1:
        return f"inline constexpr {type_name} {name}{literals[0]};"
    return f"inline constexpr std::array<{type_name}, {len(literals)}> {name}{{{{{', '.join(literals)}}}}};"


def header(database, sha256):
    lines = [
        "// Generated from bus/reed.dbc by bus/generate_layout.py. Do not edit.",
        "#pragma once",
        "#include <array>",
        "#include <cstdint>",
        "#include <string_view>",
        '#include "reed/bus/frame/frame_layout.h"',
        "namespace reed::bus::layout {",
        f'inline constexpr std::string_view kDbcSha256 = "{sha256}";',
        f"inline constexpr std::uint8_t kLayoutId = 0x{sha256[:2]};  // first byte of the hash, sent in SYNC",
        constant("FrameLayout", "kFrames", [frame_literal(m) for m in database.messages]),
    ]
    for name, messages in families(database.messages).items():
        lines.append(constant("FrameLayout", f"k{camel(name)}", [frame_literal(m) for m in messages]))
        floats = [s for s in messages[0].signals if s.is_float]
        for signal_name, signals in families(floats).items():
            bounds = [f"{{{float(s.minimum)}, {float(s.maximum)}}}" for s in signals]
            lines.append(constant("Bounds", f"k{camel(name)}{camel(signal_name)}", bounds))
    lines.append("}  // namespace reed::bus::layout")
    return "\n".join(lines) + "\n"


def main():
    dbc, out = map(pathlib.Path, sys.argv[1:3])
    database = cantools.database.load_file(dbc)
    check(database)
    out.write_text(header(database, hashlib.sha256(dbc.read_bytes()).hexdigest()))


if __name__ == "__main__":
    main()
