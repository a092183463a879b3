"""The live page in headless Chromium: fed by a recorded run that is published again in real time, and from a run folder."""

import socket
import subprocess
import time

import chromium
import lockstep_run
import numpy as np
import own_address
import pytest
import synthetic_run
from live_server import COMMAND, COUNT, LIVE, Player, Served, assert_drawn, best_rate_hz, free_port, number, text

from reed_tools.live import curves, known_run, running, words
from reed_tools.live.batch import Batch, after_restart, until, whole
from reed_tools.live.moment import Moment
from reed_tools.paths import PYTHON, ROOT, use_message_types
from reed_tools.record import telemetry_log
from reed_tools.record.merge import merge
from reed_tools.run import live_page

ENOUGH_hz = 30.0      # a stretch at this rate ends the first run early
ENOUGH_UPDATES = 30


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return lockstep_run.record(tmp_path_factory.mktemp("run"), own_address.bus(), "press_known", "scenario.duration_s=2.0", "scenario.seed=77")


@pytest.fixture(scope="module")
def recording(folder):
    return telemetry_log.load(folder / "telemetry.lcmlog")


def only_this_machine(page, port):
    for url in page.requests:
        assert url.startswith((f"http://127.0.0.1:{port}", f"ws://127.0.0.1:{port}", "data:", "blob:", "about:")), url


def test_the_page_follows_runs_as_they_come_and_go(folder, tmp_path):
    served, player = Served(), Player(folder)
    page = chromium.Page(served.url, tmp_path / "early")
    late = None
    try:
        assert served.listens_on() == {"0100007F"}
        text(page, "waiting for a run")
        page.value(COUNT)
        end = time.monotonic() + 30
        best_hz = [0.0]
        player.play(until=lambda: time.monotonic() > end or best_hz[-1] >= ENOUGH_hz)
        text(page, "press_known on a5")
        while player.thread.is_alive():
            time.sleep(0.5)
            best_hz.append(best_rate_hz(page))
        text(page, "the run has ended; waiting for the next one")
        assert_drawn(page, tmp_path / "ended.png")
        shown = number(page)
        player.play()  # the next run, on the same page
        text(page, "force known from the wrench")
        late = chromium.Page(served.url, tmp_path / "late")  # a second page, opened in the middle
        text(late, "press_known on a5")
        text(late, "the run has ended")
        assert_drawn(late, tmp_path / "late.png")
        assert number(page) > shown
        assert page.errors == late.errors == []
        only_this_machine(page, served.port)
        assert served.process.poll() is None
        assert shown > ENOUGH_UPDATES  # a count: the rate is that of a software rasteriser beside the other tests' load
    finally:
        if player.thread:
            player.end()
        for one in filter(None, (page, late)):
            one.close()
        served.stop()


def test_a_finished_run_has_a_time_slider(folder, tmp_path):
    served = Served(folder)
    page = chromium.Page(served.url, tmp_path / "profile")
    try:
        text(page, f"recorded: {folder.name}")
        text(page, "time [s]")
        page.value(COUNT)
        page.until("applied.length > 5")
        text(page, "contact made at")  # an event of the past
        assert_drawn(page, tmp_path / "recorded.png")
        assert page.errors == []
        only_this_machine(page, served.port)
    finally:
        page.close()
        served.stop()


def test_samples_are_the_recorded_values_at_every_seventeenth_cycle(recording):
    got = curves.rows(whole(recording), 1000.0, 6)
    control, plant, timing = (recording.tables[name] for name in ("REED_CONTROL", "REED_PLANT", "REED_TIMING"))
    cycles = [cycle for cycle in control["cycle"].tolist() if cycle % 17 == 0]
    assert len(got) == len(cycles) and got.shape[1] == 1 + 5 + 3 + 5 + 6 + 2 + 2
    for row, cycle in zip(got, cycles):
        k = control["cycle"].tolist().index(cycle)
        assert row[0] == control["utime"][k]
        assert row[1:6].tolist() == (1e3 * control["e"][k]).tolist()
        assert row[6:9].tolist() == [control["f_d"][k], control["f"][k], plant["normal_force"][plant["cycle"].tolist().index(cycle)]]
        assert row[9:14].tolist() == control["tau"][k].tolist()
    since = (timing["cycle"] > cycles[4]) & (timing["cycle"] <= cycles[5])
    assert got[5, -1] == timing["cycle_ns"][since].max() / 1e3


