"""Writes docs/reference.md from its sources: bus/reed.dbc, lcmtypes, the events' headers, the command line; and the tables of keys in
config/README.md from reed_config.

    build/venv/bin/python3 docs/make_reference.py"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tools"))

import cantools  # noqa: E402

from reed_tools import cli  # noqa: E402
from reed_tools.paths import build, program  # noqa: E402
from reed_tools.record import event_names  # noqa: E402
from reed_tools.record.message_layout import fields  # noqa: E402
from reed_tools.record.telemetry_log import SINGLES, TABLES  # noqa: E402

TARGET = ROOT / "docs" / "reference.md"
KEYS = ROOT / "config" / "README.md"
HEADERS = ("firmware/core/safety/reason.h", "plant_sim/record/records.h")


def table(head: list[str], rows: list[list]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(str(cell).replace('|', chr(92) + '|') for cell in row)} |" for row in lines)


def frames() -> str:
    """One row per signal; the eight joints have one layout."""
    rows = []
    for message in cantools.database.load_file(ROOT / "bus" / "reed.dbc").messages:
        if re.fullmatch(r"JOINT_STATE_[2-8]", message.name):
            continue
        name = message.name.replace("JOINT_STATE_1", "JOINT_STATE_1 … 8")
        for signal in message.signals:
            rows.append([name, f"0x{message.frame_id:03X}", message.length, signal.name, f"{signal.start}, {signal.length}", signal.unit or "",
                         f"{signal.minimum:g} … {signal.maximum:g}" if signal.minimum is not None else ""])
    return table(["frame", "identifier", "bytes", "signal", "first bit, bits", "unit", "range"], rows)


def channels() -> str:
    rows = [[channel, field.name + (f"[{field.length}]" if field.length else ""), field.kind, field.comment]
            for channel, kind in sorted((TABLES | SINGLES).items()) for field in fields(kind) if field.name not in ("utime", "cycle")]
    return table(["channel", "field", "type", "unit and meaning"], rows)


def texts() -> dict[str, str]:
    """What the controller says of an event, by the name of its constant."""
    source = (ROOT / HEADERS[0]).read_text()
    found = re.findall(r"case Reason::k(\w+):\s+return ((?:\"[^\"]*\"\s*)+);", source)
    return {name: "".join(re.findall(r'"([^"]*)"', text)) for name, text in found}


def events() -> str:
    said, rows = texts(), []
    for header, who in zip(HEADERS, ("controller", "plant")):
        for name, code, comment in re.findall(r"^  k(\w+) = (\d+),[ ]*(?://[ ]*(.*))?$", (ROOT / header).read_text(), re.M):
            number = int(code)
            if number == 0 or (who == "plant" and number < 200):
                continue
            kind = "stops the arm" if event_names.stops_the_arm(number) else "a limit acts" if 96 <= number < 200 else "news"
            rows.append([number, event_names.name_of(number), who, kind, said.get(name, comment) if who == "controller" else comment])
    return table(["code", "name", "by", "", "meaning"], sorted(rows))


def exit_codes() -> str:
    words = " ".join(cli.EXIT_STATUS.removeprefix("exit status:").split())
    return table(["status", "meaning"], [part.strip().split(" ", 1) for part in words.split(";")])


def text() -> str:
    return f"""# Reference

Made from its sources by `docs/make_reference.py`; a test holds it to them. The keys of scenarios and arms are in
[config/README.md](../config/README.md), which holds what `reed_config --keys` and `--arm-keys` print.

## Exit status
{exit_codes()}

## Frames on the bus
From `bus/reed.dbc`. CAN FD, 11-bit identifiers, little-endian; each frame begins with the CRC-16 and counter of AUTOSAR E2E profile 5.

{frames()}

## Telemetry channels
From the `.lcm` files in `lcmtypes`. Every message begins with `utime` (µs) and, but for REED_RUN, has the `cycle` that SYNC carried.

{channels()}

## Events
From `{HEADERS[0]}` and `{HEADERS[1]}`.

{events()}
"""


def with_keys(readme: str) -> str:
    """config/README.md with the tables of keys as reed_config prints them."""
    build("reed_config_tool")
    for option, first in (("--keys", "scenario.name"), ("--arm-keys", "name")):
        printed = subprocess.run([program("reed_config"), option], capture_output=True, text=True, check=True).stdout
        head = "".join(printed.splitlines(keepends=True)[:2]) + f"| {first} |"
        readme, tables = re.subn(rf"^{re.escape(head)}.*\n(?:\|.*\n)*", lambda _: printed, readme, flags=re.M)
        assert tables == 1, f"{KEYS}: {tables} tables begin as reed_config {option} does"
    return readme


if __name__ == "__main__":
    TARGET.write_text(text())
    KEYS.write_text(with_keys(KEYS.read_text()))
