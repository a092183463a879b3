"""What is shown of a run while it goes on, and at its end."""

import struct

import own_address
import pytest

from reed_tools.record.log_tail import ACTIVE, LogTail
from reed_tools.record.signals import MODES
from reed_tools.run import progress


def control(cycle, t_s, mode):
    data = struct.pack(">8xqqdb", cycle * 1000, cycle, t_s, mode)
    return struct.pack(">IQqII", 0xEDA1DA01, cycle, cycle * 1000, 12, len(data)) + b"REED_CONTROL" + data


@pytest.fixture
def log(tmp_path):
    """Active to 2.999 s, then off for 300 cycles; another channel between them; the last record is cut."""
    other = struct.pack(">IQqII", 0xEDA1DA01, 0, 0, 9, 3000) + b"REED_ELSE" + bytes(3000)
    records = [control(cycle, cycle / 1000, ACTIVE) for cycle in range(3000)] + [control(3000 + k, 0.0, 0) for k in range(300)]
    path = tmp_path / "firmware.lcmlog"
    path.write_bytes(other.join(records) + control(3300, 0.0, 0)[:-1])
    return LogTail(path)


def test_the_end_of_a_run_is_read_behind_the_cycles_that_came_after_it(log):
    assert MODES[ACTIVE] == "active"
    assert log.control() == (3299, 0, 0.0)
    assert log.reached_s() == 2.999


def test_a_log_without_an_active_cycle_or_without_anything_reached_nothing(tmp_path):
    assert LogTail(tmp_path / "none").control() is None and LogTail(tmp_path / "none").reached_s() == 0.0
    (tmp_path / "log").write_bytes(control(0, 0.0, 0))
    assert LogTail(tmp_path / "log").reached_s() == 0.0


def test_the_last_line_of_a_run_is_where_it_ended(reed, tmp_path, capsys):
    done = reed("run", "--bus", own_address.bus(), "--out", tmp_path, "--clock", "lockstep", "--duration", "1")
    lines = [line.split() for line in done.stdout.splitlines() if " / 1.0 s " in line]
    assert lines[-1] == ["1.0", "/", "1.0", "s", "active"], done.stdout  # the stand-in never leaves it


def test_no_line_goes_back_in_time(capsys):
    update = progress.never_back(progress.lines(3.0))
    for mode, t_s in ((2, 1.7), (0, 0.0), (0, 2.999)):
        update(mode, t_s)
    assert capsys.readouterr().out.splitlines() == ["     1.7 / 3.0 s  active", "     1.7 / 3.0 s  off", "     3.0 / 3.0 s  off"]
