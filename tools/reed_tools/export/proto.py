"""Protobuf types made at run time from flat columns, and many equal messages encoded at once.

Every number has a wire type of fixed size, so all messages of a channel have one length and the same tags in the same
places: a numpy record array is the wire format, and 300 000 messages take a tenth of a second."""

import numpy as np
from google.protobuf.descriptor_pb2 import FieldDescriptorProto, FileDescriptorProto, FileDescriptorSet
from google.protobuf.descriptor_pool import DescriptorPool
from google.protobuf.message_factory import GetMessageClass

from reed_tools.record.message_layout import SCALARS, fields

TYPES = {"double": FieldDescriptorProto.TYPE_DOUBLE, "float": FieldDescriptorProto.TYPE_FLOAT,
         "int64_t": FieldDescriptorProto.TYPE_SFIXED64, "int32_t": FieldDescriptorProto.TYPE_SFIXED32,
         "int8_t": FieldDescriptorProto.TYPE_SFIXED32, "boolean": FieldDescriptorProto.TYPE_BOOL,
         "string": FieldDescriptorProto.TYPE_STRING}
WIRE = {"double": ("<f8", 1), "float": ("<f4", 5), "int64_t": ("<i8", 1), "int32_t": ("<i4", 5), "int8_t": ("<i4", 5), "boolean": ("u1", 0)}
FILE_MESSAGE, MESSAGE_FIELD = 4, 2  # field numbers in descriptor.proto: the path from a file to a field's comment


def describe(type_name: str, entries: list[tuple[str, str, str, bool]]) -> FileDescriptorSet:
    """The file with one message reed.TYPE of (name, kind, comment, repeated); the comments go along."""
    file = FileDescriptorProto(name=f"reed/{type_name}.proto", package="reed", syntax="proto3")
    message = file.message_type.add(name=type_name)
    for k, (name, kind, comment, repeated) in enumerate(entries):
        label = FieldDescriptorProto.LABEL_REPEATED if repeated else FieldDescriptorProto.LABEL_OPTIONAL
        message.field.add(name=name, number=k + 1, type=TYPES[kind], label=label)
        if comment:
            file.source_code_info.location.add(path=[FILE_MESSAGE, 0, MESSAGE_FIELD, k], span=[k, 0, 0], trailing_comments=f" {comment}\n")
    return FileDescriptorSet(file=[file])


def describe_columns(type_name: str, columns: list) -> FileDescriptorSet:
    return describe(type_name, [(column.name, column.kind, column.comment, False) for column in columns])


def describe_message(type_name: str) -> FileDescriptorSet:
    """A message as its .lcm file has it, arrays as repeated fields: for those that nobody draws as curves."""
    return describe(type_name, [(field.name, field.kind, field.comment, field.length is not None) for field in fields(type_name)])


def message_class(described: FileDescriptorSet):
    pool = DescriptorPool()
    file = described.file[0]
    pool.Add(file)
    return GetMessageClass(pool.FindMessageTypeByName(f"{file.package}.{file.message_type[0].name}"))


def varint(number: int) -> list[int]:
    found = []
    while number > 0x7F:
        found.append(number & 0x7F | 0x80)
        number >>= 7
    return [*found, number]


def encode(columns: list) -> tuple[memoryview, int]:
    """(bytes of all messages one behind the other, bytes of one)."""
    tags = [varint((k + 1) << 3 | WIRE[column.kind][1]) for k, column in enumerate(columns)]
    layout = []
    for k, column in enumerate(columns):
        layout += [(f"tag{k}", "u1", (len(tags[k]),)), (f"value{k}", WIRE[column.kind][0])]
    records = np.zeros(len(columns[0].values), dtype=layout)
    for k, column in enumerate(columns):
        records[f"tag{k}"] = tags[k]
        records[f"value{k}"] = column.values
    return memoryview(records.tobytes()), records.dtype.itemsize


def encode_message(type_name: str, made, message) -> bytes:
    """A decoded LCM message in the protobuf class that describe_message gives."""
    for field in fields(type_name):
        value = getattr(message, field.name)
        if field.length is None:
            setattr(made, field.name, value)
        else:
            getattr(made, field.name).extend(value)
    return made.SerializeToString()


assert set(SCALARS) | {"string"} == set(TYPES)
