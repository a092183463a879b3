"""A run that stops says why: in summary.json, on the page and on the terminal."""

import json
import re

import numpy as np
import pytest
import synthetic_run as synthetic
from synthetic_signals import run as still_run

from reed_tools.figures import command, events, marks, plots, result_table
from reed_tools.figures.parameter_units import unit_of
from reed_tools.paths import ROOT
from reed_tools.record import event_names
from reed_tools.show import drawing

TRIP = [("plant", 0.4, 206, -1, 0.5), ("firmware", 1.499, 33, 1, 6.25), ("firmware", 1.5, 34, -1, 60.5)]


def snake(name: str) -> str:
    return re.sub(r"(?<!^)(?=[A-Z])", "_", name.removeprefix("k")).lower()


def test_names_are_those_of_both_programs():
    (reasons,), (records,) = list(ROOT.glob("firmware/**/reason.h")), list(ROOT.glob("plant_sim/**/records.h"))
    found = {}
    for text in (reasons.read_text(), records.read_text().split("enum class PlantEvent")[1]):
        found |= {int(code): snake(name) for name, code in re.findall(r"\b(k[A-Z]\w+) = (\d+),", text.split("};")[0])}
    assert found == event_names.NAMES
    assert event_names.name_of(77) == "code_77"
    assert [code for code in found if event_names.stops_the_arm(code)] == sorted(range(32, 57), key=list(found).index)


@pytest.fixture
def tripped(tmp_path, monkeypatch):
    monkeypatch.setattr(plots, "draw_all", lambda *_: [])
    synthetic.write(tmp_path, [], fault_at_s=1.5, events=TRIP)
    (tmp_path / "run.json").write_text(json.dumps({"command": "tools/reed run synthetic --seed 7", "machine": {"cpu": "x", "cores": 2, "kernel": "6"},
                                                   "versions": {"reed": "0.1.0", "commit": "abc", "build": "def"}}))

    class Arguments:
        run_dir, json = tmp_path, False

    assert command.run(Arguments) == 1
    return tmp_path


def test_the_summary_has_the_first_trip_and_every_event(tripped):
    summary = json.loads((tripped / "summary.json").read_text())
    assert {key: summary["reason"][key] for key in ("code", "name", "joint", "value", "t_s")} == \
        {"code": 33, "name": "joint_speed", "joint": 1, "value": 6.25, "t_s": 1.499}
    assert [(event["t_s"], event["code"], event["name"], event["joint"], event["value"]) for event in summary["events"]] == \
        [(0.4, 206, "contact_made", None, 0.5), (1.499, 33, "joint_speed", 1, 6.25), (1.5, 34, "contact_force", None, 60.5)]
    assert summary["versions"] == {"reed": "0.1.0", "commit": "abc", "build": "def"}
    assert summary["command"] == "tools/reed run synthetic --seed 7"
    assert summary["machine"] == {"cpu": "x", "cores": 2, "kernel": "6"}
    assert summary["cause"] == "event 33 of joint 2: 6.25, at 1.499 s"
    assert {check["name"]: check["why"] for check in summary["checks"]}["faults"] == summary["cause"]


def test_the_page_has_it_in_its_head_and_in_its_table(tripped):
    page = (tripped / "report.html").read_text()
    assert '<span class="fail">FAIL</span></h1><p class="fail"><b>event 33 of joint 2: 6.25, at 1.499 s</b></p>' in page
    assert "<td>1.499</td><td class=text>controller</td><td>2</td><td>6.25</td><td class=text><b class=fail>event 33</b></td>" in page
    assert "<pre>tools/reed run synthetic --seed 7</pre>" in page and "commit abc" in page


def test_the_terminal_has_it_beside_the_verdict(tripped, capsys):
    result_table.show(json.loads((tripped / "summary.json").read_text()))
    assert "synthetic on two: FAIL   event 33 of joint 2: 6.25, at 1.499 s   digest" in capsys.readouterr().out


