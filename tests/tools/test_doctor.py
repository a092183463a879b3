"""tools/reed doctor on machines that lack what it looks for: it diagnoses, and does not die."""

import errno
from types import SimpleNamespace

import pytest

from reed_tools.machine import doctor
from reed_tools.paths import ROOT


class Machine(type(doctor.Path())):
    """Paths below a folder that stands for /."""

    root = ""

    def __new__(cls, *parts):
        path = doctor.PosixPath(*parts)
        below = path.is_absolute() and not str(path).startswith((cls.root, str(ROOT)))
        return super().__new__(cls, cls.root + str(path) if below else path)


@pytest.fixture
def machine(tmp_path, monkeypatch):
    monkeypatch.setattr(Machine, "root", str(tmp_path))
    monkeypatch.setattr(doctor, "PosixPath", doctor.Path, raising=False)
    monkeypatch.setattr(doctor, "Path", Machine)
    return tmp_path


def kernel_file(machine, name, content):
    path = machine / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def test_a_machine_without_sys_and_proc_gets_its_whole_table(machine, capsys):
    assert doctor.run(SimpleNamespace(json=False)) == 0
    told = capsys.readouterr().out
    assert "cannot be found out" not in told and "this kernel has none" in told
    assert all(finding().subject in told for finding in doctor.FINDINGS)


def test_a_file_among_the_interfaces_and_one_without_a_type_are_passed_over(machine):
    kernel_file(machine, "sys/class/net/bonding_masters", b"bond0\n")
    kernel_file(machine, "sys/class/net/can0/type", b"280\n")
    kernel_file(machine, "sys/class/net/vcan0/type", b"280\n")
    (machine / "sys/class/net/odd").mkdir()
    found = doctor.can_interfaces()
    assert found.good and found.detail == "can0"


def test_odd_bytes_of_the_kernel_are_shown_and_not_parsed(machine):
    kernel_file(machine, "proc/sys/kernel/sched_rt_runtime_us", b"\xff\n")
    kernel_file(machine, "sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", b"power\xffsave\n")
    assert not doctor.throttling().good and not doctor.governor().good


@pytest.mark.parametrize("error", [OSError(errno.EIO, "Input/output error"), ValueError("odd")])
def test_what_cannot_be_found_out_is_a_finding(monkeypatch, capsys, error):
    def broken_part():
        raise error

    monkeypatch.setattr(doctor, "FINDINGS", (broken_part, doctor.disk))
    assert doctor.run(SimpleNamespace(json=False)) == 0
    told = capsys.readouterr().out
    assert "broken part" in told and "cannot be found out" in told and "free disk" in told
