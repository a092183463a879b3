"""lcm-spy on the Java of this machine: channels with rates, decoded fields on a double click, a plot on a sparkline."""

import os
import subprocess
import threading
import time
from pathlib import Path

import lcm
import own_address
import pytest
import synthetic_run

from reed_tools.machine import spy
from reed_tools.paths import BUILD

URL = own_address.lcm_url()
CHANNELS = {"REED_MEASURED": "measured_t", "REED_CONTROL": "control_t", "REED_ADAPTATION": "adaptation_t",
            "REED_TIMING": "timing_t", "REED_PLANT": "plant_t"}


@pytest.fixture
def telemetry():
    """Publishes a synthetic run at about 200 cycles per second until the test ends."""
    done = threading.Event()

    def publish():
        bus = lcm.LCM(URL)
        for _, channel, message in synthetic_run.messages(1_000_000, "lockstep", None):
            if done.is_set():
                return
            bus.publish(channel, message.encode())
            if channel == "REED_PLANT":
                time.sleep(0.005)

    thread = threading.Thread(target=publish)
    thread.start()
    yield
    done.set()
    thread.join()


def test_shows_every_channel_with_rate_fields_and_plot(telemetry, tmp_path):
    assert spy.missing_packages() == []
    spy.build_types_jar()
    probe = Path(__file__).with_name("SpyProbe.java")
    subprocess.run(["javac", "-cp", spy.LCM_JAR, "-d", tmp_path, probe], check=True)
    command = spy.java_command(None)
    command[command.index("-cp") + 1] += f":{tmp_path}"
    command[-1] = "SpyProbe"
    picture = BUILD / "spy" / "spy.png"
    done = subprocess.run(["timeout", "-k", "5", "110", "xvfb-run", "-a", "-s", "-screen 0 1280x900x24", *command, "REED_CONTROL", "5", str(picture)],
                          env={**os.environ, "LCM_DEFAULT_URL": URL}, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    lines = [line.split("\t") for line in done.stdout.splitlines()]
    rows = {line[1]: line[2:] for line in lines if line[0] == "row"}
    for channel, kind in CHANNELS.items():
        type_name, count, rate_hz, *_, undecodable = rows[channel]
        assert (type_name, undecodable) == (kind, "0")
        assert int(count) > 10 and float(rate_hz) > 1
    frames = {line[1]: int(line[2]) for line in lines if line[0] == "frame"}
    assert frames["REED_CONTROL"] > 2000   # the window of decoded fields: text of some forty fields
    assert frames["cycle"] > 500           # the plot behind the sparkline
    assert picture.stat().st_size > 5000
