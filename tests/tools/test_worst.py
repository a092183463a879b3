"""tools/reed worst: the search finds what was planted, the case is reduced to what it needs, and all of it is the same on any workers."""

import collections
import itertools
import json
import math
import os
import shlex
import signal
import time
from dataclasses import dataclass

import pytest
from process_tree import children, command_line

from reed_tools.campaign import definition
from reed_tools.campaign.draws import Record
from reed_tools.errors import UsageError
from reed_tools.run import hil
from reed_tools.worst import cases, judged
from reed_tools.worst.search import Case, corners, population, search
from reed_tools.worst.shrink import shrink
from reed_tools.worst.space import Space

PRESS = definition.CAMPAIGNS / "press_known.toml"


def evaluate(function):
    return lambda points: [Case(point, function(point)) for point in points]


def hill(point, summit, width=0.25):
    """1 at the summit, on a slope that reaches everywhere."""
    return math.exp(-sum((u - top) ** 2 for u, top in zip(point, summit)) / (2.0 * width**2 * len(summit)))


@pytest.mark.parametrize("seed", range(1, 6))
def test_a_planted_optimum_among_eleven_parameters_is_found_with_the_campaigns_number_of_runs(seed):
    summit = [0.1 + 0.08 * k for k in range(11)]
    found = search(11, 200, seed, evaluate(lambda point: hill(point, summit)))
    random = search(11, 200, seed, evaluate(lambda point: 0.0)).cases[:32]  # the Sobol points, whatever they say
    assert found.worst.ratio > 0.9 > max(hill(case.point, summit) for case in random)
    assert len(found.cases) <= 200


def two_hills(point):
    """The larger one is narrow, and far from the smaller."""
    return max(0.8 * hill(point, (0.25, 0.3)), 1.0 * hill(point, (0.8, 0.85), width=0.12))


def test_in_two_dimensions_the_search_finds_what_a_fine_grid_finds():
    grid = max(two_hills((i / 200, j / 200)) for i in range(201) for j in range(201))
    for seed in range(1, 6):
        assert search(2, 160, seed, evaluate(two_hills)).worst.ratio == pytest.approx(grid, rel=1e-3)


def test_a_maximum_at_the_edge_is_found_and_nothing_outside_is_asked_for():
    found = search(3, 200, 1, evaluate(lambda point: sum(point)))
    assert found.worst.ratio > 2.95 and all(0.0 <= u <= 1.0 for case in found.cases for u in case.point)


CORNER = (1, 0, 1, 1, 0, 0, 1, 0, 1, 1, 0)


@pytest.mark.parametrize("seed", range(1, 6))
def test_a_corner_among_2048_to_which_everything_leads_is_found(seed):
    """No two parameters count the same, the least one a sixtieth of all."""
    def slope(point):
        return sum(weight * (1.0 - abs(u - end)) for weight, (u, end) in enumerate(zip(point, CORNER), 1)) / 66.0

    assert search(11, 200, seed, evaluate(slope)).worst.ratio > 0.96


def cliff(point):
    """Flat but where four of eleven parameters are near their ends."""
    inside = max(abs(point[axis] - CORNER[axis]) for axis in (2, 5, 7, 9))
    return 0.5 + 0.1 * point[0] + max(0.0, 1.0 - inside / 0.15)


@pytest.mark.parametrize("seed", range(1, 6))
def test_a_cliff_in_the_corner_of_four_of_eleven_parameters_is_found(seed):
    """Its share of the space is 1/2000: neither a campaign's draws nor the Sobol points meet it."""
    found = search(11, 200, seed, evaluate(cliff))
    assert found.worst.ratio > 1.5 and max(case.ratio for case in found.cases[:32]) < 0.6