def test_a_damaged_origin_is_named(tripped):
    (tripped / "SHA256SUMS").unlink()
    (tripped / "run.json").write_text("{")

    class Arguments:
        run_dir, json = tripped, False

    with pytest.raises(Exception, match="run.json: Expecting property name"):
        command.run(Arguments)


@pytest.mark.parametrize("text, value, words", [
    ("contact force limit, N", 60.118, "contact force limit: 60.12 N, at 0.708 s"),
    ("joint speed limit, rad/s", 6.5, "joint speed limit: 6.5 rad/s, at 0.708 s"),
    ("a drive reports a fault or a closed brake, or was not ready or enabled in time; its state", 3.0,
     "a drive reports a fault or a closed brake, or was not ready or enabled in time; its state: 3, at 0.708 s"),
    ("the law's torque is not a finite number", None, "the law's torque is not a finite number, at 0.708 s"),
])
def test_reasons_read_as_sentences(text, value, words):
    assert events.in_words({"text": text, "joint": None, "value": value, "t_s": 0.708}) == words


def check(name, value, limit, ok, why=None):
    return {"name": name, "value": value, "limit": limit, "ok": ok, "why": why}


def test_a_failure_without_a_trip_has_a_cause_too():
    good, never = check("faults", 0, 0, True), check("impact_peak_N", None, 10.0, False, "contact was never made")
    assert events.cause(None, [good]) is None
    assert events.cause(None, [good, never]) == "impact_peak_N: contact was never made"
    large = check("joint_rms_mrad", 3.0, 1.0, False)
    assert events.cause(None, [large, check("tip_rms_mm", 2.0, 1.0, False)]) == "joint_rms_mrad 3, limit 1 (and 1 more)"
    assert events.cause(None, [large, never]) == "impact_peak_N: contact was never made (and 1 more)"
    short = check("missing_s", 1.0, 0, False, "the arm was active for 2 of 3 s")
    assert events.cause(None, [never, short]) == "missing_s: the arm was active for 2 of 3 s (and 1 more)"


def test_contact_is_marked_and_an_impact_is_one_contact():
    force = np.zeros(2000)
    force[300:320] = force[350:900] = force[1500:] = 5.0
    signals, _ = still_run("known", "separated", n=2000, force_true=force)
    assert [(round(t, 3), text) for t, text in marks.contacts(signals)] == [(0.3, "contact"), (0.899, "contact lost"), (1.5, "contact")]
    assert marks.contacts(still_run("known", "separated", n=10)[0]) == []


def test_joints_turn_round_where_their_reference_does():
    t = np.arange(2000) * 1e-3
    assert marks.reversals(np.cos(2 * np.pi * t)).tolist() == pytest.approx([250, 750, 1250, 1750], abs=3)
    assert len(marks.reversals(np.zeros(100))) == 0
    assert len(marks.reversals(np.where(t < 1.0, 1.0, 1e-4 * np.sin(900 * t)))) == 0, "noise at rest is no reversal"


def test_parameters_have_the_unit_of_what_they_add():
    arm = {"param_shapes": [{"param": "m", "body": 1, "mass": 1.0}, {"param": "I", "body": 1, "mass": 0.0}, {"param": "b", "viscous_weights": [1.0]}]}
    assert [unit_of(arm, name) for name in ("m", "I", "b")] == ["kg", "kg·m²", "N·m·s/rad"]


def test_a_band_holds_what_chatters_and_its_line_the_mean():
    figure, axis = drawing.plt.subplots()
    t = np.arange(1000) * 1e-3
    drawing.plot_with_band(axis, t, np.where(np.arange(1000) % 2, 5.0, -3.0), "black", "u")
    (line,), (band,) = axis.lines, axis.collections
    assert len(line.get_xdata()) == 100 and set(line.get_ydata()) == {1.0}
    edges = band.get_paths()[0].vertices[:, 1]
    assert (edges.min(), edges.max()) == (-3.0, 5.0)
    drawing.plt.close(figure)
