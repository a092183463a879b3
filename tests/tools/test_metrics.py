"""The figures of summary.json on a synthetic run whose figures are known in closed form (synthetic_run.py)."""

import hashlib
import json
import math
import re
import subprocess

import numpy as np
import pytest
import synthetic_run as synthetic

from reed_tools.errors import UsageError
from reed_tools.figures import checks, metrics, plots, report_page, result_table, summary
from reed_tools.figures.evaluate import evaluate
from reed_tools.record import signals
from reed_tools.record.merge import merge
from reed_tools.record.telemetry_log import DIGEST_CHANNELS, events, load, require_whole


def recorded(folder, wanted=(), **options):
    synthetic.write(folder, list(wanted), **options)
    merge([folder / "firmware.lcmlog", folder / "plant.lcmlog"], folder / "telemetry.lcmlog")
    return folder


def build(folder):
    return summary.build(folder, load(folder / "telemetry.lcmlog"))[0]


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return build(recorded(tmp_path_factory.mktemp("run")))


def test_tangential_joint_error_is_what_is_orthogonal_to_D(run):
    amplitude = math.hypot(*synthetic.AMPLITUDE)
    expected = 1e3 * amplitude / math.sqrt(2) / math.sqrt(synthetic.DOF)
    for window in run["windows"]:
        assert window["tangential_joint_rms_mrad"] == pytest.approx(expected, rel=1e-9)


def test_joint_error_has_both_parts(run):
    wave = sum(a * a for a in synthetic.AMPLITUDE) / 2
    offset = sum((synthetic.ALONG_D * d) ** 2 for d in synthetic.D)
    assert run["windows"][0]["joint_rms_mrad"] == pytest.approx(1e3 * math.sqrt((wave + offset) / 2), rel=1e-9)
    assert run["windows"][0]["joint_peak_mrad"] == pytest.approx(7.0, rel=1e-9)


def test_tip_error_without_the_normal_part(run):
    assert run["windows"][1]["tip_rms_mm"] == pytest.approx(5.0)
    assert run["windows"][1]["tangential_tip_rms_mm"] == pytest.approx(3.0)


def test_force_error_counts_only_where_a_force_is_desired(run):
    assert run["windows"][0]["force_peak_N"] == pytest.approx(synthetic.FORCE_ERROR_N)  # the 9 N impact came before
    assert run["windows"][2]["force_rms_N"] == pytest.approx(synthetic.FORCE_ERROR_N)


def test_windows_are_whole_seconds_of_whole_periods(run):
    assert [(w["from_s"], w["to_s"]) for w in run["windows"]] == [(0, 1), (1, 2), (2, 3)]


@pytest.mark.parametrize("end_s, edges", [(0.4, [(0, 0.4)]), (1.0, [(0, 1)]), (2.5, [(0, 1), (1, 2), (2, 2.5)]),
                                          (3.001, [(0, 1), (1, 2), (2, 3)]), (2.9999999, [(0, 1), (1, 2), (2, 3)])])
def test_window_edges(end_s, edges):
    assert metrics.window_edges(end_s) == edges


def test_modes_list_every_change_with_time_since_active(run):
    assert run["modes"] == [{"t_s": -0.1, "mode": "ready", "force_source": "none"},
                            {"t_s": 0.0, "mode": "active", "force_source": "known"},
                            {"t_s": synthetic.SWITCH_S, "mode": "active", "force_source": "unknown"}]


def test_timing_has_no_wake_in_lockstep_and_percentiles_on_the_wall_clock(tmp_path, run):
    assert run["timing_us"]["wake"] is None
    assert run["timing_us"]["compute"] == {"p50": 30.0, "p99": 30.0, "p999": 30.0, "max": 30.0}
    wall = build(recorded(tmp_path, clock="wall"))
    assert wall["timing_us"]["wake"]["max"] == pytest.approx(20.0 + 3.099)
    assert wall["timing_us"]["wake"]["p50"] == pytest.approx(20.0 + 1.5495, abs=1e-3)


