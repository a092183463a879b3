"""CSV and Parquet: one row per cycle with every channel beside each other, and the events in a file of their own."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from reed_tools.export.columns import Column, entry_names, flatten, table_of
from reed_tools.record.telemetry_log import SINGLES, TABLES, Recording, name_of

CYCLIC = ("REED_MEASURED", "REED_CONTROL", "REED_ADAPTATION", "REED_TIMING", "REED_PLANT", "REED_BUS", "REED_LAW")
EVENTS = ("REED_EVENT", "REED_PLANT_EVENT")


@dataclass
class Row:
    """One column of the wide table: values where the channel was recorded in that cycle."""

    column: Column      # its name begins with the channel: control.tau_j1
    present: np.ndarray


def cyclic_rows(recording: Recording, parameters: list[str]) -> tuple[np.ndarray, list[Row]]:
    """The cycles, and every column over them. A cycle that a channel recorded twice is there with its last message."""
    channels = [channel for channel in CYCLIC if channel != "REED_LAW" or recording.has(channel)]
    tables = {channel: flatten(TABLES[channel], recording.tables[channel], entry_names(recording, channel, parameters)) if channel in TABLES else
              flatten(SINGLES[channel], table_of(SINGLES[channel], recording.singles[channel]), []) for channel in channels}
    own = {channel: next(column.values for column in columns if column.name == "cycle") for channel, columns in tables.items()}
    cycles = np.unique(np.concatenate(list(own.values()))).astype(np.int64)
    rows = []
    for channel, columns in tables.items():
        at = np.searchsorted(cycles, own[channel])
        present = np.zeros(len(cycles), dtype=bool)
        present[at] = True
        for column in columns:
            if column.name == "cycle":
                continue
            values = np.zeros(len(cycles), dtype=column.values.dtype)
            values[at] = column.values
            name = name_of(channel, column.name)
            rows.append(Row(Column(name, column.kind, column.unit, column.comment, values), present))
    return cycles, rows


def event_columns(recording: Recording) -> list[Column]:
    messages = [(channel, message) for channel in EVENTS for message in recording.singles[channel]]
    messages.sort(key=lambda item: item[1].utime)
    columns = flatten("event_t", table_of("event_t", [message for _, message in messages]), [])
    return [Column("channel", "string", "", "", np.array([channel for channel, _ in messages], dtype=object)), *columns]


def beside(target: Path, what: str) -> Path:
    return target.with_name(f"{target.stem}-{what}{target.suffix}")


def title(column: Column) -> str:
    return f"{column.name} [{column.unit}]" if column.unit else column.name


def write_csv(recording: Recording, parameters: list[str], target: Path) -> list[Path]:
    """A float is written with the fewest digits that read back as the same number; a cycle without the message is an empty cell."""
    cycles, rows = cyclic_rows(recording, parameters)
    cells = [cycles.tolist()]
    for row in rows:
        values = (row.column.values * 1 if row.column.kind == "boolean" else row.column.values).tolist()
        cells.append(values if row.present.all() else [value if there else "" for value, there in zip(values, row.present)])
    events = event_columns(recording)
    save(target, ["cycle", *(title(row.column) for row in rows)], cells)
    save(beside(target, "events"), [title(column) for column in events], [column.values.tolist() for column in events])
    return [target, beside(target, "events")]


def save(target: Path, head: list[str], columns: list[list]) -> None:
    with open(target, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(head)
        writer.writerows(zip(*columns))


def write_parquet(recording: Recording, parameters: list[str], target: Path) -> list[Path]:
    """Units are metadata of each field (key "unit"), the comment beside it; a cycle without the message is null."""
    import pyarrow
    from pyarrow import parquet

    def save(path: Path, columns: list[tuple[Column, np.ndarray | None]]) -> None:
        arrays = [pyarrow.array(column.values, mask=None if present is None else ~present) for column, present in columns]
        schema = pyarrow.schema([pyarrow.field(column.name, array.type, metadata={"unit": column.unit, "comment": column.comment})
                                 for (column, _), array in zip(columns, arrays)])
        parquet.write_table(pyarrow.Table.from_arrays(arrays, schema=schema), path)

    cycles, rows = cyclic_rows(recording, parameters)
    save(target, [(Column("cycle", "int64_t", "", "", cycles), None), *((row.column, row.present) for row in rows)])
    save(beside(target, "events"), [(column, None) for column in event_columns(recording)])
    return [target, beside(target, "events")]
