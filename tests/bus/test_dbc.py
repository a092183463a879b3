"""bus/reed.dbc is documented throughout, and generate_layout.py refuses one that the code could not serve."""

import hashlib
import pathlib
import subprocess
import sys

import pytest

CONTRACT = {"SYNC": (0x080, 8), "WRENCH": (0x140, 32), "COMMAND": (0x200, 48),
            **{f"JOINT_STATE_{i}": (0x100 + i, 16) for i in range(1, 9)}}
UNITS = {"position": "rad", "velocity": "rad/s", "torque": "Nm", "force": "N", "moment": "Nm"}
CHOICES = {"drive_state": ["Off", "Ready", "Enabled", "Braked", "Fault"], "request": ["Off", "Ready", "Enable"]}


def generate(dbc, out):
    script = pathlib.Path(__file__).resolve().parents[2] / "bus" / "codec" / "generate_layout.py"
    return subprocess.run([sys.executable, script, dbc, out], capture_output=True, text=True)


def test_frames_are_those_of_the_contract(database):
    assert {m.name: (m.frame_id, m.length) for m in database.messages} == CONTRACT
    assert all(m.is_fd and not m.is_extended_frame for m in database.messages)


def test_a_joint_states_what_a_real_drive_knows_and_nothing_of_a_simulator(database):
    for i in range(1, 9):
        assert [signal.name for signal in database.get_message_by_name(f"JOINT_STATE_{i}").signals] == \
            ["crc", "counter", "drive_state", "cycle_low4", "position", "velocity", "torque"]


def test_every_frame_and_signal_has_a_comment_and_every_float_a_unit_and_a_range(database):
    for message in database.messages:
        assert message.comment
        for signal in message.signals:
            assert signal.comment, f"{message.name}.{signal.name}"
            assert signal.byte_order == "little_endian"
            if signal.is_float:
                assert signal.length == 32 and signal.minimum < 0 < signal.maximum
                assert signal.unit == UNITS[signal.name.split("_")[0]]
            if signal.name in CHOICES:
                assert list(map(str, signal.choices.values())) == CHOICES[signal.name]


def test_every_frame_begins_with_e2e_profile_5_and_has_its_own_data_id(database):
    for message in database.messages:
        assert [(s.name, s.start, s.length) for s in message.signals[:2]] == [("crc", 0, 16), ("counter", 16, 8)]
    assert len({m.dbc.attributes["E2EDataId"].value for m in database.messages}) == len(CONTRACT)


def test_header_of_this_build_is_the_one_of_this_dbc(tmp_path, dbc, build_dir):
    out = tmp_path / "reed_layout.h"
    assert generate(dbc, out).returncode == 0
    assert hashlib.sha256(dbc.read_bytes()).hexdigest() in out.read_text()
    assert out.read_text() == (build_dir / "bus" / "generated" / "reed_layout.h").read_text()


@pytest.mark.parametrize("old, new, complaint", [
    ('BA_ "VFrameFormat" BO_ 320 14;', "", "WRENCH: must be a CAN FD frame"),
    ("BO_ 320 WRENCH: 32", "BO_ 320 WRENCH: 33", "WRENCH: must be a CAN FD frame"),
    ('BA_ "E2EDataId" BO_ 320 20800;', "", "WRENCH: no attribute E2EDataId"),
    ('BA_ "E2EDataId" BO_ 320 20800;', 'BA_ "E2EDataId" BO_ 320 20608;', "WRENCH: E2EDataId 20608 is already that of SYNC"),
    ("SG_ counter : 16|8@1+ (1,0) [0|255] \"\" CONTROLLER", "SG_ count : 16|8@1+ (1,0) [0|255] \"\" CONTROLLER",
     "must begin with crc (16 bit) and counter (8 bit)"),
    ("SG_ force_x : 32|32@1- (1,0) [-4096|4096]", "SG_ force_x : 32|32@1- (1,0) [0|0]", "WRENCH.force_x: a float signal needs a range"),
    ("BO_ 264 JOINT_STATE_8: 16", "BO_ 264 JOINT_STATE_8: 24", "JOINT_STATE: its numbered frames must have the same size and signals"),
])
def test_dbc_that_the_code_could_not_serve_is_refused(tmp_path, dbc, old, new, complaint):
    text = dbc.read_text()
    assert old in text
    broken = tmp_path / "broken.dbc"
    broken.write_text(text.replace(old, new))
    result = generate(broken, tmp_path / "out.h")
    assert result.returncode == 1
    assert complaint in result.stderr and result.stderr.count("\n") == 1
    assert not (tmp_path / "out.h").exists()
