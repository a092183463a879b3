"""tools/reed tune: the search against planted optima, the rules of reed_config, and a scenario made worse on purpose."""

import json
import math
import tomllib

import pytest
from built import reed

from reed_tools.errors import UsageError
from reed_tools.tune import margins, search, trials, write
from reed_tools.tune.gains import Gains, of_effective
from reed_tools.tune.margins import Margin


START = Gains((("control.K_d", (30.0, 12.0)), ("control.Lambda", 15.0), ("control.force_bandwidth_radps", 30.0)))
WIDE = Margin(10.0, 60.0)


def planted(best: dict[str, float]):
    """A bowl in the logarithms of the gains: its bottom, 0.1, is where each gain is `best` times its start."""
    def score(gains: Gains) -> float:
        off = 0.0
        for (key, value), (_, start) in zip(gains.values, START.values):
            factor = value[0] / start[0] if isinstance(value, tuple) else value / start
            off += math.log(factor / best[key]) ** 2
        return 0.1 + off
    return lambda candidates: [trials.Trial(score(gains), "", ("figure", score(gains))) for gains in candidates]


def improve(judge, margin_of=lambda gains: WIDE):
    told = []
    start = search.Step("as it is", START, WIDE, judge([START])[0], True, 0)
    return search.improve(start, margin_of, judge, told.append), told


def test_the_search_comes_within_one_step_of_a_planted_optimum():
    wanted = {"control.K_d": 1.9, "control.Lambda": 0.6, "control.force_bandwidth_radps": 1.0}
    best, told = improve(planted(wanted))
    for (key, value), (_, start) in zip(best.gains.values, START.values):
        factor = value[0] / start[0] if isinstance(value, tuple) else value / start
        assert abs(math.log(factor / wanted[key])) < math.log(max(1.4, 1.35, 1.5)) / 2 + 0.01, key
    scores = [step.trial.score for step in told if step.taken]
    assert scores == sorted(scores, reverse=True)


def test_the_search_is_the_same_twice_and_stays_where_nothing_is_better():
    wanted = {"control.K_d": 1.4, "control.Lambda": 1.0, "control.force_bandwidth_radps": 2.0}
    assert improve(planted(wanted))[1] == improve(planted(wanted))[1]
    best, told = improve(planted(dict.fromkeys(wanted, 1.0)))
    assert best.gains == START and not any(step.taken for step in told)


def test_gains_beyond_a_rule_are_never_run():
    """K_d may not grow: the planted optimum is out of reach."""
    asked = []

    def margin_of(gains: Gains) -> Margin:
        if dict(gains.values)["control.K_d"][0] > 30.0:
            raise UsageError("too large")
        return WIDE

    judge = planted({"control.K_d": 2.0, "control.Lambda": 1.0, "control.force_bandwidth_radps": 1.0})
    best, told = improve(lambda candidates: asked.extend(candidates) or judge(candidates), margin_of)
    assert best.gains == START and all(dict(gains.values)["control.K_d"][0] <= 30.0 for gains in asked)
    assert sum(step.refused for step in told) >= 1


def test_a_scenario_gets_its_gains_and_keeps_the_rest():
    text = "# mine\narm = \"a5\"\n\n[control]   # gains\nK_d = [\n  1.0,\n  2.0]  # by hand\nLambda = 15.0\n\n[[checks]]\nname = \"faults\"\n"
    found = write.with_gains(text, START)
    assert tomllib.loads(found) == {**tomllib.loads(text), "control": {"K_d": [30.0, 12.0], "Lambda": 15.0, "force_bandwidth_radps": 30.0}}
    assert "# mine" in found and "# by hand" in found and "# gains" in found
    assert tomllib.loads(write.with_gains("arm = \"a5\"\n", START))["control"]["K_d"] == [30.0, 12.0]


def test_only_gains_that_act_are_tuned():
    effective = {"control": {"K_d": [1.0], "Lambda": [2.0], "estimate_wall_stiffness": True, "force_bandwidth_radps": 30.0, "Gamma_known": 5.0,
                             "observer_gain": 80.0, "sigma1_max": 0.4}, "force": {"source": "none", "desired_N": 0.0}}
    assert [key for key, _ in of_effective(effective).values] == ["control.K_d", "control.Lambda", "control.Gamma_known"]
    effective["force"] = {"source": "unknown", "desired_N": 5.0}
    assert [key for key, _ in of_effective(effective).values] == [
        "control.K_d", "control.Lambda", "control.force_bandwidth_radps", "control.observer_gain", "control.sigma1_max"]


def test_margins_are_those_of_the_configuration_and_a_broken_rule_is_its_line():
    found = margins.of("press_known", [])
    assert found.gain > 2.0 and found.phase_deg > 25.0
    assert margins.of("press_known", ["control.K_d=[20.0, 20.0, 12.0, 4.0, 2.0]"]).gain > found.gain
    with pytest.raises(UsageError, match="joint 1"):
        margins.of("press_known", ["control.K_d=[330.0, 30.0, 18.0, 5.5, 3.1]"])


def test_a_scenario_made_worse_is_made_better(tmp_path):
    """press_known with a quarter of its K_d: the worst figure comes down, and the written scenario has what was found."""
    out = tmp_path / "tuned.toml"
    done = reed("tune", "press_known", "--set", "control.K_d=[8.0, 7.5, 4.5, 1.4, 0.8]", "--draws", "1", "--json", "--out", out)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["score"]["after"] < 0.7 * found["score"]["before"]
    assert found["gains"]["control.K_d"][0] > 8.0 and tomllib.loads(out.read_text())["control"]["K_d"] == found["gains"]["control.K_d"]
    again = reed("tune", "press_known", "--out", out)
    assert again.returncode == 2 and "is there already" in again.stderr


def test_an_arm_gets_a_scenario_of_its_own(tmp_path):
    out = tmp_path / "free.toml"
    done = reed("tune", "p2", "--draws", "1", "--out", out)
    assert done.returncode == 0, done.stderr
    found = tomllib.loads(out.read_text())
    assert found["arm"] == "p2" and len(found["control"]["K_d"]) == 2 and found["checks"]


def test_bad_input_is_one_line():
    for words in (["nothing_such"], ["press_known", "--draws", "0"], ["press_known", "--scheduler", "here"],
                  ["press_known", "--set", "control.K_d=[330, 30, 18, 5.5, 3.1]"]):
        done = reed("tune", *words)
        assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr
