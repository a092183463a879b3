"""The small VM itself: streams, statuses, limits, Ctrl-C, and that it leaves nothing behind."""

import os
import shutil
import signal
import subprocess
import time

import pytest

from reed_tools.run import vm


def inside(script, **options):
    return subprocess.run(vm.command(["bash", "-c", script], **options), capture_output=True, text=True, timeout=120)


def test_has_vcan0_for_can_fd_and_multicast_on_its_own_network():
    done = inside("cat /sys/class/net/vcan0/mtu /sys/class/net/vcan0/operstate; ip route get 239.74.163.2; ls /sys/class/net")
    mtu, state, route = done.stdout.split("\n")[:3]
    assert (mtu, state) == ("72", "unknown") and "dev lo" in route
    assert "eth0" not in done.stdout


def test_keeps_streams_status_directory_and_environment_apart(tmp_path, monkeypatch):
    monkeypatch.setenv("REED_ODD", "two words\n'quoted' $x")
    monkeypatch.chdir(tmp_path)
    done = inside('pwd; printf %s "$REED_ODD"; echo to-err >&2; echo from-inside > file; exit 7')
    assert (done.returncode, done.stderr) == (7, "to-err\n")
    assert done.stdout == f"{tmp_path}\ntwo words\n'quoted' $x"
    assert (tmp_path / "file").read_text() == "from-inside\n"


def test_passes_every_byte():
    done = inside("seq 1 100000")
    assert done.stdout == "".join(f"{k}\n" for k in range(1, 100001))


def test_time_limit_is_status_124_and_interrupt_reaches_the_command():
    assert inside("sleep 60", time_limit_s=2).returncode == 124
    process = subprocess.Popen(vm.command(["bash", "-c", "trap 'echo caught; exit 5' INT; echo up; while :; do sleep 0.1; done"]),
                               stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "up\n"
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=60)[0] == "caught\n"
    assert process.returncode == 5


@pytest.mark.parametrize("folder", ["two words", 'a "quoted" one', "/run/reed-test", "/dev/shm/reed-test"])
def test_works_wherever_temporary_files_and_the_checkout_are(tmp_path, folder):
    """The kernel's command line ends at blanks, and the guest has a /run and a /dev/shm of its own."""
    scratch = tmp_path / folder  # an absolute folder stays itself
    scratch.mkdir(parents=True)
    try:
        launcher = shutil.copytree(vm.VM.parent, tmp_path / "check out" / "vm") / "vm"
        done = subprocess.run([launcher, "--", "bash", "-c", 'printf %s "$TMPDIR"; exit 7'], env={**os.environ, "TMPDIR": str(scratch)},
                              capture_output=True, text=True, timeout=120)
        assert (done.returncode, done.stdout) == (7, str(scratch)), done.stderr
        assert list(scratch.iterdir()) == []
    finally:
        shutil.rmtree(scratch)


def test_works_with_a_temporary_folder_that_is_not_there():
    done = subprocess.run(vm.command(["true"]), env={**os.environ, "TMPDIR": "/no/such/folder"}, capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stderr) == (0, "")


def test_leaves_nothing_behind(tmp_path):
    environment = {**os.environ, "TMPDIR": str(tmp_path)}
    subprocess.run(vm.command(["true"]), env=environment, check=True, timeout=60)
    assert list(tmp_path.iterdir()) == []
    deadline = time.monotonic() + 30  # what was killed may take its time to go
    while (left := str(tmp_path) in subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True).stdout) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert not left
