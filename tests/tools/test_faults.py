"""Faults to order: what is refused, what is said of one that did not happen, and what the matrix measures."""

import json
import subprocess
import xml.etree.ElementTree as xml

import pytest

from reed_tools.errors import UsageError
from reed_tools.faults import accepted, catalogue, cell, junit, page, phases, results
from reed_tools.faults.cell import Cell, Row
from reed_tools.figures import faults as injected
from reed_tools.paths import ROOT, program

STANDARD = catalogue.load(catalogue.STANDARD)
PERIOD_MS = 1.0


def number(name: str) -> int:
    return [entry["id"] for entry in STANDARD].index(name)


def row_of(name: str, phase: str = "pressing") -> Row:
    return cell.run(STANDARD, (), Cell("press_known", number(name), phase, 1), [])


def refused(text: str) -> str:
    done = subprocess.run([program("reed_config"), "--config", "press_known", "--set", f"fault={text}"], capture_output=True, text=True, timeout=60)
    assert done.returncode in (0, 2)
    assert len(done.stderr.splitlines()) == (done.returncode == 2)
    return done.stderr


def test_the_table_of_kinds_is_what_the_program_prints():
    printed = subprocess.run([program("reed_config"), "--fault-kinds"], capture_output=True, text=True, check=True, timeout=60).stdout
    assert printed in (ROOT / "docs" / "faults.md").read_text()
    kinds = {line.split("|")[1].strip() for line in printed.splitlines()[2:]}
    assert len(kinds) >= 40
    assert {entry["kind"] for entry in STANDARD} == kinds, "the catalogue has every kind"


def test_a_fault_that_nothing_would_apply_is_one_line_with_its_place():
    assert "fault[0].kind: 'stuk' is unknown; allowed: offset" in refused('[{id="a",target="joint1.encoder",kind="stuk",from_s=0.1}]')
    assert "fault[0].target: 'joint9.encoder'" in refused('[{id="a",target="joint9.encoder",kind="stuck",from_s=0.1}]')
    assert "fault[0].from_s: nothing starts it" in refused('[{id="a",target="joint1.encoder",kind="stuck"}]')
    assert "fault[0].sise: unknown key" in refused('[{id="a",target="joint1.encoder",kind="offset",sise=1.0,from_s=0.1}]')
    assert "contradicts the fault 'a'" in refused('[{id="a",target="joint1.brake",kind="brake_stuck_open",from_s=0.1},'
                                                  '{id="b",target="joint1.brake",kind="brake_stuck_closed",from_s=0.1}]')
    assert refused('[{id="a",target="joint1.encoder",kind="stuck",from_s=0.1}]') == ""


def test_every_fault_of_the_catalogue_is_accepted_by_the_reader():
    everything = catalogue.as_override([{**entry, "from_s": 0.1 * k + 0.01, "duration_s": 0.05} for k, entry in enumerate(STANDARD)][:28])
    assert refused(everything.removeprefix("fault=")) == ""


def test_a_catalogue_with_a_trigger_or_a_name_twice_is_refused(tmp_path):
    path = tmp_path / "faults.toml"
    path.write_text('[[fault]]\nid = "a"\ntarget = "bus"\nkind = "loss"\nfrom_s = 1.0\n')
    with pytest.raises(UsageError, match=r"fault\[0\].from_s: the phase starts it"):
        catalogue.load(path)
    path.write_text('[[fault]]\nid = "a"\ntarget = "bus"\nkind = "loss"\n' * 2)
    with pytest.raises(UsageError, match="is there twice"):
        catalogue.load(path)
    with pytest.raises(UsageError, match="did you mean `encoder_stuck`"):
        catalogue.chosen(STANDARD, ["encoder_stuk"])


