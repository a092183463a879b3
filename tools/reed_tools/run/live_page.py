"""The page beside a run (tools/reed live), a process of its own. One that is there already is used and left alone."""

import socket
import subprocess
import sys
import time
from contextlib import contextmanager

from reed_tools.errors import RunError
from reed_tools.paths import ROOT
from reed_tools.run.hil import die_with_parent, stop

HOST, PORT = "127.0.0.1", 8080
START_s = 30.0


def answers() -> bool:
    with socket.socket() as probe:
        return probe.connect_ex((HOST, PORT)) == 0


@contextmanager
def beside():
    """The page is there when this is entered. On a terminal it stays after the run until Ctrl-C; otherwise it ends with it."""
    process = None if answers() else start()
    print(f"page    http://{HOST}:{PORT}", flush=True)
    try:
        yield
        if process and sys.stdout.isatty():
            print("the page stays until Ctrl-C", flush=True)
            process.wait()
    except KeyboardInterrupt:
        print()
    finally:
        if process:
            stop(process)


def start() -> subprocess.Popen:
    process = subprocess.Popen([str(ROOT / "tools" / "reed"), "live", "--port", str(PORT)], stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True, preexec_fn=die_with_parent)
    end = time.monotonic() + START_s
    while not answers():
        if process.poll() is not None or time.monotonic() > end:
            stop(process)
            raise RunError(f"the page did not start: {(process.stderr.read().strip().splitlines() or ['it said nothing'])[-1]}")
        time.sleep(0.05)
    return process