@pytest.mark.parametrize("axes, count", [(11, 32), (16, 32), (7, 16)])
def test_any_three_parameters_have_each_combination_of_their_ends_equally_often(axes, count):
    for triple in itertools.combinations(zip(*corners(axes, count, "1/0")), 3):
        met = collections.Counter(zip(*triple))
        assert len(met) == 8 and set(met.values()) == {count // 8}


def test_more_parameters_than_a_design_has_room_for_and_one_corner_are_designs_too():
    assert len(set(corners(40, 16, "1/0"))) == 16 and len(corners(5, 1, "1/0")) == 1
    for runs in range(4, 40):
        assert len(search(9, runs, 1, evaluate(sum)).cases) == runs


def test_a_search_that_rests_starts_again_elsewhere_and_uses_its_runs():
    found = search(2, 400, 1, evaluate(lambda point: hill(point, (0.5, 0.5), 0.05)))
    assert len(found.cases) == 400


def test_generations_have_one_size_and_the_last_one_has_what_is_left():
    sizes = []

    def keep(points):
        sizes.append(len(points))
        return evaluate(sum)(points)

    search(11, 200, 1, keep)
    assert sizes[:4] == [32, 32, 32, 1] and set(sizes[4:-1]) == {population(11)} and sum(sizes) == 200


def test_where_no_corner_is_worse_than_the_inside_one_design_of_them_is_enough():
    sizes = []

    def keep(points):
        sizes.append(len(points))
        return evaluate(lambda point: hill(point, (0.5,) * 11))(points)

    search(11, 200, 1, keep)
    assert sizes[:3] == [32, 32, 1] and set(sizes[3:-1]) == {population(11)}


def test_a_case_without_a_ratio_ends_the_search_with_its_generation():
    found = search(2, 200, 1, evaluate(lambda point: math.inf if point[0] > 0.9 else point[0]))
    assert found.worst.ratio == math.inf and len(found.cases) < 200


def test_what_is_refused_at_start_is_no_case():
    found = search(2, 100, 1, evaluate(lambda point: -math.inf if point[0] > 0.5 else point[0]))
    assert 0.45 < found.worst.ratio <= 0.5


@dataclass(frozen=True)
class Named:
    aim: str


def test_a_case_that_fails_is_reduced_to_what_makes_it_fail():
    """Two of six parameters do; a third makes it worse and is not needed."""
    def ratio(point):
        a, b, c = (0.0 if point[k] is None else point[k] for k in (1, 4, 5))
        return 0.7 * a + 0.5 * b + 0.1 * c

    def judge(points):
        return [Case(point, ratio(point), Named("force")) for point in points]

    worst, small = shrink(judge([(0.5, 1.0, 0.5, 0.5, 1.0, 1.0)])[0], judge)
    assert worst.ratio == pytest.approx(1.3)
    assert small.point == (None, 1.0, None, None, 1.0, None) and small.ratio == pytest.approx(1.2)


def test_a_case_within_its_limits_keeps_being_the_worst():
    def judge(points):
        return [Case(point, sum(0.01 * weight for weight, u in zip((50, 20, 1), point) if u is not None), Named("force")) for point in points]

    assert shrink(judge([(0.5, 0.5, 0.5)])[0], judge)[1].point == (0.5, 0.5, None)


def test_a_worse_case_on_the_way_is_the_worst_one():
    """The second parameter had made it better."""
    def judge(points):
        return [Case(point, 0.6 if point[1] is not None else 0.9 if point[0] is not None else 0.1, Named("force")) for point in points]

    worst, small = shrink(judge([(0.5, 0.5)])[0], judge)
    assert worst.ratio == 0.9 and small.point == (0.5, None)


def test_another_figure_that_fails_is_another_case():
    def judge(points):
        return [Case(point, 1.5 if point[0] is not None else 1.4, Named("force" if point[0] is not None else "speed")) for point in points]

    assert shrink(judge([(0.5,)])[0], judge)[1].point == (0.5,)


# ---- the space ----


def test_a_point_of_the_space_is_a_draw_and_nominal_is_what_the_scenario_has():
    campaign = definition.load(PRESS)
    space = Space(campaign)
    assert len(space.axes) == 11 and space.axes[0].name == "plant.p_true[0]" and "scenario.seed" not in {axis.name for axis in space.axes}
    middle = dict(entry.split("=", 1) for entry in space.entries((0.5,) * 11))
    assert float(middle["wall.stiffness_Npm"]) == pytest.approx(10e3) and float(middle["wall.offset_m"]) == pytest.approx(0.0)
    nominal = dict(entry.split("=", 1) for entry in space.entries((None,) * 11))
    assert set(nominal) == {"control.p_initial", "plant.p_true"} and nominal["plant.p_true"] == nominal["control.p_initial"]
    for draw in (0, 7):  # the campaign's own draw at its own numbers
        numbers = [definition.unit_number(f"{campaign.seed}/{draw}/{axis.drawn.key}/{axis.entry or 0}") for axis in space.axes]
        assert space.entries(tuple(numbers)) == [entry for entry in campaign.overrides(draw) if not entry.startswith("scenario.seed")]


def test_a_campaign_that_draws_noise_alone_has_no_space(tmp_path):
    path = tmp_path / "noise.toml"
    path.write_text('[campaign]\nname = "noise"\nscenario = "press_known"\ndraws = 4\n[[draw]]\nkey = "scenario.seed"\ninteger = [1, 9]\n')
    with pytest.raises(UsageError, match="no space to search"):
        Space(definition.load(path))


# ---- the command ----


@pytest.mark.parametrize("argv, reason", [
    (["nowhere"], "press_known"), (["--runs", "0"], "--runs 0: allowed: a whole number from 4"), (["--jobs", "0"], "--jobs 0"),
    (["--set", "wall.stifness_Npm=1"], "stiffness_Npm"), (["--scheduler", "here"], "tcp://HOST:PORT"),
    (["--scheduler", "tcp://127.0.0.1:1"], "no Dask scheduler answers there"), (["--bogus"], "--bogus"),
    (["--cases", "/proc/version"], "/proc/version:1: not a case")])
def test_bad_input_is_one_line_and_status_2(reed, tmp_path, argv, reason):
    keep = [] if "--cases" in argv else ["--no-keep"]
    done = reed("worst", *argv, *keep, "--out", tmp_path / "out")
    assert done.returncode == 2 and reason in done.stderr and len(done.stderr.splitlines()) == 1, done.stderr


def test_a_case_is_kept_once(tmp_path):
    case = {"campaign": "c", "scenario": "press_known", "entries": ["a=1"], "figure": "force", "ratio": 1.2}
    assert cases.add(tmp_path / "cases.jsonl", case) and not cases.add(tmp_path / "cases.jsonl", {**case, "ratio": 1.3})
    assert cases.read(tmp_path / "cases.jsonl") == [case]


# ---- with the programs themselves ----

SMALL = """[campaign]
name = "small"
scenario = "press_known"
draws = 20
[set]
"scenario.duration_s" = 1.5
[[draw]]
key = "wall.stiffness_Npm"
log_uniform = [5e3, 20e3]
[[draw]]
key = "wall.offset_m"
uniform = [-0.002, 0.002]
"""


@pytest.fixture(scope="module")
def searched(tmp_path_factory):
    """{(jobs, killed): (content of worst.json, folder)}"""
    found = {}
    for jobs, kill in ((1, False), (2, False), (2, True)):
        folder = tmp_path_factory.mktemp(f"worst{jobs}{kill}")
        (folder / "small.toml").write_text(SMALL)
        process = start(folder, jobs)
        if kill:
            kill_a_worker(process)
        out, err = process.communicate(timeout=400)
        assert process.returncode in (0, 1) and err == "", out + err
        found[jobs, kill] = json.loads((folder / "out" / "worst.json").read_text()), folder
    return found


def start(folder, jobs):
    import subprocess

    from reed_tools.paths import BUILD, PYTHON, ROOT

    return subprocess.Popen([*PYTHON, str(ROOT / "tools" / "reed_tools" / "__main__.py"), "worst", folder / "small.toml", "--jobs", str(jobs), "--out",
                             folder / "out", "--cases", folder / "cases.jsonl"], env={**os.environ, "REED_BUILD_DIR": str(BUILD)},
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def kill_a_worker(process):
    """Of those that the tool has started, while it runs something."""
    end = time.monotonic() + 120
    while time.monotonic() < end:
        for child in children(process.pid):
            if "spawn_main" in command_line(child) and any("--config\0press_known" in command_line(one) for one in children(child)):
                os.kill(child, signal.SIGKILL)
                return
        time.sleep(0.01)
    raise AssertionError("no worker ran anything")


def test_the_worst_case_is_the_same_bit_for_bit_with_one_worker_with_two_and_after_one_was_killed(searched):
    results = [result for result, _ in searched.values()]
    assert results[0] == results[1] == results[2]
    assert results[0]["ratio"] > 0 and len(results[0]["digest"]) == 64 and results[0]["runs"] <= 20


def test_it_is_at_least_as_bad_as_a_grid_over_both_dimensions_and_its_line_repeats_it(searched):
    result, folder = searched[1, False]
    campaign = definition.load(folder / "small.toml")
    space, stop = Space(campaign), []
    grid = [judged.run(campaign, "", (0, space.entries((i / 2, j / 2))), stop).ratio for i in range(3) for j in range(3)]
    assert result["ratio"] > 0.98 * max(grid)
    for one in (result, result["shrunk"]):
        words = shlex.split(one["command"])
        entries = [words[k + 1] for k, word in enumerate(words) if word == "--set"]
        again = judged.run(campaign, "", (0, entries), stop)
        assert (again.record.digest, again.ratio, again.aim) == (one["digest"], one["ratio"], one["figure"])


def test_what_a_search_found_is_kept(searched):
    result, folder = searched[2, True]
    (case,) = cases.read(folder / "cases.jsonl")
    assert (case["campaign"], case["figure"], case["ratio"]) == ("small", result["shrunk"]["figure"], result["shrunk"]["ratio"])
    assert f"{case['figure']} = {case['value']:g}," in result["shrunk"]["what"]


@pytest.mark.parametrize("case", cases.read(cases.FILE), ids=lambda case: case["figure"])
def test_no_case_that_a_search_once_found_has_become_worse(case):
    """Of a limit of 0 the figure's value counts; ratios are infinite there."""
    no_ratio = case["ratio"] is None
    stable = [{"name": case["figure"], "limit": 0}] if no_ratio else []
    campaign = definition.Campaign("case", "", case["scenario"], 1, 1, definition.LIMITS, stable, (), (), "")
    found = judged.run(campaign, "", (0, case["entries"]), [])
    assert found.record.status != judged.REFUSED
    if no_ratio:
        assert found.record.stability[0]["value"] <= 1.05 * case["value"], found.text()
    else:
        assert found.ratio <= 1.05 * case["ratio"], found.text()


def test_a_run_that_ends_in_a_fault_has_no_ratio():
    record = Record(0, "", "", ["a=1"], "fault", "joint 2 too fast")
    assert judged.Judged(record).ratio == math.inf and judged.Judged(record).text() == "fault: joint 2 too fast"
    assert hil.MEMORY in judged.Judged(record).line("press_known")