def test_batches_of_any_size_give_the_same_curves_as_the_whole(recording):
    history = curves.History(1e9)
    everything = curves.rows(whole(recording), 1000.0, 6)
    for start in range(0, 2200, 13):
        part = {channel: {name: values[(table["cycle"] >= start) & (table["cycle"] < start + 13)] for name, values in table.items()}
                for channel, table in recording.tables.items()}
        history.add(curves.rows(Batch({channel: table for channel, table in part.items() if len(table["cycle"])}), 1000.0, 6))
    assert np.array_equal(history.rows[:, :-2], everything[:, :-2])  # peaks of timing are cut at other places


def test_history_keeps_a_minute_and_gives_windows_in_seconds():
    history = curves.History()
    for second in range(200):
        history.add(np.array([[second * 1e6, float(second)]]))
    assert history.rows[0, 0] == 139e6 and len(history.rows) == 61
    assert history.window(5.0)[:, 0].tolist() == [194.0, 195.0, 196.0, 197.0, 198.0, 199.0]
    assert history.window(2.0, until_utime=150.5e6)[:, 1].tolist() == [148.0, 149.0, 150.0]


def test_a_value_that_did_not_come_is_the_one_before():
    history = curves.History()
    history.add(np.array([[0.0, curves.MISSING, 1.0]]))
    history.add(np.array([[1.0, 5.0, curves.MISSING], [2.0, curves.MISSING, 3.0]]))
    assert np.array_equal(history.rows, [[0.0, np.nan, 1.0], [1.0, 5.0, 1.0], [2.0, 5.0, 3.0]], equal_nan=True)


def test_rows_of_the_run_before_are_cut_off():
    table = {"cycle": np.array([8, 9, 0, 1]), "tau": np.array([[1.0], [2.0], [3.0], [4.0]])}
    assert after_restart(table)["tau"].tolist() == [[3.0], [4.0]]


def test_a_moment_is_what_was_true_then(recording):
    moment = Moment()
    moment.update(until(recording, 1_000_000))
    control, shape = recording.tables["REED_CONTROL"], recording.tables["REED_SHAPE"]
    assert moment.cycle == 1000 and moment.mode == 2 and moment.theta_d.tolist() == control["theta_d"][1000].tolist()
    row = int(np.flatnonzero(shape["cycle"] <= 1000)[-1])
    assert moment.bent[-1].tolist() == [shape["x"][row, -1], shape["y"][row, -1], shape["z"][row, -1]]
    assert all(event.utime <= 1_000_000 for event in moment.events) and moment.events


def test_words_name_limits_bus_faults_and_the_state():
    assert words.limits_at_work(0) == "none" and words.limits_at_work(0b1001) == "torque, an old measurement is held"
    use_message_types()
    import reed

    bus = reed.bus_t()
    bus.frames_rx, bus.frames_tx = 60, 20
    assert words.bus_health(bus) == "healthy (60 frames received, 20 sent)"
    bus.lost, bus.crc_errors = 3, 1
    assert words.bus_health(bus).startswith("3 lost, 1 damaged (")
    moment = Moment()
    assert words.headline(moment, 0.0) == "waiting for a run"
    moment.cycle, moment.mode = 5, 2
    assert words.headline(moment, 0.0) == "running, active" and "nothing heard for 9 s" in words.headline(moment, 9.0)
    event = reed.event_t()
    event.text = "a <b>bold</b> event"
    moment.events = [event]
    changed = reed.event_t()
    changed.text, changed.code, changed.mode, changed.joint, changed.cycle = "mode changed", 1, 2, -1, 66
    tripped = reed.event_t()
    tripped.text, tripped.code, tripped.joint, tripped.cycle = "joint speed above its limit, rad/s", 33, 1, 70
    assert words.event_line(changed) == "<div>cycle 66: mode changed: active</div>"
    assert words.event_line(tripped).endswith("cycle 70: joint speed above its limit, rad/s, joint 2</div>")
    assert "<b>" not in words.page_text(moment, "") and "&lt;b&gt;bold" in words.page_text(moment, "")


class SeenPage:
    """Notes what Running asks of a page."""

    def __init__(self):
        self.known, self.shown, self.forgotten = [], [], 0
        self.pause = type("Box", (), {"value": False})()

    def know(self, dof, parameters, effective):
        self.known.append((dof, parameters, effective and effective["arm"]["name"]))

    def show(self, moment):
        self.shown.append((moment.cycle, moment.dof))

    def forget_trace(self):
        self.forgotten += 1


