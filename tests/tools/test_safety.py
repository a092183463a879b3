"""safety/*.toml: every requirement has rows that were executed, no dangerous cell is left without a reason, and the page is theirs."""

import json
import subprocess

import pytest

from reed_tools import cli
from reed_tools.errors import UsageError
from reed_tools.faults import accepted, catalogue, cell, command, requirements, safety_page
from reed_tools.faults.cell import Cell
from reed_tools.faults.requirements import Shown
from reed_tools.paths import ROOT

HAZARDS, REQUIREMENTS = requirements.load()
KEPT = requirements.kept()


def test_every_fault_of_every_requirement_was_executed():
    assert requirements.unproven(REQUIREMENTS, KEPT) == []
    assert requirements.unproven(REQUIREMENTS, [shown for shown in KEPT if shown.fault != "state_loss"]) == ["SR-21: state_loss"]


def test_every_fault_of_the_catalogue_has_rows_and_a_requirement():
    known = {entry["id"] for entry in catalogue.load(catalogue.STANDARD)}
    assert {shown.fault for shown in KEPT} == known
    assert {fault for one in REQUIREMENTS for fault in one.faults} == known


def test_no_dangerous_cell_is_undetected_without_a_reason():
    allowed = accepted.load()
    assert requirements.unaccepted(KEPT, allowed) == []
    planted = Shown("state_loss", "press_known", "free", 1, "dangerous undetected", None, None, None, None, None, "force", "force", "")
    assert requirements.unaccepted([*KEPT, planted], allowed) == [planted]


def test_what_is_accepted_is_dangerous():
    """A reason that nothing needs any more goes."""
    dangerous = [shown for shown in KEPT if shown.worst == "dangerous undetected" or shown.hazard]
    idle = [one.fault for one in accepted.load() if not any(one.fault == shown.fault and (not one.phases or shown.phase in one.phases) for shown in dangerous)]
    assert idle == []


def test_the_evidence_named_is_there():
    for one in REQUIREMENTS:
        for name in one.evidence:
            path, _, test = name.partition("::")
            assert (ROOT / path).is_file() and test in (ROOT / path).read_text(), f"{one.id}: {name}"


def test_detection_is_as_soon_as_the_requirement_says():
    """While the arm is driven, before that there is nothing to stop, and while a sensor that fails is listened to. What is only counted
    has no time."""
    for one in REQUIREMENTS:
        for shown in KEPT:
            if shown.fault not in one.faults or shown.fdti_ms is None or shown.phase == "idle":
                continue
            if shown.phase == "switch" and shown.fault.startswith("wrench"):
                continue
            if one.within_ms is not None:
                assert shown.fdti_ms <= one.within_ms, (one.id, shown)
            elif shown.worst == "dangerous detected" and shown.ftti_ms is not None:
                assert shown.fdti_ms <= shown.ftti_ms, (one.id, shown)


# ms of 1 ms cycles: the age limits of press_known (hold 2, stop 10), rows of the monitors, and what a device reports at once.
CLOSED_FORM = {"state_loss": 2, "state_corruption": 2, "state_length": 2, "state_repetition": 3, "wrench_loss": 2 * 10, "wrench_silent": 2 * 10,
               "wrench_stuck": 100, "drive_trips": 0, "second_controller": 0, "bus_insertion": 0, "command_loss": 2 * 10 + 1,
               "command_masquerade": 15 + 1, "command_corruption_right_crc": 15 + 1}


@pytest.mark.parametrize("fault", CLOSED_FORM)
def test_the_detection_time_is_its_closed_form(fault):
    rows = [shown for shown in KEPT if (shown.fault, shown.scenario) == (fault, "press_known") and shown.phase != "idle"]
    assert {shown.phase for shown in rows} >= {"free", "contact", "pressing"}
    assert {shown.fdti_ms for shown in rows} == {CLOSED_FORM[fault]}


def test_the_page_is_the_makers():
    assert safety_page.PAGE.read_text() == safety_page.page(), "run docs/make_safety.py"


@pytest.mark.parametrize("kept", KEPT[::97], ids=lambda kept: f"{kept.fault}-{kept.scenario}-{kept.phase}")
def test_a_kept_row_is_what_the_programs_do_now(kept):
    """A few of them here, to the bit; all of them in the long mode."""
    entries = catalogue.load(catalogue.STANDARD)
    number = [entry["id"] for entry in entries].index(kept.fault)
    row = cell.run(entries, command.UNMONITORED, Cell(kept.scenario, number, kept.phase, 1), [])
    assert requirements.summarised([row.as_dict()]) == [kept]


@pytest.mark.long
def test_the_kept_matrix_is_what_the_programs_do_now(tmp_path):
    done = subprocess.run([ROOT / "tools" / "reed", "faults", "--json", "--out", tmp_path / "matrix"], capture_output=True, text=True, timeout=7200)
    assert done.returncode == 0, done.stderr
    assert requirements.summarised(json.loads(done.stdout)["rows"]) == KEPT


def test_a_requirement_with_a_missing_fault_is_refused(tmp_path):
    path = tmp_path / "one.toml"
    entry = {"id": "S", "action": "provided", "unsafe": "u", "shall": "s", "within_ms": 1, "faults": ["state_lost"], "evidence": []}
    with pytest.raises(UsageError, match="the fault 'state_lost' is not in"):
        requirements.one(path, "H", entry, {"state_loss"})
    for wrong, said in (({"action": "sometimes"}, "action 'sometimes'"), ({"within_ms": 0}, "within_ms above 0"), ({"within_ms": "1"}, "within_ms above 0"),
                        ({"before_hazard": True}, "one of within_ms and before_hazard"), ({"shal": "s"}, "expected the keys"),
                        ({"faults": "state_lost"}, "faults: expected a list"), ({"faults": []}, "no fault tests it")):
        with pytest.raises(UsageError, match=said):
            requirements.one(path, "H", {**entry, **wrong}, {"state_lost"})


def test_the_command_refuses_a_requirement_with_a_missing_fault_before_anything_runs(tmp_path, monkeypatch, capsys):
    (tmp_path / "one.toml").write_text((ROOT / "safety" / "contact.toml").read_text().replace('"wrench_silent"', '"wrench_mute"'))
    monkeypatch.setattr(requirements, "load", lambda folder=tmp_path, load=requirements.load: load(folder))
    assert cli.main(["faults", "--out", str(tmp_path / "out")]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "requirement SR-11: the fault 'wrench_mute' is not in" in line and not (tmp_path / "out").exists()


def test_part_of_the_matrix_is_no_evidence(tmp_path, capsys):
    assert cli.main(["faults", "--keep", "--only", "state_loss", "--out", str(tmp_path / "out")]) == 2
    assert "--keep: evidence is the whole matrix" in capsys.readouterr().err
