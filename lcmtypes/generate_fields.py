"""Writes fields.h: the fields of the telemetry messages as lists for the preprocessor, from the .lcm files that declare them.

usage: generate_fields.py LCM_DIR HEADER

REED_CONTROL_T(X) is X(TYPE, NAME, SOURCE) for every field of control_t.lcm, in its order, without those that every message
has (utime, cycle, the length of its arrays). SOURCE is what the field's comment names behind `<-`; nothing where the program
fills the field elsewhere.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))
from reed_tools.record.lcm_file import Field, fields  # noqa: E402

MESSAGES = ("measured_t", "control_t", "adaptation_t", "timing_t", "bus_t", "plant_t")
ALWAYS_THERE = ("utime", "cycle", "dof", "num")
SCALARS = {"double": "double", "boolean": "bool", "int8_t": "std::int8_t", "int32_t": "std::int32_t", "int64_t": "std::int64_t"}
ARRAYS = {None: "{}", "dof": "::reed::field::PerJoint<{}>", "num": "::reed::field::PerParameter<{}>", "3": "::reed::field::PerAxis<{}>"}


def entry(message: str, field: Field) -> str:
    if field.kind not in SCALARS or field.length not in ARRAYS:
        raise SystemExit(f"{message}.lcm: {field.name}: a field is one of {', '.join(SCALARS)}, alone or [dof], [num] or [3]")
    return f"  X({ARRAYS[field.length].format(SCALARS[field.kind])}, {field.name}, {field.source})"


def header(folder: Path) -> str:
    parts = ["// Generated from lcmtypes/*.lcm by lcmtypes/generate_fields.py. Do not edit.", "#pragma once"]
    for message in MESSAGES:
        entries = [entry(message, field) for field in fields(folder / f"{message}.lcm") if field.name not in ALWAYS_THERE]
        parts.append(f"#define REED_{message.upper()}(X) \\\n" + " \\\n".join(entries))
    return "\n".join(parts) + "\n"


if __name__ == "__main__":
    Path(sys.argv[2]).write_text(header(Path(sys.argv[1])), encoding="utf-8")
