"""Telemetry as flat columns with units: torque_j1, torque_j2 … instead of an array, because a viewer draws one curve per name."""

from dataclasses import dataclass

import numpy as np

from reed_tools.record.message_layout import SCALARS, Field, fields
from reed_tools.record.telemetry_log import Recording

SIZES = ("dof", "num")  # fields that only say how long the arrays are


@dataclass
class Column:
    name: str           # torque_j1
    kind: str           # scalar type of the .lcm file
    unit: str           # N·m, "" without one
    comment: str        # of the .lcm file
    values: np.ndarray  # one per message


def entry_names(recording: Recording, channel: str, parameters: list[str]) -> list[str]:
    """Of the entries of a channel's arrays, where they have names: parameters, values of a law from outside."""
    return {"REED_ADAPTATION": parameters, "REED_LAW": recording.law_names}.get(channel, [])


def suffixes(field: Field, count: int, names: list[str]) -> list[str]:
    """Joints by number, axes by letter, the rest by name where names can be part of one."""
    if field.length == "dof":
        return [f"j{k + 1}" for k in range(count)]
    if field.length == "3":
        return ["x", "y", "z"]
    if len(names) == count and all(name.isascii() and name.isidentifier() for name in names):
        return names
    return [str(k + 1) for k in range(count)]


def flatten(type_name: str, table: dict[str, np.ndarray], names: list[str]) -> list[Column]:
    """The columns of one channel. names: of the entries of its arrays, as entry_names gives them. A value of a law is called as
    the law calls it."""
    columns = []
    for field in fields(type_name):
        values = table[field.name]
        if field.name in SIZES:
            continue
        if values.ndim == 1:
            columns.append(Column(field.name, field.kind, field.unit, field.comment, values))
            continue
        head = "" if type_name == "law_t" else f"{field.name}_"
        columns += [Column(f"{head}{name}", field.kind, field.unit, field.comment, values[:, k])
                    for k, name in enumerate(suffixes(field, values.shape[1], names))]
    return columns


def table_of(type_name: str, messages: list) -> dict[str, np.ndarray]:
    """Decoded messages of scalars as arrays, as a Recording's tables are."""
    return {field.name: np.array([getattr(message, field.name) for message in messages],
                                 dtype=None if field.kind == "string" else np.dtype(SCALARS[field.kind]).newbyteorder("="))
            for field in fields(type_name)}
