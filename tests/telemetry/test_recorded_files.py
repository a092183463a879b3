"""What Reed records, read by programs that are not Reed's: the numbers must be the ones that sample_snapshot.h put in."""

import os
import re
import subprocess
import sys
from pathlib import Path

import can
import cantools
import lcm
import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("REED_BUILD_DIR", ROOT / "build" / "release"))
CYCLES = 321
DOF, PARAMETERS = 5, 6

# sample_snapshot.h: number of the field, by name
MEASURED = {"position": 1, "velocity": 2, "torque": 3, "force": 4, "moment": 5}
CONTROL = {
    "theta_plan": 7, "theta_d": 8, "theta_d_dot": 9, "e": 10, "s": 11, "v": 12, "v_dot": 13, "tau_law": 14,
    "tau": 15, "D": 16, "normal": 17, "tip_plan": 23, "observer": 24,
}
CONTROL_SCALARS = {"t_s": 6, "f_d": 18, "f": 19, "e_f": 20, "e_f_integral": 21, "z": 22, "k_hat_e": 25}
ADAPTATION = {"p_hat": 26, "eta_hat": 27}
BUS = [
    "frames_rx", "frames_tx", "lost", "crc_errors", "repeated", "wrong_sequence", "wrong_length", "out_of_range",
    "unknown_id", "malformed", "error_frames", "overflowed", "tx_refused", "late",
]


def value(field, index, cycle):
    return 100.0 * field + index + 0.0009765625 * cycle


def values(field, count, cycle):
    return [value(field, i, cycle) for i in range(count)]


def payload(identifier, cycle):
    return bytes((cycle + i + identifier) & 0xFF for i in range(16))


@pytest.fixture(scope="module")
def types():
    sys.path.insert(0, str(BUILD / "lcmtypes" / "python"))
    import reed

    yield reed
    sys.path.pop(0)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    folder = tmp_path_factory.mktemp("recorded")
    log, candump = folder / "telemetry.lcmlog", folder / "bus.candump"
    subprocess.run([BUILD / "bin" / "reed_record_sample", log, candump, str(CYCLES)], check=True, timeout=60)
    return log, candump


@pytest.fixture(scope="module")
def events(recorded):
    return list(lcm.EventLog(str(recorded[0]), "r"))


def decoded(events, channel, message_type):
    return [message_type.decode(event.data) for event in events if event.channel == channel]


def test_every_cycle_of_every_channel_is_in_the_log(events, types):
    for channel in ("MEASURED", "CONTROL", "ADAPTATION", "TIMING"):
        messages = decoded(events, f"REED_{channel}", getattr(types, f"{channel.lower()}_t"))
        assert [m.cycle for m in messages] == list(range(CYCLES))
        assert [m.utime for m in messages] == [1000 * cycle for cycle in range(CYCLES)]
    assert [event.timestamp for event in events] == sorted(event.timestamp for event in events)


def test_measurements_are_bit_exact(events, types):
    for m in decoded(events, "REED_MEASURED", types.measured_t):
        assert m.dof == DOF
        for name, field in MEASURED.items():
            count = 3 if name in ("force", "moment") else DOF
            assert list(getattr(m, name)) == values(field, count, m.cycle), name
        assert list(m.age) == [m.cycle % 7 + i for i in range(DOF)]
        assert list(m.drive_state) == [i % 5 for i in range(DOF)]
        assert m.wrench_age == m.cycle % 3


def test_control_is_bit_exact(events, types):
    for c in decoded(events, "REED_CONTROL", types.control_t):
        for name, field in CONTROL.items():
            count = 3 if name in ("normal", "tip_plan") else DOF
            assert list(getattr(c, name)) == values(field, count, c.cycle), name
        for name, field in CONTROL_SCALARS.items():
            assert getattr(c, name) == value(field, 0, c.cycle), name
        assert (c.mode, c.force_source, c.limits) == (2, 1, c.cycle & 0x3F)