def test_host_pauses_are_reported_with_the_cycles_missed_in_them(tmp_path, run):
    assert run["host_pause"] == dict.fromkeys(("count", "host_pause_s", "missed_cycles")), "lockstep follows no clock"
    paused = build(recorded(tmp_path, clock="wall"))
    assert paused["host_pause"] == {"count": 1, "host_pause_s": 0.0031, "missed_cycles": 2}
    assert paused["missed_cycles"] == 3


def test_counters_come_from_the_programs_own_messages(run):
    assert run["bus"] == {"kind": "udp", "interface": "239.74.163.2:43113", "fd": True, "frames_rx": 9300, "frames_tx": 6200,
                          "lost": 2, "crc_errors": 1, "repeated": 0, "wire_load_percent": 61.5}
    assert (run["cycles"], run["missed_cycles"], run["overruns"], run["wall_s"], run["sim_s"]) == (3100, 3, 1, 3.1, 3.1)
    assert run["loop"] == {"heap_allocations": 0, "page_faults": 0, "telemetry_dropped": 0, "scheduler": "fifo:80",
                           "memory_locked": True}


def test_parameters(run):
    assert run["parameters"] == {"names": ["m1", "m2"], "true": [1.0, 0.5], "initial": [0.0, 0.0], "final": [1.0, 0.5],
                                 "max_abs": [1.0, 0.5]}


def test_digest_is_that_of_the_encoded_messages(tmp_path):
    folder = recorded(tmp_path, extra_plant_cycles=5)
    hashes = {channel: hashlib.sha256() for channel in DIGEST_CHANNELS}
    for utime, channel, data in events(folder / "telemetry.lcmlog"):
        if channel in hashes and utime < 3_100_000:  # the plant's last answers came after the controller's last cycle
            hashes[channel].update(data)
    lockstep = hashlib.sha256(b"".join(hashes[channel].digest() for channel in DIGEST_CHANNELS)).hexdigest()
    wall = hashlib.sha256(b"".join(hashes[channel].digest() for channel in DIGEST_CHANNELS[:3])).hexdigest()
    recording = load(folder / "telemetry.lcmlog")
    assert (recording.digest("lockstep"), recording.digest("wall")) == (lockstep, wall)


def test_digest_tells_runs_apart_by_one_bit(tmp_path, monkeypatch):
    one = build(recorded(tmp_path / "one"))["digest"]
    assert build(recorded(tmp_path / "two"))["digest"] == one
    monkeypatch.setattr(synthetic, "NORMAL", (0.0, 0.0, np.nextafter(1.0, 2.0)))
    assert build(recorded(tmp_path / "three"))["digest"] != one


LIMITS = {"impact_peak_N": 9.0, "torque_step_at_switch_percent": 1.25, "missed_cycles_in_row": 3, "missed_cycles": 3, "overruns": 1,
          "faults": 0, "contact_lost_ms": 0, "parameters_outside_box": 0, "estimate_drift_percent": 50.0 * 1000 / 3099,
          "estimate_drift_ratio": 1.0, "heap_allocations": 0, "truth_dropped": 0, "frames_lost": 2, "crc_errors": 1,
          "force_rms_percent_last_second": 2.5, "contact_force_max_N": 9.0, "contact_force_max_percent_of_desired": 112.5,
          "torque_peak_percent": 26.25, "tip_rms_mm_last_second": 5.0, "force_peak_N_last_second": 0.2,
          "tangential_joint_peak_mrad_last_second": 4.0}


def test_every_check_has_its_value_and_can_fail(tmp_path):
    folder = recorded(tmp_path, LIMITS.items())
    for check in build(folder)["checks"]:
        if check["name"] == "missing_s":
            assert check["value"] == 0
            continue
        assert check["value"] == pytest.approx(LIMITS[check["name"]], rel=1e-9, abs=1e-9), check["name"]
    tight = recorded(tmp_path / "tight", [(name, value - 0.01) for name, value in LIMITS.items()])
    result = build(tight)
    assert result["verdict"] == "fail" and not any(check["ok"] for check in result["checks"] if check["name"] != "missing_s")


