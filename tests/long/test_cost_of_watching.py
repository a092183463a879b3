"""What the page and the recording cost the loop: short runs with all of it, with the log of timing alone, and with nothing, in turns."""

import os
import re
import signal
import subprocess
import time

import chromium
import numpy as np
import own_address
import pytest
from live_server import URL, Served, text

from reed_tools.paths import build, program
from reed_tools.record import telemetry_log

pytestmark = pytest.mark.long
BLOCKS = int(os.environ.get("REED_LONG_BLOCKS", "20"))
SCENARIO = ["--config", "press_known", "--set", "scenario.duration_s=1.5", "--set", "timing.max_missed_in_row=1000"]
CYCLES = 1500
MOST = 1.25  # between medians of turns; the machine's own noise is printed beside


def one_run(folder, watched: str) -> tuple[float, float, float]:
    """Missed cycles, wake-up p99 in µs (0 without a record), switches away from the loop."""
    bus = ["--bus", own_address.bus(), "--clock", "realtime"]
    records = {"nothing": ["--no-lcm"], "log": ["--no-lcm", "--log", str(folder / "firmware.lcmlog")],
               "all": ["--log", str(folder / "firmware.lcmlog"), "--tape", str(folder / "tape.reed"), "--candump", str(folder / "bus.candump")]}
    plant = subprocess.Popen([str(program("reed_plant_sim")), *SCENARIO, *bus, *([] if watched == "all" else ["--no-lcm"])],
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env={**os.environ, "LCM_DEFAULT_URL": URL})
    try:
        while b"waiting for SYNC" not in plant.stdout.readline():
            assert plant.poll() is None
        done = subprocess.run([str(program("reed_firmware")), *SCENARIO, *bus, *records[watched], "--enable"], capture_output=True, text=True,
                              env={**os.environ, "LCM_DEFAULT_URL": URL})
    finally:
        plant.send_signal(signal.SIGINT)
        plant.communicate(timeout=30)
    said = re.search(r"done: (\d+) cycles, (\d+) missed.* (\d+) involuntary", done.stdout)
    assert said and int(said[1]) > CYCLES, done.stdout + done.stderr
    wake_us = 0.0
    if watched != "nothing":
        wake_us = np.percentile(telemetry_log.load(folder / "firmware.lcmlog").tables["REED_TIMING"]["wake_ns"], 99) / 1e3
    for path in folder.iterdir():
        path.unlink()
    return float(said[2]), float(wake_us), float(said[3])


def test_page_and_recording_cost_the_loop_nothing(tmp_path):
    build("reed_firmware", "reed_plant_sim", "reed_lcmtypes_generate")
    served = Served()
    page = chromium.Page(served.url, tmp_path / "profile", 800, 600)
    folder = tmp_path / "run"
    folder.mkdir()
    found = {"nothing": [], "log": [], "all": []}
    try:
        text(page, "waiting for a run", 180)
        for block in range(BLOCKS):
            for watched in list(found)[:: 1 if block % 2 else -1]:
                found[watched].append(one_run(folder, watched))
                time.sleep(0.2)
        assert page.errors == []
    finally:
        page.close()
        served.stop()
    print("\n           missed, median (quartiles)   wake-up p99, µs   switches")
    for watched, runs in found.items():
        low, middle, high = np.percentile(np.array(runs), (25, 50, 75), axis=0)
        print(f"{watched:<9}" + "".join(f"  {m:8.1f} ({a:.1f} .. {b:.1f})" for a, m, b in zip(low, middle, high)))
    missed, wake_us, _ = (dict(zip(found, column)) for column in zip(*(np.median(np.array(runs), axis=0) for runs in found.values())))
    assert missed["all"] <= MOST * missed["nothing"] + 2 and wake_us["all"] <= MOST * wake_us["log"]