def test_the_phases_are_those_that_the_fault_free_run_has():
    assert list(phases.triggers(phases.Course(0.5, 3.0, False))) == ["idle", "free", "approach", "contact", "pressing"]
    assert list(phases.triggers(phases.Course(None, 3.0, False))) == ["idle", "free"]
    assert list(phases.triggers(phases.Course(0.5, 1.0, True))) == ["idle", "free", "approach", "contact", "switch"]


@pytest.mark.parametrize("name", ["state_loss", "state_corruption", "state_length", "state_addressing", "encoder_not_a_number"])
def test_the_detection_time_of_lost_frames_is_the_age_limit_times_the_period(name):
    """limits.hold_age_cycles is 2: the third frame missing in a row is noticed, two periods after the first. The stop follows at twice
    limits.stop_age_cycles = 10, and the brakes close within 3 cycles."""
    row = row_of(name)
    assert (row.detected_by, row.fdti_ms) == ("held_measurement", 2 * PERIOD_MS)
    assert 20 * PERIOD_MS <= row.fhti_ms <= 23 * PERIOD_MS
    assert row.verdict == "safe detected"


def test_the_stop_for_an_old_wrench_comes_at_twice_its_age_limit():
    row = row_of("wrench_silent")
    assert (row.detected_by, row.fdti_ms) == ("stale_wrench", 20 * PERIOD_MS)


def test_an_arm_that_a_fault_keeps_from_starting_is_no_program_that_died():
    row = row_of("drive_trips", "idle")
    assert row.executed and row.verdict.startswith("safe") and row.hazard is None


def test_a_cell_repeats_by_its_line_and_is_the_same_twice():
    row = row_of("drive_noise")
    assert row.digest == row_of("drive_noise").digest
    assert row.command.startswith("tools/reed run press_known --bus memory --seed 1 --set 'fault=[{id=\"drive_noise\"")


def test_a_fault_that_did_not_begin_fails_the_run():
    done = [{"id": "a", "target": "bus", "kind": "loss", "from_s": 0.1, "to_s": None, "executed": True}]
    assert injected.checks([]) == []
    assert injected.checks(done)[0]["ok"]
    (line,) = injected.checks([*done, {**done[0], "id": "b", "executed": False}])
    assert not line["ok"] and line["value"] == 1 and line["why"] == "not executed, what starts it never came: b"


def test_the_result_counts_classes_and_names_what_fails(tmp_path):
    rows = [Row("a", "stuck", "s", "free", 1, verdict="dangerous undetected", hazard="force", command="tools/reed run s"),
            Row("b", "stuck", "s", "free", 1, verdict="dangerous detected", detected_by="x", fdti_ms=1.0, hazard="path"),
            Row("c", "stuck", "s", "free", 1, verdict="safe undetected"),
            Row("d", "stuck", "s", "free", 1)]
    result = results.build(rows, [], 1, [], {"scenarios": ["s"]})
    assert result["diagnostic_coverage"] == 0.5 and result["verdict"] == "fail"
    assert [row["fault"] for row in result["rows"]][:2] == ["d", "a"]
    assert {row["fault"]: row["failure"] for row in result["rows"]} == \
        {"d": "not executed", "a": "dangerous and undetected: force", "b": "detected, and yet dangerous: path", "c": None}
    assert result["not_executed"] == [{"fault": "d", "phase": "free", "scenario": "s", "seed": 1}]
    allowed = [accepted.Accepted("a", ("free",), "why"), accepted.Accepted("b", (), "why")]
    assert results.build(rows[:3], [], 1, allowed, {})["verdict"] == "pass"
    assert results.build(rows[2:3], [{"by": "collision"}], 1, [], {})["verdict"] == "fail", "a false alarm"
    json.loads(results.write(tmp_path, result).read_text())
    suite = xml.parse(junit.write(tmp_path, result)).getroot()
    assert (suite.get("tests"), suite.get("failures")) == ("5", "3")
    text = page.write(tmp_path, result, "tools/reed faults s").read_text()
    assert text.index("dangerous and undetected") < text.rindex("safe undetected</td>") and "50.0 %" in text