def test_every_figure_has_a_value_on_a_complete_run(tmp_path):
    folder = recorded(tmp_path, [(name, 1e9) for name in checks.FIGURES])
    result = build(folder)
    assert result["verdict"] == "pass"
    assert all(check["value"] is not None for check in result["checks"])


def test_a_fault_fails_a_run_that_asks_for_nothing(tmp_path):
    result = build(recorded(tmp_path, fault_at_s=1.5))
    assert result["verdict"] == "fail"
    assert result["checks"] == [{"name": "faults", "limit": 0, "value": 1, "ok": False, "why": None},
                                {"name": "missing_s", "limit": 0, "value": 1.5, "ok": False, "why": "the arm was active for 1.5 of 3 s"}]
    assert result["windows"][-1]["to_s"] == 1.5


def test_unknown_check_names_the_allowed_ones():
    with pytest.raises(UsageError, match="not a figure; allowed: tangential_joint_rms_mrad_last_second, "):
        checks.require_known([{"name": "joint_error", "limit": 1.0}], where="x.toml")


def test_a_run_that_was_cut_short_fails_and_claims_nothing_of_the_loop(tmp_path):
    synthetic.write(tmp_path, [("heap_allocations", 0)])
    firmware = tmp_path / "firmware.lcmlog"
    firmware.write_bytes(firmware.read_bytes()[:-2_000_003])
    merge([firmware, tmp_path / "plant.lcmlog"], tmp_path / "telemetry.lcmlog")
    result = build(tmp_path)
    by_name = {check["name"]: check for check in result["checks"]}
    assert result["verdict"] == "fail" and by_name["missing_s"]["value"] > 0.1
    assert by_name["heap_allocations"]["value"] is None and not by_name["heap_allocations"]["ok"]
    assert set(result["loop"].values()) == {None} and result["wall_s"] is None
    assert result_table.lines(result)


def test_a_damaged_log_is_told_from_a_whole_one(tmp_path):
    log = recorded(tmp_path) / "telemetry.lcmlog"
    require_whole(log)
    whole = log.read_bytes()
    for damaged in (whole[:-100], whole[:100_000] + bytes(5000) + whole[105_000:], b"no log"):
        log.write_bytes(damaged)
        with pytest.raises(UsageError, match="is damaged"):
            require_whole(log)


def test_a_log_cut_in_the_middle_still_gives_figures(tmp_path):
    synthetic.write(tmp_path, [])
    firmware = tmp_path / "firmware.lcmlog"
    firmware.write_bytes(firmware.read_bytes()[:-2_000_003])
    merge([firmware, tmp_path / "plant.lcmlog"], tmp_path / "telemetry.lcmlog")
    result = build(tmp_path)
    assert 100 < result["cycles"] < 3100 and result["windows"]
    json.dumps(result, allow_nan=False)


def test_a_run_that_recorded_nothing_has_a_summary_of_nulls(tmp_path):
    (tmp_path / "effective.toml").write_text("checks = []\n" + synthetic.EFFECTIVE)
    merge([], tmp_path / "telemetry.lcmlog")
    result = build(tmp_path)
    assert (result["cycles"], result["windows"], result["modes"]) == (0, [], [])
    json.dumps(result, allow_nan=False)


def test_page_needs_nothing_from_outside_and_shows_every_picture(tmp_path):
    evaluate(recorded(tmp_path))
    page = (tmp_path / "report.html").read_text()
    assert page.count("data:image/png;base64,") == len(report_page.CAPTIONS) == len(list(tmp_path.glob("*.png")))
    assert not re.search(r"""(src|href)\s*=\s*["']?(https?:)?//|url\(\s*["']?https?:""", page)  # a licence line may name its home


def test_removing_a_component_leaves_rows_without_direction_alone():
    x = np.array([[1.0, 2.0], [3.0, 4.0]])
    out = signals.remove_component(x, np.array([[0.0, 0.0], [0.0, 2.0]]))
    assert out.tolist() == [[1.0, 2.0], [3.0, 0.0]]


