"""Every format is read by a library that is not ours, and every value must be the one in the telemetry log or the candump."""

import csv
import json
import math
import struct
import subprocess
import time
from pathlib import Path

import can
import lcm
import lockstep_run
import numpy as np
import own_address
import pytest
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory
from pyarrow import parquet

from reed_tools.export import mcap_file, tables
from reed_tools.paths import PYTHON, ROOT, use_message_types
from reed_tools.record import configuration, telemetry_log
from reed_tools.record.message_layout import fields

BUS = own_address.bus()
# Without those of a law from outside: tests/law has one, and exports it.
TYPES = {channel: name for channel, name in (telemetry_log.TABLES | telemetry_log.SINGLES).items() if not channel.startswith("REED_LAW")}
AXES = "xyz"
MAIN = str(ROOT / "tools" / "reed_tools" / "__main__.py")


def reed(*argv):
    return subprocess.run([*PYTHON, MAIN, *map(str, argv)], capture_output=True, text=True, timeout=120)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A short run of both programs that touches the wall; one position is spoilt to NaN afterwards: it must survive."""
    folder = lockstep_run.record(tmp_path_factory.mktemp("run"), BUS, "press_known", "scenario.duration_s=0.6", "scenario.seed=77",
                                 "link.wire_time=true")
    spoil(folder / "telemetry.lcmlog", cycle=200)
    return folder


def spoil(path: Path, cycle: int) -> None:
    use_message_types()
    import reed

    events = [(event.timestamp, event.channel, event.data) for event in lcm.EventLog(str(path), "r")]
    path.unlink()
    log = lcm.EventLog(str(path), "w")
    for utime, channel, data in events:
        if channel == "REED_MEASURED" and (message := reed.measured_t.decode(data)).cycle == cycle:
            message.position = [math.nan, *message.position[1:]]
            data = message.encode()
        log.write_event(utime, channel, data)
    log.close()


@pytest.fixture(scope="module")
def messages(folder):
    """channel -> messages, by LCM's own classes."""
    use_message_types()
    import reed

    found = {channel: [] for channel in TYPES}
    for event in lcm.EventLog(str(folder / "telemetry.lcmlog"), "r"):
        found[event.channel].append(getattr(reed, TYPES[event.channel]).decode(event.data))
    assert all(found.values()), "every channel is part of the test"
    return found


def flat(channel, message):
    """Names and values that a flat message must have, written down independently of reed_tools.export."""
    parameters = ["m2", "I1", "bv", "m3", "m4", "mL"]
    for field in fields(TYPES[channel]):
        value = getattr(message, field.name)
        if field.name in ("dof", "num"):
            continue
        if field.length is None:
            yield field.name, value
        else:
            names = {"dof": [f"j{k + 1}" for k in range(5)], "3": AXES}.get(field.length) or (
                parameters if channel == "REED_ADAPTATION" else range(1, 1 + len(value)))
            yield from ((f"{field.name}_{name}", one) for name, one in zip(names, value, strict=True))


def bits(value):
    return struct.pack("<d", value) if isinstance(value, float) else value


@pytest.fixture(scope="module")
def mcap(folder):
    done = reed("export", folder, "--to", "mcap")
    assert done.returncode == 0, done.stderr
    return folder / "telemetry.mcap"


