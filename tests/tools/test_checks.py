"""What a run may not pass with: truth that was not recorded, contact that was never made. Each failure says why."""

import pytest
import synthetic_run as synthetic
from synthetic_signals import run as still_run

from reed_tools.figures import checks, estimate_figures, summary
from reed_tools.figures.run_data import NoFigure, RunData
from reed_tools.record.telemetry_log import load

ASKED = [("force_rms_N_last_second", 1.0), ("tangential_joint_rms_mrad_last_second", 10.0)]


def judged(folder, asked=ASKED, **options):
    synthetic.write(folder, asked, **options)
    figures = summary.build(folder, load(folder / "firmware.lcmlog", folder / "plant.lcmlog"))[0]
    return figures["verdict"], {check["name"]: check for check in figures["checks"]}


def without(program, from_s, to_s):
    return lambda who, t: who == program and from_s <= t < to_s


def test_a_whole_run_passes(tmp_path):
    verdict, by_name = judged(tmp_path)
    assert verdict == "pass" and all(check["why"] is None for check in by_name.values())


@pytest.mark.parametrize("program, from_s, to_s, missing_s", [
    ("plant", 0.5, 9.0, 2.5),          # its log ends early
    ("plant", 0.2, 2.2, 2.0),          # its queue was full
    ("plant", 1.0, 1.001, 0.001),      # one record
    ("firmware", 1.0, 1.5, 0.5),       # the ring was full
])
def test_what_one_side_did_not_record_is_missing_time(tmp_path, program, from_s, to_s, missing_s):
    verdict, by_name = judged(tmp_path, lost=without(program, from_s, to_s))
    assert verdict == "fail"
    assert by_name["missing_s"]["value"] == pytest.approx(missing_s, abs=1e-9)
    who = {"plant": "plant", "firmware": "controller"}[program]
    count = round(1000 * missing_s)
    assert f"{count} cycle{'s lack' if count > 1 else ' lacks'} a record: the {who}'s log has fewer cycles" in by_name["missing_s"]["why"]


def test_the_last_second_is_that_of_the_arm_and_not_of_the_record(tmp_path):
    _, by_name = judged(tmp_path, lost=without("plant", 1.5, 9.0))
    for name, _ in ASKED:
        assert by_name[name]["value"] is None and by_name[name]["why"] == "the last second was not recorded by both programs"


def test_a_run_without_any_truth_has_no_figures(tmp_path):
    verdict, by_name = judged(tmp_path, lost=without("plant", -9.0, 9.0))
    assert verdict == "fail" and by_name["missing_s"]["value"] == 3.0
    assert by_name["force_rms_N_last_second"]["why"] == "no cycle of an active arm was recorded by both programs"


def test_dropped_records_can_be_asked_for(tmp_path):
    _, by_name = judged(tmp_path, asked=[("truth_dropped", 0)], lost=without("plant", 1.0, 1.007))
    assert by_name["truth_dropped"]["value"] == 7 and not by_name["truth_dropped"]["ok"]


def test_contact_that_was_never_made_is_said(tmp_path, monkeypatch):
    monkeypatch.setattr(synthetic, "force_true", lambda t: 0.0)
    verdict, by_name = judged(tmp_path, asked=[("impact_peak_N", 10.0), ("contact_lost_ms", 0.0)])
    assert verdict == "fail"
    assert judged(tmp_path / "again")[1]["force_rms_N_last_second"]["value"] is not None, "a force is desired here"
    monkeypatch.setattr(synthetic, "FORCE_DESIRED_N", 0.0)
    assert judged(tmp_path / "none")[1]["force_rms_N_last_second"]["why"] == "contact was never made"
    assert by_name["impact_peak_N"]["why"] == by_name["contact_lost_ms"]["why"] == "contact was never made"


def test_an_arm_that_was_never_active_is_said(tmp_path):
    verdict, by_name = judged(tmp_path, fault_at_s=0.0, asked=[("impact_peak_N", 10.0), ("joint_rms_mrad", 1.0)])
    assert verdict == "fail"
    assert by_name["joint_rms_mrad"]["why"] == by_name["impact_peak_N"]["why"] == "the arm was never active"
    assert by_name["missing_s"] == {"name": "missing_s", "limit": 0, "value": 3.0, "ok": False, "why": "the arm was active for 0 of 3 s"}


def drifting(p_hat=None, sigma=None, boxes=None, sigma_limits=(1.0, 1.0)):
    signals, effective = still_run("known", "separated", n=300)
    signals.p_hat = signals.p_hat if p_hat is None else p_hat
    signals.sigma = signals.sigma if sigma is None else sigma
    boxes = boxes or list(zip(effective["arm"]["p_lo"], effective["arm"]["p_hi"]))
    return RunData(None, signals, 1000.0, [1.0] * 5, boxes, sigma_limits)


def test_what_has_no_room_does_not_drift():
    p = still_run("known", "separated", n=300)[0].p_hat
    run = drifting(boxes=[(value, value) for value in p[0]], sigma_limits=(0.0, 0.4))
    assert checks.value_of("estimate_drift_percent", run) == (0.0, None)
    assert checks.value_of("estimate_drift_ratio", run) == (0.0, None)
    assert checks.value_of("parameters_outside_box", run) == (0, None)


def test_what_has_room_drifts_beside_what_has_none():
    p = still_run("known", "separated", n=300)[0].p_hat.copy()
    boxes = [(value, value) for value in p[0]]
    boxes[0] = (0.0, 2.0)
    p[:, 0] = [k / 300.0 for k in range(300)]
    value, why = checks.value_of("estimate_drift_percent", drifting(p_hat=p, boxes=boxes))
    assert why is None and value == pytest.approx(100.0 * (100 / 300) / 2.0)
    assert estimate_figures.estimate_drift_ratio(drifting(p_hat=p, boxes=boxes)) == pytest.approx(1.0)


def test_an_estimate_that_begins_to_move_at_the_end_has_no_ratio():
    p = still_run("known", "separated", n=300)[0].p_hat.copy()
    p[250:, 0] += 1.0
    with pytest.raises(NoFigure, match="began to move in the last third"):
        estimate_figures.estimate_drift_ratio(drifting(p_hat=p))
