"""Runs behind link.wire_time: frames arrive within the schedule's computed worst case, and the summary shows both."""

import subprocess

import pytest

from reed_tools.figures import result_table, summary
from reed_tools.paths import build, program
from reed_tools.record import telemetry_log
from reed_tools.record.signals import MODES
from reed_tools.run import hil, plans, scenario

DURATION_S = 0.8


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """run(KEY=VALUE, ...): what its telemetry says."""
    build("reed_one_process")

    def recorded(*entries, status=0):
        folder = tmp_path_factory.mktemp("run")
        effective = scenario.write_effective("press_known", None, [f"scenario.duration_s={DURATION_S}", *entries], folder / "effective.toml", halves=True)
        plan = plans.make(effective, folder / "effective.toml", hil.MEMORY, "lockstep", folder, lcm=False)
        outcome = hil.run(plan, lambda mode, t_s: None)
        assert outcome.statuses == {"one_process": status} and not outcome.stopped_because, hil.last_words(plan, "one_process")
        return telemetry_log.load(plan.log("firmware"), plan.log("plant"))

    return recorded


@pytest.fixture(scope="module")
def recording(run):
    return run("link.wire_time=true")


@pytest.fixture(scope="module")
def alone(recording):
    return summary.wire_time(recording)


def test_without_others_nothing_is_later_than_the_computed_worst_case(alone):
    assert alone["answers_us"]["computed"] == pytest.approx(56.6 + 5 * 72.6 + 105.6) and alone["command_us"]["computed"] == pytest.approx(137.6)
    for name in ("answers_us", "command_us"):
        assert 0.7 * alone[name]["computed"] < alone[name]["p50"] <= alone[name]["max"] <= alone[name]["computed"]
    assert alone["foreign_percent"] == 0
    assert "(worst case computed 525.2)" in result_table.wire_time(alone)[0]


def test_a_run_behind_a_wire_is_sound(recording):
    bus, control = recording.singles["REED_BUS"][-1], recording.tables["REED_CONTROL"]
    assert (bus.lost, bus.late) == (0, 0) and recording.finished_run is not None
    assert "active" in (modes := {MODES[mode] for mode in control["mode"]}) and "fault" not in modes


def test_others_delay_and_take_their_share(run, alone):
    beside = summary.wire_time(run("link.wire_time=true", "link.foreign_load=0.3"))
    assert beside["foreign_percent"] == pytest.approx(30, abs=4)
    for figure in ("p50", "max"):
        assert beside["answers_us"][figure] > alone["answers_us"][figure]
    assert beside["answers_us"]["max"] > beside["answers_us"]["computed"] > alone["answers_us"]["max"]


def test_frames_that_an_overfull_wire_gives_up_are_counted(run, alone):
    full = summary.wire_time(run("link.wire_time=true", "timing.rate_hz=2500", "scenario.allow_wire_overload=true", status=1))
    assert full["dropped"] > 1000 and f"{full['dropped']} frames given up, the wire's queue was full" in result_table.wire_time(full)[0]
    assert alone["dropped"] == 0 and "given up" not in result_table.wire_time(alone)[0]


def test_a_run_without_a_wire_says_nothing_of_one(run):
    assert summary.wire_time(run("link.command_delay_s=0.001")) is None and result_table.wire_time(None) == []


def test_a_link_by_the_clock_and_one_that_does_nothing_are_refused():
    build("reed_plant_sim", "reed_config_tool")
    by_clock = subprocess.run([program("reed_plant_sim"), "--config", "free_motion", "--bus", "udp:239.74.163.34:43990", "--clock", "realtime",
                               "--set", "link.command_delay_s=0.001"], capture_output=True, text=True, timeout=60)
    assert by_clock.returncode == 2 and "--clock lockstep" in by_clock.stderr and by_clock.stderr.count("\n") == 1
    for entry in ("link.foreign_load=0.2", "link.foreign_id=5"):
        done = subprocess.run([program("reed_config"), "--config", "free_motion", "--set", entry], capture_output=True, text=True)
        assert done.returncode == 2 and "does nothing without link.wire_time" in done.stderr