def read_mcap(path):
    with open(path, "rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        found = {}
        for schema, channel, message, decoded in reader.iter_decoded_messages():
            found.setdefault(channel.topic, []).append((message, decoded, schema, channel))
        return found, list(reader.iter_metadata())


def test_mcap_holds_every_value_of_every_channel(mcap, messages):
    read, metadata = read_mcap(mcap)
    for channel, originals in messages.items():
        assert len(read[channel]) == len(originals), channel
        for (message, decoded, _, _), original in zip(read[channel], originals):
            assert message.log_time == original.utime * 1000
            if channel in telemetry_log.TABLES or channel == "REED_BUS":
                wanted = dict(flat(channel, original))
                assert [field.name for field in decoded.DESCRIPTOR.fields] == list(wanted)
                for name, value in wanted.items():
                    assert bits(getattr(decoded, name)) == bits(value), (channel, name)
            else:
                for field in fields(TYPES[channel]):
                    value = getattr(decoded, field.name)
                    assert (list(value) if field.length else value) == (
                        list(getattr(original, field.name)) if field.length else getattr(original, field.name)), (channel, field.name)
    assert math.isnan(read["REED_MEASURED"][200][1].position_j1)
    assert metadata[0].metadata["scenario"] == "press_known" and metadata[0].metadata["seed"] == "77"


def test_units_are_in_the_schema_and_beside_the_channel(mcap):
    read, _ = read_mcap(mcap)
    _, decoded, schema, channel = read["REED_MEASURED"][0]
    assert channel.metadata["torque_j1"] == "N·m" and channel.metadata["position_j5"] == "rad"
    from google.protobuf.descriptor_pb2 import FileDescriptorSet

    file = FileDescriptorSet.FromString(schema.data).file[0]
    number = [field.name for field in file.message_type[0].field].index("torque_j1")
    comments = {tuple(location.path): location.trailing_comments for location in file.source_code_info.location}
    assert comments[(4, 0, 2, number)].startswith(" N·m, applied by the drive")


def test_every_number_of_the_types_has_a_unit_or_is_known_to_have_none():
    without = {"p_hat", "eta_hat", "normal", "value"}  # units of the arm file; a direction; the unit is in the event's text
    for type_name in TYPES.values():
        for field in fields(type_name):
            assert field.unit or field.kind not in ("double", "float") or field.name in without, (type_name, field)


def test_viewers_see_the_true_arm_its_frames_the_wall_the_force_and_the_events(mcap, messages):
    read, _ = read_mcap(mcap)
    plants = {message.cycle: message for message in messages["REED_PLANT"]}
    controls = {message.cycle: message for message in messages["REED_CONTROL"]}
    assert len(read["/scene"]) == len(read["/tf"]) == len(messages["REED_SHAPE"])
    pressed = 0
    for (_, update, schema, _), (_, frames, _, _), shape in zip(read["/scene"], read["/tf"], messages["REED_SHAPE"]):
        assert schema.name == "foxglove.SceneUpdate"
        found = {entity.id: entity for entity in update.entities}
        arm = found["arm"].lines[0].points
        assert [(p.x, p.y, p.z) for p in arm] == list(zip(shape.x, shape.y, shape.z))
        plant = plants[shape.cycle]
        assert (arm[-1].x, arm[-1].y, arm[-1].z) == pytest.approx(plant.tip, abs=1e-7)
        desired = found["desired arm"].lines[0].points[-1]
        assert math.dist((desired.x, desired.y, desired.z), controls[shape.cycle].tip_plan) < 6e-3  # sag and nodal compensation
        top = found["wall"].cubes[0]
        assert top.pose.position.z + top.size.z / 2 == pytest.approx(0.155)
        size_N = math.hypot(*plant.contact_force)
        arrows = found["force on the tip"].arrows
        assert len(arrows) == (size_N >= 0.05)
        if arrows:
            pressed += 1
            assert arrows[0].shaft_length == pytest.approx(0.01 * size_N)
            q = arrows[0].pose.orientation  # x axis of the arrow in world axes
            direction = (1 - 2 * (q.y**2 + q.z**2), 2 * (q.x * q.y + q.w * q.z), 2 * (q.x * q.z - q.w * q.y))
            assert direction == pytest.approx(np.array(plant.contact_force) / size_N)
        assert end_of_chain(frames) == pytest.approx(tip_of_a5(measured_at(messages, shape.cycle)), abs=1e-12)
    assert pressed > 10
    said = [(line.name, line.message) for _, line, _, _ in read["/log"]]
    assert ("firmware", "mode changed") in said and len(said) == len(messages["REED_EVENT"]) + len(messages["REED_PLANT_EVENT"])


def measured_at(messages, cycle):
    return next(message.position for message in messages["REED_MEASURED"] if message.cycle == cycle)


def tip_of_a5(q):
    """By hand: three lengths in a plane that the first joint turns; the hand points along -z of the fourth link's frame."""
    a, b, c = q[1], q[1] + q[2], q[1] + q[2] + q[3]
    radius = 0.35 * math.cos(a) + 0.3 * math.cos(b) - 0.15 * math.sin(c)
    return radius * math.cos(q[0]), radius * math.sin(q[0]), 0.2 + 0.35 * math.sin(a) + 0.3 * math.sin(b) + 0.15 * math.cos(c)


def end_of_chain(frames):
    parent, p, R = "base", np.zeros(3), np.eye(3)
    for frame in frames.transforms[:5]:
        assert frame.parent_frame_id == parent
        parent, t, q = frame.child_frame_id, frame.translation, frame.rotation
        p = p + R @ [t.x, t.y, t.z]
        w, x, y, z = q.w, q.x, q.y, q.z
        R = R @ np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                          [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                          [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    assert (frames.transforms[5].parent_frame_id, frames.transforms[5].child_frame_id) == (parent, "force_sensor")
    return tuple(p)


def test_the_layout_draws_only_what_a_file_has(mcap):
    layout = json.loads((ROOT / "docs/foxglove_layout.json").read_text())
    read, _ = read_mcap(mcap)
    paths = [path["value"] for panel in layout["configById"].values() for path in panel.get("paths", [])]
    assert len(paths) > 20
    for path in paths:
        topic, _, name = path.partition(".")
        known = {field.name for field in read[topic][0][1].DESCRIPTOR.fields}
        assert name in known or (name[-3:-1] == "_j" and f"{name[:-1]}1" in known), path  # joints that this arm has not
    assert layout["configById"]["RosOut!log"]["topicToRender"] in read and "/scene" in layout["configById"]["3D!arm"]["topics"]

    def leaves(node):
        return [node] if isinstance(node, str) else leaves(node["first"]) + leaves(node["second"])

    assert sorted(leaves(layout["layout"])) == sorted(layout["configById"])


def wide(messages):
    """{column: {cycle: value}} of the wide table."""
    found = {}
    for channel in filter(TYPES.get, tables.CYCLIC):
        for message in messages[channel]:
            for name, value in flat(channel, message):
                if name != "cycle":
                    found.setdefault(f"{channel[5:].lower()}.{name}", {})[message.cycle] = value
    return found


def test_csv_holds_every_value(folder, messages, tmp_path):
    target = tmp_path / "run.csv"
    done = reed("export", folder, "--to", "csv", "--out", target)
    assert done.returncode == 0, done.stderr
    with open(target, newline="") as file:
        head, *rows = csv.reader(file)
    names = [title.partition(" [")[0] for title in head]
    assert "measured.torque_j1 [N·m]" in head
    wanted = wide(messages)
    assert names[0] == "cycle" and set(names[1:]) == set(wanted)
    cycles = [int(row[0]) for row in rows]
    for k, name in enumerate(names[1:], 1):
        column = wanted[name]
        for cycle, row in zip(cycles, rows):
            if cycle not in column:
                assert row[k] == "", (name, cycle)
            else:
                value = column[cycle]
                read = float(row[k]) if isinstance(value, float) else int(row[k])
                assert bits(read) == bits(value) or (read != read and value != value), (name, cycle)
    with open(tmp_path / "run-events.csv", newline="") as file:
        events = list(csv.DictReader(file))
    assert sorted(event["text"] for event in events) == sorted(
        message.text for channel in tables.EVENTS for message in messages[channel])


def test_parquet_holds_every_value_with_its_unit(folder, messages, tmp_path):
    target = tmp_path / "run.parquet"
    done = reed("export", folder, "--to", "parquet", "--out", target)
    assert done.returncode == 0, done.stderr
    table = parquet.read_table(target)
    wanted = wide(messages)
    assert table.column_names[0] == "cycle" and set(table.column_names[1:]) == set(wanted)
    cycles = table["cycle"].to_pylist()
    for name in table.column_names[1:]:
        values = dict(zip(cycles, table[name].to_pylist()))
        for cycle in cycles:
            expected = wanted[name].get(cycle)
            assert bits(values[cycle]) == bits(expected) or (values[cycle] != values[cycle] and expected != expected), (name, cycle)
    assert table.schema.field("control.tau_j3").metadata[b"unit"] == "N·m".encode()
    events = parquet.read_table(tmp_path / "run-events.parquet")
    assert events["code"].to_pylist() == [message.code for message in sorted(
        (message for channel in tables.EVENTS for message in messages[channel]), key=lambda message: message.utime)]


@pytest.mark.parametrize("kind, reader", [("asc", lambda path: can.ASCReader(path, relative_timestamp=False)), ("blf", can.BLFReader)])
def test_can_logs_hold_every_frame_with_fd_and_bit_rate_switch(folder, tmp_path, kind, reader):
    done = reed("export", folder, "--to", kind, "--out", tmp_path / f"bus.{kind}")
    assert done.returncode == 0, done.stderr
    recorded = list(can.CanutilsLogReader(folder / "bus.candump"))
    read = list(reader(tmp_path / f"bus.{kind}"))
    assert len(read) == len(recorded) > 4000
    for one, other in zip(read, recorded):
        assert (one.arbitration_id, bytes(one.data), one.dlc, one.is_fd, one.bitrate_switch, one.error_state_indicator, one.is_extended_id,
                one.is_rx) == (other.arbitration_id, bytes(other.data), other.dlc, True, True, False, False, other.is_rx)
        assert one.timestamp == pytest.approx(other.timestamp, abs=1e-6)


def test_an_asc_file_is_dated_with_the_recording(tmp_path):
    (tmp_path / "bus.candump").write_text("(1700000000.250000) can0 080##10011223344556677\n(1700000000.251000) can0 101##1" + "00" * 16 + "\n")
    done = reed("export", tmp_path, "--to", "asc")
    assert done.returncode == 0, done.stderr
    head = (tmp_path / "bus.asc").read_text().splitlines()[0]
    assert head == time.strftime("date %a %b %d %H:%M:%S.250 %Y", time.localtime(1700000000))
    assert [message.timestamp for message in can.ASCReader(tmp_path / "bus.asc", relative_timestamp=False)] == pytest.approx(
        [1700000000.25, 1700000000.251])


def test_a_minute_as_mcap_takes_less_than_ten_seconds_of_one_core(folder, tmp_path):
    recording = telemetry_log.load(folder / "telemetry.lcmlog")
    cycles = len(recording.tables["REED_CONTROL"]["cycle"])
    times = math.ceil(60_000 / cycles)
    for table in recording.tables.values():
        lap = np.repeat(np.arange(times), len(table["cycle"]))
        for name in table:
            table[name] = np.concatenate([table[name]] * times)
        table["cycle"] = table["cycle"] + lap * cycles
        table["utime"] = table["utime"] + lap * cycles * 1000
    started = time.process_time()
    mcap_file.write(recording, configuration.load(folder / "effective.toml"), tmp_path / "minute.mcap")
    spent_s = time.process_time() - started
    with open(tmp_path / "minute.mcap", "rb") as file:
        statistics = make_reader(file).get_summary().statistics
    assert statistics.message_count > 5 * 60_000 and statistics.message_end_time - statistics.message_start_time > 59e9
    print(f"{statistics.message_count} messages in {spent_s:.1f} s")
    assert spent_s < 10.0


@pytest.mark.parametrize("argv, status, told", [
    (["/nowhere", "--to", "mcap"], 2, "effective.toml"),
    (["/nowhere", "--to", "blf"], 2, "bus.candump"),
    (["{folder}", "--to", "trc"], 2, "mcap"),
    (["{folder}", "--to", "csv", "--out", "/nowhere/x.csv"], 2, "/nowhere"),
    (["{folder}", "--to", "csv", "--out", "/tmp"], 2, "folder"),
    (["{folder}", "--to", "mf4"], 3, "-m pip install asammdf"),
])
def test_bad_input_is_one_line(folder, argv, status, told):
    done = reed("export", *(word.format(folder=folder) for word in argv))
    assert done.returncode == status and told in done.stderr and len(done.stderr.splitlines()) == 1, done.stderr


@pytest.mark.parametrize("kind, package", [("mcap", "mcap"), ("mcap", "google"), ("parquet", "pyarrow")])
def test_a_missing_package_is_one_line_with_the_command_that_installs_it(folder, tmp_path, kind, package):
    script = (f"import sys; sys.path.insert(0, {str(ROOT / 'tools')!r}); sys.modules[{package!r}] = None\n"
              "from reed_tools.cli import main; sys.exit(main(sys.argv[1:]))")
    done = subprocess.run([*PYTHON, "-c", script, "export", str(folder), "--to", kind, "--out", str(tmp_path / "x")],
                          capture_output=True, text=True, timeout=60)
    assert done.returncode == 3 and len(done.stderr.splitlines()) == 1, done.stderr
    assert package in done.stderr and "pip install -r tools/requirements-export.txt" in done.stderr
    assert not list(tmp_path.iterdir())


def test_a_damaged_log_is_one_line_and_leaves_no_file(folder, tmp_path):
    for name in ("effective.toml", "telemetry.lcmlog"):
        (tmp_path / name).write_bytes((folder / name).read_bytes())
    with open(tmp_path / "telemetry.lcmlog", "r+b") as file:
        file.truncate(file.seek(0, 2) - 100)
    done = reed("export", tmp_path, "--to", "mcap")
    assert done.returncode == 2 and "is damaged" in done.stderr and not (tmp_path / "telemetry.mcap").exists()
    (tmp_path / "bus.candump").write_text("(0.000000) vcan0 080##10011\nnonsense\n")
    done = reed("export", tmp_path, "--to", "blf")
    assert done.returncode == 2 and "bus.candump:2:" in done.stderr and not (tmp_path / "bus.blf").exists()
