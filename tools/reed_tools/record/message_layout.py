"""Many equal messages decoded at once: the .lcm file as a numpy record type. A minute of telemetry is 300 000 messages;
the generated classes need half a minute for them, this needs a tenth of a second."""

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.paths import ROOT
from reed_tools.record import lcm_file
from reed_tools.record.lcm_file import Field

SCALARS = {"int8_t": "i1", "boolean": "?", "int32_t": ">i4", "int64_t": ">i8", "float": ">f4", "double": ">f8"}
FINGERPRINT = np.dtype((np.void, 8))


def fields(type_name: str) -> list[Field]:
    """In the order of lcmtypes/TYPE.lcm."""
    return lcm_file.fields(ROOT / "lcmtypes" / f"{type_name}.lcm")


def record_type(type_name: str, sample) -> np.dtype:
    """The layout that all messages share which have the array lengths of `sample` (a decoded message)."""
    record = [("fingerprint", FINGERPRINT)]
    for field in fields(type_name):
        length = field.length
        count = () if length is None else (int(length) if length.isdigit() else getattr(sample, length),)
        record.append((field.name, SCALARS[field.kind], count))
    return np.dtype(record)


def joined(type_name: str, blocks: list[np.ndarray]) -> np.ndarray:
    """All messages of one channel, [messages, bytes]."""
    odd = next((block for block in blocks if block.shape[1] != blocks[0].shape[1]), None)
    if odd is not None:
        raise UsageError(f"{type_name}: a message of {odd.shape[1]} bytes among messages of {blocks[0].shape[1]}; the log is not of one run")
    return np.concatenate(blocks) if blocks else np.empty((0, 0), np.uint8)


def decode_all(message_class, type_name: str, messages: np.ndarray) -> dict[str, np.ndarray]:
    """One array per field, one row per message, in native byte order. `messages`: as joined() gives them."""
    if not len(messages):
        return {name: np.array([]) for name in message_class.__slots__}
    first = messages[0].tobytes()
    fingerprint = message_class._get_packed_fingerprint()
    if first[:8] != fingerprint:
        raise UsageError(f"{type_name}: the log was written with another version of this message than lcmtypes/{type_name}.lcm; "
                         "read it with the Reed that wrote it: `commit` in the folder's run.json")
    layout = record_type(type_name, message_class.decode(first))
    if messages.shape[1] != layout.itemsize or not np.all(messages[:, :8] == np.frombuffer(fingerprint, np.uint8)):
        raise UsageError(f"{type_name}: messages of {messages.shape[1]} bytes, not all of {layout.itemsize}; the log is not of one run")
    records = messages.reshape(-1).view(layout)
    return {name: records[name].astype(layout[name].base.newbyteorder("=")) for name in message_class.__slots__}
