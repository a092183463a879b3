"""The cycle number is 32 bits wide on the bus: a run that crosses its end is the same run in everything but the number."""

import json

import numpy as np
import pytest

from reed_tools import cli
from reed_tools.identify import samples
from reed_tools.paths import build
from reed_tools.record import tape, telemetry_log
from reed_tools.run import hil, plans, scenario

FIRST = 2**32 - 400  # the arm is active by then, and in contact later
DURATION = "scenario.duration_s=0.8"


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    build("reed_one_process", "reed_replay")
    return {first: record(tmp_path_factory.mktemp("run"), first) for first in (0, FIRST)}


def record(folder, first):
    effective = scenario.write_effective("press_known", None, [DURATION, f"timing.first_cycle={first}"], folder / "effective.toml", halves=True)
    plan = plans.make(effective, folder / "effective.toml", hil.MEMORY, "lockstep", folder, lcm=False)
    outcome = hil.run(plan, lambda mode, t_s: None)
    assert outcome.statuses == {"one_process": 0} and not outcome.stopped_because, hil.last_words(plan, "one_process")
    return folder, telemetry_log.load(plan.log("firmware"), plan.log("plant"))


def test_both_programs_go_on_where_the_number_starts_over(runs):
    (_, plain), (_, crossing) = runs[0], runs[FIRST]
    for channel in ("REED_MEASURED", "REED_CONTROL", "REED_ADAPTATION", "REED_PLANT"):
        one, other = plain.tables[channel], crossing.tables[channel]
        assert np.array_equal(other["cycle"], one["cycle"] + FIRST) and one["cycle"][-1] > 700
        for field in set(one) - {"cycle", "utime"}:
            assert np.array_equal(one[field], other[field], equal_nan=True), f"{channel}.{field}"


def test_no_frame_is_lost_late_or_refused_there(runs):
    bus = runs[FIRST][1].singles["REED_BUS"][-1]
    assert bus.frames_rx > 4000 and bus.cycle > 2**32
    counted = set(bus.__slots__) - {"frames_rx", "frames_tx", "cycle", "utime"}
    assert {name: getattr(bus, name) for name in counted} == dict.fromkeys(counted, 0)


def test_its_tape_replays_to_the_bit(runs, capsys):
    folder, _ = runs[FIRST]
    status = cli.main(["replay", str(folder / tape.NAME), "--json"])
    found = json.loads(capsys.readouterr().out)
    assert status == 0 and found["same"] and found["cycles"] > 700
    assert tape.read(folder / tape.NAME)["cycle"][0] == FIRST


def test_a_tape_without_its_first_cycle_is_no_tape_from_the_beginning(runs, capsys, tmp_path):
    folder, _ = runs[FIRST]
    status = cli.main(["replay", str(folder / tape.NAME), "--set", "timing.first_cycle=0"])
    assert status == 2 and "first cycle is missing" in capsys.readouterr().err


def test_frames_alone_are_counted_across_it(runs):
    """For `identify`, from a log of the bus."""
    found = {first: samples.of_candump(folder / "bus.candump", 5) for first, (folder, _) in runs.items()}
    assert [len(stretch.angle) for stretch in found[FIRST]] == [len(stretch.angle) for stretch in found[0]]
    assert np.array_equal(found[FIRST][0].angle, found[0][0].angle)