def test_foreign_logplayer_reads_the_merged_log(tmp_path):
    """lcm-logger's own tool chain accepts what merge wrote."""
    folder = recorded(tmp_path, duration_s=0.5)
    done = subprocess.run(["lcm-logplayer", "-l", "file://" + str(tmp_path / "copy.lcmlog") + "?mode=w", "-s", "1000",
                           str(folder / "telemetry.lcmlog")], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    copied = sorted((channel, data) for _, channel, data in events(tmp_path / "copy.lcmlog"))
    assert copied == sorted((channel, data) for _, channel, data in events(folder / "telemetry.lcmlog"))


def test_decoding_at_once_equals_the_generated_classes(tmp_path):
    from reed_tools.record.message_layout import decode_all, joined
    from reed_tools.record.telemetry_log import TABLES, payloads as blocks_of
    import reed

    folder = recorded(tmp_path, duration_s=0.2)
    payloads = {}
    for _, channel, data in events(folder / "telemetry.lcmlog"):
        payloads.setdefault(channel, []).append(data)
    blocks = blocks_of(folder / "telemetry.lcmlog")
    assert set(blocks) & set(TABLES) == set(TABLES) - {"REED_LAW", "REED_WIRE"}  # a law of the bank shows nothing of its own; no wire in time
    for channel, name in ((channel, name) for channel, name in TABLES.items() if channel in blocks):
        kind = getattr(reed, name)
        at_once = decode_all(kind, name, joined(name, blocks[channel]))
        for row, data in enumerate(payloads[channel]):
            message = kind.decode(data)
            for field in kind.__slots__:
                assert np.array_equal(at_once[field][row], getattr(message, field)), (channel, field, row)


def test_a_log_of_two_different_arms_is_refused():
    from reed_tools.record.message_layout import joined
    import reed

    one, two = reed.adaptation_t(), reed.adaptation_t()
    two.num, two.p_hat, two.eta_hat = 1, [1.0], [1.0]
    with pytest.raises(UsageError, match="not of one run"):
        joined("adaptation_t", [np.frombuffer(message.encode(), np.uint8)[np.newaxis] for message in (one, two)])


def test_a_log_is_read_in_blocks_as_one_by_one_and_a_damaged_one_as_far_as_liblcm_reads_it(tmp_path):
    from reed_tools.record import event_log
    from reed_tools.record.telemetry_log import payloads

    path = recorded(tmp_path, duration_s=0.5) / "telemetry.lcmlog"
    whole = path.read_bytes()
    half, record = len(whole) // 2, whole.index(bytes.fromhex("EDA1DA01"), 1000)
    damaged = {"whole": whole, "cut": whole[:half], "within a head": whole[:record + 10], "nothing": b"",
               "noise between records": whole[:record] + b"noise" + whole[record:],
               "a byte changed": whole[:record + 2] + b"?" + whole[record + 3:]}
    for name, content in damaged.items():
        path.write_bytes(content)
        one_by_one = {}
        for _, channel, data in events(path):
            one_by_one.setdefault(channel, []).append(data)
        at_once = {channel: [row.tobytes() for block in blocks for row in block] for channel, blocks in payloads(path).items()}
        assert at_once == one_by_one, name
    path.write_bytes(damaged["cut"])
    with pytest.raises(ValueError):
        event_log.read(path)


@pytest.mark.parametrize("clock", ["wall", "lockstep"])
def test_only_a_paced_loop_has_a_period(tmp_path, clock):
    """In lockstep a cycle takes as long as the plant's answer does: nothing is late."""
    folder = recorded(tmp_path, duration_s=1.0, clock=clock)
    recording = load(folder / "telemetry.lcmlog")
    figures, _ = summary.build(folder, recording)
    figure = plots.timing(recording, figures)
    dashed = [line for axis in figure.axes for line in axis.lines if line.get_linestyle() == "--"]
    assert len(dashed) == (len(figure.axes) if clock == "wall" else 0)
    assert ("period 1000" in figure.get_suptitle()) == (clock == "wall")
    assert ("keeps no period" in result_table.timing(figures).title) == (clock == "lockstep")