def test_adaptation_is_bit_exact(events, types):
    for a in decoded(events, "REED_ADAPTATION", types.adaptation_t):
        for name, field in ADAPTATION.items():
            assert list(getattr(a, name)) == values(field, PARAMETERS, a.cycle), name
        assert (a.sigma0, a.sigma1) == (value(28, 0, a.cycle), value(29, 0, a.cycle))


def test_timing_bus_and_events_are_exact(events, types):
    for t in decoded(events, "REED_TIMING", types.timing_t):
        assert [t.wake_ns, t.rx_ns, t.compute_ns, t.tx_ns, t.cycle_ns] == [101, 102, 103, 104, 105]
        assert [t.missed, t.missed_host_paused, t.overruns, t.dropped] == [t.cycle + 106 + i for i in range(4)]

    counters = decoded(events, "REED_BUS", types.bus_t)
    assert [b.cycle for b in counters] == [0, 100, 200, 300, 320]
    for b in counters:
        assert [getattr(b, name) for name in BUS] == [b.cycle + 1 + i for i in range(len(BUS))]

    happened = decoded(events, "REED_EVENT", types.event_t)
    assert [e.cycle for e in happened] == list(range(0, CYCLES, 50))
    for e in happened:
        assert (e.mode, e.force_source, e.code, e.joint) == (3, 2, e.cycle // 50, 1)
        assert e.value == value(30, 0, e.cycle)
        assert e.text == ("one" if e.code == 1 else "some event")


def test_run_messages_come_first_and_last(events, types):
    runs = decoded(events, "REED_RUN", types.run_t)
    assert [run.finished for run in runs] == [False, True]
    assert events[0].channel == events[-1].channel == "REED_RUN"
    assert runs[0].scenario == "sample"


def test_python_can_reads_the_can_log(recorded):
    messages = list(can.CanutilsLogReader(str(recorded[1])))
    assert len(messages) == 2 * CYCLES
    for i, message in enumerate(messages):
        cycle, identifier = i // 2, (0x080, 0x101)[i % 2]
        assert message.arbitration_id == identifier
        assert message.is_fd and message.bitrate_switch and not message.is_extended_id
        assert message.channel == "vcan0"
        assert message.timestamp == pytest.approx(cycle * 1e-3, abs=1e-9)
        assert bytes(message.data) == payload(identifier, cycle)


def test_cantools_decodes_the_can_log(recorded, tmp_path):
    dbc = tmp_path / "sample.dbc"
    dbc.write_text(
        'VERSION ""\nNS_ :\nBS_:\nBU_: A\n'
        'BO_ 257 Ramp: 16 A\n SG_ First : 0|8@1+ (1,0) [0|255] "" A\n SG_ Pair : 112|16@1+ (0.5,0) [0|32768] "" A\n'
        'BA_DEF_ BO_ "VFrameFormat" ENUM "StandardCAN","ExtendedCAN","r","r","r","r","r","r","r","r","r","r","r","r",'
        '"StandardCAN_FD";\nBA_DEF_DEF_ "VFrameFormat" "StandardCAN";\nBA_ "VFrameFormat" BO_ 257 14;\n'
    )
    text = recorded[1].read_text()
    database = cantools.database.load_file(dbc)
    shown = subprocess.run(
        [sys.executable, "-m", "cantools", "decode", "--single-line", str(dbc)],
        input=text, capture_output=True, text=True, check=True, timeout=60,
    ).stdout
    pairs = re.findall(r"Ramp\(First: (\d+), Pair: ([\d.]+)\)", shown)
    assert len(pairs) == CYCLES
    for cycle, (first, pair) in enumerate(pairs):
        expected = database.decode_message(257, payload(0x101, cycle))
        assert (float(first), float(pair)) == (expected["First"], expected["Pair"])


def test_the_lines_are_what_candump_writes(recorded):
    line = re.compile(r"^\(\d{10}\.\d{6}\) vcan0 [0-9A-F]{3}##1([0-9A-F]{2}){16}$")
    lines = recorded[1].read_text().splitlines()
    assert len(lines) == 2 * CYCLES
    assert all(line.match(text) for text in lines)
