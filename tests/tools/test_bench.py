"""tools/reed bench: how figures become verdicts, what it says without its other sides, and bad input. Nothing is timed here."""

import json
import math
import subprocess
import time
from types import SimpleNamespace

import numpy as np
import pytest

from reed_tools import cli
from reed_tools.bench import command, plot, programs, rates, steps, wake
from reed_tools.bench.rows import Found, Row

QUICK = SimpleNamespace(quick=True, processes=1, slice=1, slices=1)


def test_a_ratio_is_judged_against_its_aim_and_a_figure_without_other_side_against_its_own():
    assert Row("step", 2.0, 8.0, "ns", 0.5, "other").ok
    assert not Row("step", 5.0, 8.0, "ns", 0.5, "other").ok
    assert Row("speed", 9.0, None, "x", 8.0, less_is_better=False).ok
    assert not Row("speed", 7.0, None, "x", 8.0, less_is_better=False).ok
    assert Row("telemetry", 0.4, None, "µs", 0.5).ok


def test_an_aim_of_a_ratio_is_not_judged_when_the_other_side_is_missing():
    assert Row("step", 0.1, None, "ns", 0.5, "other").ok is None


def test_no_miss_beside_no_stall_is_even_and_any_miss_beside_none_is_too_many():
    assert Row("missed", 0, 0, "", 1.0, "cyclictest").ok
    missed = Row("missed", 3, 0, "", 1.0, "cyclictest")
    assert missed.ratio == math.inf and missed.ok is False
    json.dumps(missed.as_json(), allow_nan=False)


def test_the_exponent_of_a_power_law_is_its_power():
    assert steps.exponent({n: 3.0 * n**1.7 for n in (2, 4, 8, 16, 32)}) == pytest.approx(1.7)


CYCLICTEST = """# Histogram
000019 000040
000020 000050
000300 000008
# Total: 000000098
# Min Latencies: 00019
# Histogram Overflows: 00002
"""


def test_cyclictests_histogram_gives_quantiles_within_its_bins_and_its_overflows_are_late(monkeypatch):
    monkeypatch.setattr(programs, "output", lambda command: CYCLICTEST)
    found = wake.summary(wake.cyclictest(1, 1000))
    assert found == {"p50_us": 20.2, "p99_us": 5000.5, "late": 2}


def test_without_cyclictest_the_loops_own_latency_is_measured_and_the_fix_is_told(monkeypatch):
    monkeypatch.setattr(wake.shutil, "which", lambda name: None)
    monkeypatch.setattr(programs, "build", lambda *targets: None)
    monkeypatch.setattr(programs, "output", lambda command: '{"p50_us": 5.0, "p99_us": 9.0, "late": 1}')
    monkeypatch.setattr(wake, "program", lambda name: name)
    found = wake.wake(QUICK, None)
    assert [row.ours for row in found.rows] == [5.0, 9.0] and all(row.ratio is None for row in found.rows)
    assert any("sudo apt install rt-tests" in note for note in found.notes)


def test_cyclictests_grid_goes_on_at_the_first_point_that_is_not_past():
    due = 1e6 + rates.LOOK_US
    assert rates.pauses_of([5, 250, 5, 70], 1e6) == [(due + 100, due + 350), (due + 500, due + 570)]


def test_a_missed_cycle_is_excused_by_a_stall_between_its_due_time_and_its_end_alone():
    now_us, shift = 1e6 * time.time(), 1e6 * (time.monotonic() - time.time())
    table = {"utime": now_us + np.array([0.0, 1000.0, 5000.0, 9000.0]), "missed": np.array([0, 2, 3, 3]),
             "wake_ns": np.full(4, 300e3), "cycle_ns": np.full(4, 400e3)}
    far, near = [1e9, 1e9 + 70.0], [now_us + shift + 1200.0, now_us + shift + 1500.0]
    assert rates.outside_pauses(table, np.array([far])) == 3
    assert rates.outside_pauses(table, np.array([near, far])) == 1
    assert rates.outside_pauses(table, np.empty((0, 2))) == 3
    assert rates.by_chance(table, np.array([far])) == 0.0
    assert rates.by_chance(table, np.array([[now_us + shift + 8800.0, now_us + shift + 8900.0]])) == 1.0


