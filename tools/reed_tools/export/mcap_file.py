"""MCAP: every channel in protobuf with flat joints and units, and the arm, its frames and the events as viewers know them."""

from pathlib import Path

import numpy as np
from google.protobuf.descriptor_pb2 import FileDescriptorSet
from mcap.writer import CompressionType, Writer
from mcap_protobuf.schema import build_file_descriptor_set

from reed_tools.export import proto, scene
from reed_tools.export.columns import entry_names, flatten, table_of
from reed_tools.record.message_layout import fields
from reed_tools.record.telemetry_log import SINGLES, TABLES, Recording

COUNTERS = "REED_BUS"  # scalars only: as flat as a table
CHUNK_BYTES = 4 << 20


class Stream:
    """One topic: messages by number, each with its time in ns."""

    def __init__(self, channel: int, times_ns: np.ndarray, message):
        self.channel, self.times_ns, self.message = channel, times_ns, message


class File:
    def __init__(self, file):
        self.writer = Writer(file, chunk_size=CHUNK_BYTES, compression=CompressionType.LZ4)
        self.writer.start(profile="", library="reed_tools")
        self.streams: list[Stream] = []

    def topic(self, name: str, schema: str, described: FileDescriptorSet, units: dict[str, str] | None = None) -> int:
        known = self.writer.register_schema(name=schema, encoding="protobuf", data=described.SerializeToString())
        return self.writer.register_channel(topic=name, message_encoding="protobuf", schema_id=known, metadata=units or {})

    def add(self, channel: int, times_ns: np.ndarray, message) -> None:
        if len(times_ns):
            self.streams.append(Stream(channel, times_ns, message))

    def finish(self, metadata: dict[str, str]) -> None:
        """All streams merged by time: a reader that seeks finds every topic in the same chunk."""
        stream = np.concatenate([np.full(len(one.times_ns), k) for k, one in enumerate(self.streams)])
        number = np.concatenate([np.arange(len(one.times_ns)) for one in self.streams])
        times_ns = np.concatenate([one.times_ns for one in self.streams])
        order = np.argsort(times_ns, kind="stable")
        for k, n, time_ns in zip(stream[order].tolist(), number[order].tolist(), times_ns[order].tolist()):
            one = self.streams[k]
            self.writer.add_message(one.channel, time_ns, one.message(n), time_ns, n)
        self.writer.add_metadata("reed.run", metadata)
        self.writer.finish()


def write(recording: Recording, effective: dict, target: Path) -> list[Path]:
    with open(target, "wb") as raw:
        file = File(raw)
        parameters = effective["arm"]["param_names"]
        tables = {channel: flatten(name, recording.tables[channel], entry_names(recording, channel, parameters))
                  for channel, name in TABLES.items() if channel != "REED_LAW" or recording.has(channel)}
        tables[COUNTERS] = flatten(SINGLES[COUNTERS], table_of(SINGLES[COUNTERS], recording.singles[COUNTERS]), [])
        for channel, columns in tables.items():
            add_columns(file, channel, columns)
        for channel in sorted(set(SINGLES) - {COUNTERS}):
            add_messages(file, channel, recording.singles[channel])
        for topic, made in (("/tf", scene.frames(recording, effective)), ("/scene", scene.pictures(recording, effective)),
                            ("/log", scene.log_lines(recording))):
            add_known(file, topic, made)
        file.finish(about(recording, effective))
    return [target]


def add_columns(file: File, channel: str, columns: list) -> None:
    type_name = (TABLES | SINGLES)[channel]
    units = {column.name: column.unit for column in columns if column.unit}
    known = file.topic(channel, f"reed.{type_name}", proto.describe_columns(type_name, columns), units)
    utime = next(column.values for column in columns if column.name == "utime")
    if len(utime):
        data, size = proto.encode(columns)
        file.add(known, utime.astype(np.int64) * 1000, lambda n: data[n * size:(n + 1) * size])


def add_messages(file: File, channel: str, messages: list) -> None:
    type_name = SINGLES[channel]
    described = proto.describe_message(type_name)
    made = proto.message_class(described)
    units = {field.name: field.unit for field in fields(type_name) if field.unit}
    known = file.topic(channel, f"reed.{type_name}", described, units)
    data = [proto.encode_message(type_name, made(), message) for message in messages]
    file.add(known, np.array([message.utime for message in messages], dtype=np.int64) * 1000, data.__getitem__)


def add_known(file: File, topic: str, made: scene.Made) -> None:
    descriptor = made.kind.DESCRIPTOR
    known = file.topic(topic, descriptor.full_name, build_file_descriptor_set(made.kind))
    file.add(known, made.times_ns, lambda n: made.message(n).SerializeToString())


def about(recording: Recording, effective: dict) -> dict[str, str]:
    run = recording.run
    known = {"scenario": effective["scenario"]["name"], "arm": effective["arm"]["name"], "seed": effective["scenario"]["seed"]}
    return {name: str(value) for name, value in (known | ({"law": run.law, "clock": run.clock} if run else {})).items()}
