"""The tests do not depend on how they were started: under `nohup … &` SIGINT and SIGHUP are ignored, and programs inherit that."""

import signal
import subprocess
import sys

import pytest

from reed_tools.paths import ROOT

IGNORED = (signal.SIGINT, signal.SIGHUP, signal.SIGTERM)


@pytest.mark.parametrize("number", IGNORED)
def test_a_program_that_a_test_starts_ends_by_a_signal(number):
    process = subprocess.Popen(["sleep", "60"])
    process.send_signal(number)
    assert process.wait(20) == -number


A_SIGNAL_TO_THE_TESTS = f"""
import os
def test_a_signal_to_the_tests():
    for number in {[int(number) for number in IGNORED]}:
        os.kill(os.getpid(), number)
"""


def test_so_it_is_where_the_signals_are_ignored_and_the_tests_go_on(tmp_path):
    """Tests that were started with signals ignored, and get them."""
    (tmp_path / "test_signals.py").write_text(A_SIGNAL_TO_THE_TESTS)
    ignore = "import os, signal, sys\nfor number in map(int, sys.argv[1].split(',')): signal.signal(number, signal.SIG_IGN)\n" \
             "os.execv(sys.executable, [sys.executable, *sys.argv[2:]])"
    inner = [__file__ + "::" + test_a_program_that_a_test_starts_ends_by_a_signal.__name__, str(tmp_path / "test_signals.py")]
    done = subprocess.run([sys.executable, "-c", ignore, ",".join(str(int(number)) for number in IGNORED), "-m", "pytest", "-q",
                           "-p", "no:cacheprovider", "-c", ROOT / "tests" / "pytest.ini", *inner],
                          capture_output=True, text=True, timeout=120)
    assert done.returncode == 0 and "4 passed" in done.stdout, done.stdout + done.stderr
