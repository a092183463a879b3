"""report.html in headless Chromium: the arm that moves, the curves that are asked, and what is printed."""

import base64
import hashlib
import io
import json
import re

import chromium
import lockstep_run
import numpy as np
import own_address
import pytest
from PIL import Image

from reed_tools.figures import animation, curves
from reed_tools.figures.evaluate import evaluate
from reed_tools.paths import ROOT
from reed_tools.record import configuration, run_folder, signals, telemetry_log
from reed_tools.robots import arm_lines

BUS = own_address.bus()
LOCKED = ROOT / "tools" / "npm-packages.txt"
MOST_BYTES = 5e6  # of a page of three seconds


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = lockstep_run.record(tmp_path_factory.mktemp("run"), BUS, "press_known", "scenario.seed=77")
    summary, unwritten = evaluate(folder)
    assert unwritten is None and summary["verdict"] == "pass"
    return folder


@pytest.fixture(scope="module")
def recorded(folder):
    recording = telemetry_log.load(folder / run_folder.TELEMETRY)
    return recording, signals.join(recording), configuration.load(folder / run_folder.CONFIGURATION)


@pytest.fixture(scope="module")
def page(folder, tmp_path_factory):
    page = chromium.Page((folder / "report.html").as_uri(), tmp_path_factory.mktemp("profile"), width=1100, height=900)
    page.until("document.querySelectorAll('.curve .u-legend').length > 0")
    yield page
    page.close()


def near(picture, rgb, tolerance=12):
    """Share of the pixels that have this colour."""
    return float((np.abs(picture - np.array(rgb)).max(axis=2) <= tolerance).mean())


def seen(page, what):
    """Picture of one element."""
    page.value(f"document.querySelector('{what}').scrollIntoView(); 1")
    box = page.value(f"(r => [r.left, r.top, r.width, r.height])(document.querySelector('{what}').getBoundingClientRect())")
    left, top, width, height = (round(value) for value in box)
    return page.picture()[max(0, top):top + height, left:left + width]


def at(page, time_s):
    page.value(f"reed.clock.set({time_s}); 1")


def test_the_page_is_one_small_file_that_asks_for_nothing(folder, page):
    assert (folder / "report.html").stat().st_size < MOST_BYTES
    assert page.errors == []
    assert {url.partition(":")[0] for url in page.requests} == {"file", "data"} and sum(url.startswith("file:") for url in page.requests) == 1
    text = (folder / "report.html").read_text()
    assert "default-src 'none'" in text and not re.search(r"(src|href)=.?(https?:)?//", text)


def test_the_arm_the_wall_the_force_and_the_path_are_drawn(page):
    at(page, 2.5)
    drawn = seen(page, "#reed-arm canvas")
    for name, rgb, least in (("arm", arm_lines.ARM_RGB, 5e-3), ("force", arm_lines.FORCE_RGB, 2e-4), ("path", arm_lines.TRACE_RGB, 2e-5)):
        assert near(drawn, rgb) > least, name
    wall = np.array(arm_lines.WALL_RGB) * 0.35 + 251 * 0.65
    assert near(drawn, wall) > 0.02
    at(page, 0.1)
    assert near(seen(page, "#reed-arm canvas"), arm_lines.FORCE_RGB) == 0.0  # nothing touches yet


def test_the_arm_plays_bends_more_and_turns(page):
    still = [at(page, 1.0), seen(page, "#reed-arm canvas")][1]
    page.value("document.querySelector('.play').click(); 1")
    page.until("reed.clock.t > 1.2")
    page.value("document.querySelector('.play').click(); 1")
    stopped = page.value("reed.clock.t")
    assert page.value("reed.clock.t") == stopped
    at(page, 1.0)
    assert np.array_equal(seen(page, "#reed-arm canvas"), still)  # the same instant is the same picture
    ghost = near(still, (200, 200, 200), 16)
    set_scale = "s => { const e = document.querySelector('.scale'); e.value = s; e.dispatchEvent(new Event('input')); return 1; }"
    page.value(f"({set_scale})(100)")
    bent = seen(page, "#reed-arm canvas")
    assert page.value("document.querySelector('.factor').textContent") == "× 50"
    assert np.mean(np.any(bent != still, axis=2)) > 0.01 and near(bent, (200, 200, 200), 16) > 1.2 * ghost  # the desired arm comes out from behind
    page.value(f"({set_scale})(0)")
    middle = page.value("(r => [r.left + r.width / 2, r.top + r.height / 2])(document.querySelector('#reed-arm canvas').getBoundingClientRect())")
    for kind, dx in (("mousePressed", 0), ("mouseMoved", 120), ("mouseReleased", 120)):
        page.call("Input.dispatchMouseEvent", type=kind, x=middle[0] + dx, y=middle[1], button="left", buttons=1, clickCount=1)
    turned = seen(page, "#reed-arm canvas")
    assert np.mean(np.any(turned != still, axis=2)) > 0.02
    page.value("document.querySelector('.home').click(); 1")
    assert np.array_equal(seen(page, "#reed-arm canvas"), still)


def legend(page, title):
    """Names and values under the diagram of that title."""
    rows = page.value(f"""[...[...document.querySelectorAll('.curve')].find(c => c.querySelector('h3').textContent.startsWith({title!r}))
      .querySelectorAll('.u-series')].map(row => [row.querySelector('.u-label').textContent, row.querySelector('.u-value').textContent])""")
    return {name: float(value) for name, value in rows}


