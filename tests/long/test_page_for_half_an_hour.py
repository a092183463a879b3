"""The live page beside runs that come and go for half an hour: neither its server nor the page in the browser grows."""

import os
import time

import chromium
import lockstep_run
import numpy as np
import own_address
import pytest
from live_server import Player, Served, assert_drawn, text

pytestmark = pytest.mark.long
MINUTES = int(os.environ.get("REED_LONG_MINUTES", "30"))
WARM = 1 / 3          # of the time: caches, the window of the curves and the browser's heap fill
GROWTH = 1.05         # of the largest before to the largest after
EVERY_s = 30.0


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return lockstep_run.record(tmp_path_factory.mktemp("run"), own_address.bus(), "press_known", "scenario.duration_s=20", "scenario.seed=77")


def resident_MB(pid: int) -> float:
    with open(f"/proc/{pid}/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def children(pid: int) -> list[int]:
    with open(f"/proc/{pid}/task/{pid}/children") as file:
        own = [int(word) for word in file.read().split()]
    return [*own, *(grandchild for child in own for grandchild in children(child))]


def renderer_MB(page: chromium.Page) -> float:
    """The largest process of the browser whose command line says that it draws pages."""
    drawing = [pid for pid in children(page.process.pid) if b"--type=renderer" in open(f"/proc/{pid}/cmdline", "rb").read()]
    return max(map(resident_MB, drawing))


def sample(page: chromium.Page, served: Served) -> list[float]:
    page.call("HeapProfiler.collectGarbage")
    measured = {one["name"]: one["value"] for one in page.call("Performance.getMetrics")["metrics"]}
    updates = float(page.value("document.getElementById('reed-updates').textContent.split(' ')[1]"))
    return [resident_MB(served.process.pid), renderer_MB(page), measured["JSHeapUsedSize"] / 1e6, measured["Nodes"], updates]


def test_nothing_grows(folder, tmp_path):
    end = time.monotonic() + 60 * MINUTES
    served, player = Served(), Player(folder)
    page = chromium.Page(served.url, tmp_path / "profile", 800, 600)
    samples = []
    try:
        page.call("Performance.enable")
        player.play(until=lambda: time.monotonic() > end)
        text(page, "press_known on a5", 180)
        print("\n minutes  server MB  renderer MB  heap MB  nodes  updates")
        started = time.monotonic()
        while time.monotonic() < end:
            page.value("0")  # takes in what the page has logged
            time.sleep(EVERY_s)
            samples.append(sample(page, served))
            print("%8.1f %10.1f %12.1f %8.2f %6.0f %8.0f" % ((time.monotonic() - started) / 60, *samples[-1]), flush=True)
        page.call("Emulation.setDeviceMetricsOverride", width=1200, height=800, deviceScaleFactor=1, mobile=False)
        assert_drawn(page, tmp_path / "after.png")
        assert page.errors == []
    finally:
        player.end()
        page.close()
        served.stop()
    taken = np.array(samples)
    warm = int(len(taken) * WARM)
    half = (len(taken) + warm) // 2
    grown = []
    for name, column in zip(("server MB", "renderer MB", "heap MB", "nodes"), taken.T):
        before, after = column[warm:half].max(), column[half:].max()
        print(f"{name}: {before:.2f}, then {after:.2f}")
        grown += [name] if after > GROWTH * before else []
    assert not grown
    assert taken[-1, -1] > 60 * MINUTES, "updates were applied all the time"