def test_without_pinocchio_and_valgrind_the_steps_are_measured_and_the_fixes_are_told(monkeypatch):
    stages = {name: {"best_ns": 1.0, "median_ns": 2.0} for name in ("step", "regressor_a5", "regressor_a7")}
    monkeypatch.setattr(programs.importlib.util, "find_spec", lambda name: None)
    monkeypatch.setattr(programs, "build", lambda *targets: None)
    monkeypatch.setattr(programs, "nanoseconds", lambda name, processes: dict(stages))
    monkeypatch.setattr(steps.callgrind, "available", lambda: False)
    found = steps.steps(QUICK, None)
    assert len(found.rows) == 3 and all(row.ok is None for row in found.rows)
    told = " ".join(found.notes)
    assert "pip install pin" in told and "apt install valgrind" in told


def test_without_qemu_the_embedded_core_is_named_with_the_fix(monkeypatch):
    monkeypatch.setattr(command.embedded.shutil, "which", lambda name: None)
    found = command.cortex_m7(QUICK, None)
    assert found.rows == [] and "sudo apt install qemu-system-arm" in found.notes[0]


def test_the_picture_holds_ratios_and_growth(tmp_path):
    growth = {"joints": [2, 4, 8], "reed": [1.0, 2.0, 4.0], "pinocchio": [3.0, 8.0, 20.0]}
    found = Found([Row("step", 2.0, 8.0, "ns", 0.5, "other")], details={"growth_ns": growth})
    assert plot.draw(found, "a machine", tmp_path / "bench.png")
    assert (tmp_path / "bench.png").read_bytes().startswith(b"\x89PNG")
    assert not plot.draw(Found(), "a machine", tmp_path / "none.png")


def test_what_is_built_first_is_said_beside_standard_output(monkeypatch, capsys):
    """Standard output may be JSON."""
    monkeypatch.setattr(programs.subprocess, "run", lambda *_, **__: subprocess.CompletedProcess([], 0, stdout="[1/2]"))
    programs.build("reed_law_budget")
    said = capsys.readouterr()
    assert said.out == "" and said.err == "  building reed_law_budget\n"


@pytest.mark.parametrize("argv, told", [
    (["bench", "colour"], "wake"),
    (["bench", "--slices", "0"], "--slices 0"),
    (["bench", "--processes", "many"], "--processes"),
    (["bench", "wake", "--out", "/proc/nowhere"], "/proc/nowhere"),
])
def test_bad_input_is_one_line_and_status_2(reed, argv, told):
    done = reed(*argv)
    assert done.returncode == 2, done.stdout + done.stderr
    assert len(done.stderr.splitlines()) == 1 and told in done.stderr


def test_json_is_the_content_of_the_file_and_alone_on_standard_output(tmp_path, monkeypatch, capsys):
    row = Row("a", 2.0, 1.0, "µs", 3.0, "the other")
    monkeypatch.setattr(command, "MEASURES", {"telemetry": (lambda arguments, folder: Found([row], notes=["a note"]), "something")})
    monkeypatch.setattr(plot, "draw", lambda *_: False)
    assert cli.main(["bench", "telemetry", "--json", "--out", str(tmp_path / "bench")]) == 0
    said = capsys.readouterr()
    found = json.loads(said.out)
    assert found == json.loads((tmp_path / "bench" / "bench.json").read_text()) and set(found) == {"machine", "rows", "notes", "details"}
    assert found["rows"] == [row.as_json()] and found["notes"] == ["a note"] and "measuring something" in said.err