class Fed(running.Running):
    """Fed with logs instead of the network: what the feed would keep is put there directly."""

    def __init__(self, monkeypatch):
        monkeypatch.setenv("LCM_DEFAULT_URL", "memq://")
        super().__init__()

    def hear(self, page, events):
        for _, channel, data in events:
            self.feed.keep(channel, data)
        self.tick(page, time.monotonic())


def test_a_run_of_another_arm_takes_the_page_over(folder, tmp_path, monkeypatch):
    monkeypatch.setattr(known_run, "CURRENT_RUN", tmp_path / "current-run")
    (tmp_path / "current-run").write_text(f"{folder}\n")
    first = list(telemetry_log.events(folder / "telemetry.lcmlog"))
    synthetic = synthetic_run.write(tmp_path / "two", [], duration_s=0.3)  # two joints, a scenario that no file has
    merge([synthetic / "firmware.lcmlog", synthetic / "plant.lcmlog"], synthetic / "telemetry.lcmlog")
    second = list(telemetry_log.events(synthetic / "telemetry.lcmlog"))
    live, page = Fed(monkeypatch), SeenPage()
    live.hear(page, first[:4000])
    live.hear(page, first[4000:])
    assert page.known == [(5, 6, "a5")] and page.shown[-1][1] == 5 and live.moment.run.finished
    live.hear(page, second)
    assert page.known[1:] == [(2, 2, None)] and page.shown[-1] == (399, 2) and live.history.rows.shape[1] == 1 + 2 + 3 + 2 + 2 + 2 + 2
    (tmp_path / "current-run").write_text(f"{synthetic}\n")
    live.hear(page, second + first[:3000])  # a run's end and the next one's start between two looks
    assert page.known[2:] == [(5, 6, "a5")] and page.shown[-1][1] == 5
    page.pause.value, count = True, len(page.shown)
    live.hear(page, first[3000:6000])
    assert len(page.shown) == count and live.moment.cycle == max(telemetry_cycle(first[:6000]))


def telemetry_cycle(events):
    return [telemetry_log.HEAD.unpack_from(data)[1] for _, channel, data in events if channel == "REED_CONTROL"]


REPLACED = """
from reed_tools.live import page
sent = []
shown = page.Page("127.0.0.1", int(sys.argv[1]))
queue = shown.server._websock_server.queue_message
shown.server._websock_server.queue_message = lambda message: (sent.append(type(message).__name__), queue(message))[1]
counts = []
for dof in (5, 2, 5, 2):
    shown.know(dof, 6, None)
    counts.append(len([handle for diagrams in shown.all_diagrams.values() for handle in diagrams.handles if handle.visible]))
print("GuiRemoveMessage" in sent, "GuiUplotMessage" in sent, sent.count("GuiUplotMessage"), counts)
"""


def test_what_a_run_replaces_is_hidden_and_not_removed():
    """A page applies updates after the removals that came with them: an update to what is gone is an error there."""
    prelude = f"import sys; sys.path.insert(0, {str(ROOT / 'tools')!r})\n"
    done = subprocess.run([LIVE[0], *PYTHON[1:], "-c", prelude + REPLACED, str(free_port())], capture_output=True, text=True, timeout=60)
    assert done.stdout.splitlines()[:1] == ["False True 12 [6, 6, 6, 6]"], done.stdout + done.stderr


def test_bad_input_is_one_line():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        for argv, status, told in (([*LIVE, "--port", port], 2, "another page"), ([*LIVE, "--port", 0], 2, "65535"),
                                   ([*LIVE, "/nowhere"], 2, "effective.toml"), ([*PYTHON, *COMMAND], 3, "tools/requirements-live.txt")):
            done = subprocess.run([str(word) for word in argv], capture_output=True, text=True, timeout=60)
            assert done.returncode == status and told in done.stderr and len(done.stderr.splitlines()) == 1, done.stderr


def test_a_page_that_is_there_is_used_and_left_alone(monkeypatch):
    with socket.socket() as page:
        page.bind(("127.0.0.1", 0))
        page.listen()
        monkeypatch.setattr(live_page, "PORT", page.getsockname()[1])
        monkeypatch.setattr(live_page, "start", lambda: pytest.fail("a second page was started"))
        with live_page.beside():
            pass