def test_values_are_those_that_were_recorded(page, recorded):
    _, joined, _ = recorded
    at(page, 0.75)
    page.until("document.querySelector('.curve .u-value').textContent.startsWith('0.75')")
    k = int(np.argmin(np.abs(joined.t - 0.75)))
    shown = legend(page, "Normal force")
    assert shown == pytest.approx({"t [s]": joined.t[k], "desired": joined.force_desired[k], "measured": joined.force_measured[k], "true": joined.force_true[k]}, rel=1e-4)
    joints = legend(page, "Joint error: planned")
    assert joints == pytest.approx({"t [s]": joined.t[k], **{f"joint {j + 1}": 1e3 * joined.joint_error[k, j] for j in range(5)}}, rel=1e-4, abs=1e-5)


def test_a_zoom_is_of_all_diagrams_and_a_click_shows_the_arm_at_that_time(page):
    count = page.value("reed.plots.length")
    assert count >= 8
    page.value("reed.plots[0].setScale('x', {min: 0.3, max: 0.6}); 1")
    page.until(f"reed.plots.every(plot => plot.scales.x.min === 0.3 && plot.scales.x.max === 0.6) && reed.plots.length === {count}")
    force = seen(page, "#reed-curves .curve")
    assert near(force, (0, 114, 178), 40) > 1e-4 and near(force, (213, 94, 0), 40) > 1e-4
    page.value("document.querySelector('#reed-curves .curve').scrollIntoView(); 1")
    x, y = page.value("(r => [r.left + r.width / 2, r.top + r.height / 2])(reed.plots[0].over.getBoundingClientRect())")
    for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
        page.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)
    page.until("Math.abs(reed.clock.t - 0.45) < 0.01")
    page.value("reed.plots[0].setScale('x', {min: 0, max: 3}); 1")
    assert page.errors == []


def test_print_has_the_still_pictures_and_nothing_that_moves(page):
    assert page.value("getComputedStyle(document.querySelector('.still')).display") == "none"
    page.call("Emulation.setEmulatedMedia", media="print")
    try:
        displayed = page.value("[...document.querySelectorAll('.still')].map(e => getComputedStyle(e).display)")
        assert displayed == ["block", "block"]
        assert page.value("[...document.querySelectorAll('.interactive, .hint')].every(e => getComputedStyle(e).display === 'none')")
        assert near(seen(page, ".still img"), arm_lines.ARM_RGB, 30) > 1e-3
    finally:
        page.call("Emulation.setEmulatedMedia", media="")
    paper = base64.b64decode(page.call("Page.printToPDF", printBackground=True)["data"])
    assert paper.startswith(b"%PDF") and paper.count(b"/Subtype /Image") >= 8


def test_the_page_says_how_to_repeat_the_run_and_links_its_records(folder):
    text = (folder / "report.html").read_text()
    for name in ("summary.json", run_folder.TELEMETRY, run_folder.CONFIGURATION):
        assert f'href="{name}"' in text and (folder / name).exists()


def test_the_numbers_inside_are_the_record(folder, recorded):
    recording, joined, effective = recorded
    inside = json.loads(re.search(r'id="reed-data">(.*?)</script>', (folder / "report.html").read_text(), re.S)[1])

    def array(entry):
        return np.frombuffer(base64.b64decode(entry["base64"]), "<f4").reshape(entry["shape"])

    shape = recording.tables["REED_SHAPE"]
    rows = (shape["cycle"] >= joined.cycle[0]) & (shape["cycle"] <= joined.cycle[-1])
    bent = array(inside["arm"]["rigid"]) + array(inside["arm"]["bend"])
    assert np.allclose(bent, np.stack([shape["x"], shape["y"], shape["z"]], axis=2)[rows], atol=1e-6)
    assert inside["curves"]["every"] == 1 and array(inside["curves"]["t"]).tolist() == joined.t.astype("<f4").tolist()


def test_a_long_run_is_thinned_and_says_so(recorded):
    recording, joined, effective = recorded
    longer = type(joined)(**{name: np.concatenate([value] * 3) if isinstance(value, np.ndarray) else value for name, value in vars(joined).items()})
    data = curves.data(longer, recording, effective, None, ["#000000"])
    assert data["every"] == 2 and data["t"]["shape"][0] <= curves.MOST_ROWS


def test_a_run_without_shape_or_without_an_active_arm_has_neither(recorded):
    recording, joined, effective = recorded
    assert animation.data(recording, None, effective) is None and curves.data(None, recording, effective, None, []) is None
    blind = type(recording)({**recording.tables, "REED_SHAPE": {"cycle": np.array([])}}, recording.singles, recording.channel_digests)
    assert animation.data(blind, joined, effective) is None


def test_names_do_not_end_the_script():
    from reed_tools.show import interactive

    assert "</script><b>" not in interactive.scripts({"curves": None, "arm": None, "name": "</script><b>"}).partition("</script>")[0]


def test_the_library_is_the_locked_one():
    """Of the package's files, byte by byte; the lock names their hashes and the package's own."""
    lines = [line.split() for line in LOCKED.read_text().splitlines() if line and not line.startswith("#")]
    assert len(lines) == 2
    for package, version, integrity, path, digest in lines:
        assert package == "uplot" and re.fullmatch(r"sha512-[\w+/]{86}==", integrity)
        file = ROOT / "tools" / "reed_tools" / "show" / "page" / path.rpartition("/")[2]
        assert hashlib.sha256(file.read_bytes()).hexdigest() == digest
    assert f"(v{version})".encode() in (ROOT / "tools" / "reed_tools" / "show" / "page" / "uPlot.iife.min.js").read_bytes()


def test_a_picture_is_what_it_says(folder):
    assert Image.open(io.BytesIO((folder / "arm.png").read_bytes())).width > 1000
