"""tools/reed paper: phases, windows and comparison on synthetic runs, the cache with stand-ins, and one small real run."""

import html.parser
import json
import re

import numpy as np
import pytest
import synthetic_signals as synthetic

from reed_tools import cli, paths
from reed_tools.engine.engine import Engine
from reed_tools.errors import RunError, UsageError
from reed_tools.paper import catalogue, command, page, phases, runs
from reed_tools.paper.catalogue import Experiment

N = 3000
T = np.arange(N) * 1e-3


def pressing(force, desired=8.0, **changed):
    """Contact at 0.4 s, desired force from then on."""
    wanted = np.where(T >= 0.4, desired, 0.0)
    return synthetic.run("known", "separated", n=N, force_desired=wanted, force_true=np.where(T >= 0.4, force(T), 0.0), **changed)


# rising to 12 N at 0.5 s, decreasing to 8 N with 0.2 s, rippling by 0.1 N
def textbook(t):
    return np.where(t < 0.5, 120.0 * (t - 0.4), 8.0 + 4.0 * np.exp(-(t - 0.5) / 0.2) + 0.1 * np.sin(40.0 * t))


def test_the_three_phases_are_those_of_a_textbook_course():
    signals, _ = pressing(textbook)
    seen = phases.phases(signals)
    assert (seen.contact_s, seen.peak_s) == (pytest.approx(0.401, abs=2e-3), pytest.approx(0.5, abs=5e-3))
    assert seen.peak_N == pytest.approx(12.09, abs=0.05)
    # 4 exp(-x/0.2) = 0.4 at x = 0.46; the ripple shifts it by less than 0.06 s
    assert seen.stable_s == pytest.approx(0.96, abs=0.06)
    assert 0.07 < seen.stable_rms_N < 0.12


def test_a_force_that_comes_from_below_has_no_decreasing_phase():
    """Later ripple inside the band is no peak."""
    signals, _ = pressing(lambda t: np.where(t < 1.0, 8.0 * (t - 0.4) / 0.6, 8.0 + 0.2 * np.sin(9.0 * t)))
    seen = phases.phases(signals)
    assert seen.stable_s == pytest.approx(0.4 + 0.95 * 0.6, abs=3e-3)
    assert seen.peak_s == pytest.approx(seen.stable_s, abs=2e-3) and seen.peak_N == pytest.approx(7.6, abs=0.02)


def test_a_force_that_leaves_the_band_at_the_end_never_was_stable():
    signals, _ = pressing(lambda t: np.where(t > 2.9, 9.0, 8.0))
    seen = phases.phases(signals)
    assert seen.stable_s is None and seen.stable_rms_N is None


def test_an_arm_that_never_touched_has_no_phases():
    signals, _ = pressing(lambda t: 0.0 * t)
    assert phases.phases(signals) is None


def test_seconds_that_a_stopped_arm_did_not_finish_have_no_figures():
    error = np.full((1500, 5), 2e-3)
    signals, _ = synthetic.run("unknown", "pd", n=1500, joint_error=error)
    assert phases.joint_by_second(signals, 1000.0, tangential=False) == [pytest.approx(2.0), None, None]
    assert phases.force_by_second(signals, 1000.0) == [None, None, None]


@pytest.mark.parametrize("value, best, text", [(3.0, 1.0, "3×"), (0.5, 1.0, "0.5×"), (None, 1.0, "stopped"), (1.0, None, "–")])
def test_how_many_times_worse(value, best, text):
    assert phases.times(value, best) == text


def result(key, law, mrad, n=N, stopped=None):
    scale = np.full((n, 5), mrad * 1e-3)
    signals, effective = synthetic.run("known" if key.startswith("known") else "unknown", law, n=n, joint_error=scale, tangential_joint=scale,
                                       force_desired=np.full(n, 8.0), force_true=np.full(n, 8.0 - mrad), s=0.01 * scale,
                                       eta_hat=np.full((n, 6), 0.1), has_wall=key.startswith("known"))
    return runs.Result(Experiment(key, f"law of {key}", "press_known"), effective, signals, stopped)


def some_results():
    everything = []
    for experiment in catalogue.everything():
        group, law = experiment.key.split("/")
        law = "separated" if law == "observer" else law
        mrad = {"separated": 1.0, "pd": 5.0, "pd_tuned": 0.5}.get(law, 2.0)
        stopped = "joint 2 too fast" if law == "paper_printed" else None
        one = result(experiment.key, law, mrad, n=700 if stopped else N, stopped=stopped)
        everything.append(runs.Result(experiment, one.effective, one.signals, stopped))
    return everything


def cells(table):
    return [re.sub(r"<[^>]+>", "", cell) for cell in re.findall(r"<td[^>]*>(.*?)</td>", table)]


def test_the_comparison_shows_a_law_that_loses_losing_and_one_that_wins_winning():
    table = page.comparison([r for r in some_results() if r.experiment.key.startswith("known/")], with_force=True)
    rows = {row[0]: row for row in (cells(row) for row in table.split("\n")) if row}
    assert rows["PD(10,5)"][1:5] == ["5", "5", "5", "5×"]
    assert rows["tuned PD"][4] == "0.5×" and rows["separated"][4] == "1×"
    assert '<span class="better">0.5×</span>' in table and '<span class="worse">5×</span>' in table
    assert rows["paper, as printed"][1:5] == ["–", "–", "–", "stopped"]
    assert "stopped at 0.70 s: joint 2 too fast" in rows["paper, as printed"][-1]


class Outside(html.parser.HTMLParser):
    """Everything a browser would have to fetch, and what it may follow."""

    def __init__(self):
        super().__init__()
        self.found, self.links, self.pictures = [], [], 0

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if tag == "a" and name == "href":
                self.links.append(value)
            elif name in ("src", "href"):
                self.pictures += value.startswith("data:image/png;base64,")
                if not value.startswith("data:"):
                    self.found.append(value)


def test_the_page_has_a_panel_per_figure_every_law_and_needs_nothing_from_outside(tmp_path):
    text = page.write(tmp_path, some_results()).read_text()
    outside = Outside()
    outside.feed(text)
    assert outside.found == [] and outside.pictures == 11
    assert outside.links and all((tmp_path / link).is_file() for link in outside.links if not link.startswith("#"))
    for figure in range(9, 18):
        assert f'id="figure{figure}"' in text
        assert (tmp_path / f"figure{figure}.png").stat().st_size > 5000
    for experiment in catalogue.everything():
        assert experiment.law in text


def test_json_has_the_last_second_of_every_experiment(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(command, "CACHE", tmp_path / "cache")
    monkeypatch.setattr(runs, "run_all", lambda *_: some_results())
    monkeypatch.setattr(page, "write", lambda folder, results: folder / "paper.html")
    assert cli.main(["paper", "--json", "--out", str(tmp_path / "out")]) == 0
    said = capsys.readouterr()
    found = json.loads(said.out)
    assert found["page"] == str(tmp_path / "out" / "paper.html") and len(found["experiments"]) == len(catalogue.everything())
    rows = {(row["experiment"], row["law"]): row for row in found["experiments"]}
    pd = next(row for (group, law), row in rows.items() if group == "known" and law == "PD(10,5)")
    assert round(pd["joint_rms_mrad"], 6) == 5.0 and pd["stopped_at_s"] is None
    printed = next(row for row in found["experiments"] if row["stopped_at_s"] is not None)
    assert printed["joint_rms_mrad"] is None and abs(printed["stopped_at_s"] - 0.7) < 0.01
    assert "last second, 2-3 s" in said.err and "stopped at 0.70 s" in said.err


def test_experiments_have_names_of_their_own_and_sound_configurations(tmp_path):
    experiments = catalogue.everything()
    assert len({experiment.key for experiment in experiments}) == len(experiments)
    folders = runs.prepare(experiments, tmp_path)
    assert len(set(folders.values())) == len(experiments)
    for experiment in experiments:
        effective = runs.configuration.load(folders[experiment.key] / "effective.toml")
        assert effective["scenario"]["duration_s"] == catalogue.DURATION_S
        if not experiment.key.endswith("observer"):
            assert effective["control"]["law"] == experiment.key.split("/")[1]


def test_fixed_nominal_parameters_get_the_force_loop_and_the_gains_of_separated(tmp_path):
    pair = [e for e in catalogue.known() if e.key in ("known/fixed_nominal", "known/separated")]
    folders = runs.prepare(pair, tmp_path)
    fixed, separated = (runs.configuration.load(folders[e.key] / "effective.toml")["control"] for e in pair)
    differ = {key for key in separated if fixed[key] != separated[key]}
    assert differ == {"law", "normal_speed_limit_mps"} and fixed["normal_speed_limit_mps"] > separated["normal_speed_limit_mps"]


@pytest.fixture
def stand_ins(fake_build, monkeypatch):
    monkeypatch.setattr(paths, "BUILD", fake_build)
    monkeypatch.setenv("REED_BUILD_DIR", str(fake_build))


def short(key, *overrides):
    experiment = Experiment(key, key, "press_known", overrides)
    return experiment


def run_all(experiments, cache):
    told = []
    results = runs.run_all(lambda: Engine(1), experiments, cache, lambda event, experiment, seconds: told.append((event, experiment.key)))
    return results, told


def test_what_ran_before_is_kept_and_what_changed_runs(stand_ins, tmp_path):
    pair = [short("one"), short("two", "force.desired_N=9")]
    results, told = run_all(pair, tmp_path)
    assert sorted(told) == [("done", "one"), ("done", "two")]
    assert [r.experiment.key for r in results] == ["one", "two"] and len(results[0].signals.t) == 1000
    again, told = run_all([*pair, short("three", "force.desired_N=7")], tmp_path)
    assert told == [("kept", "one"), ("kept", "two"), ("done", "three")]
    np.testing.assert_array_equal(again[0].signals.joint_error, results[0].signals.joint_error)
    assert not list(tmp_path.glob("*/*.lcmlog"))


def test_a_program_that_dies_ends_the_command_with_its_words(stand_ins, tmp_path, monkeypatch):
    monkeypatch.setenv("REED_FAKE_ONE_PROCESS", "die")
    with pytest.raises(RunError, match="one: .*bus lost"):
        run_all([short("one")], tmp_path)
    monkeypatch.delenv("REED_FAKE_ONE_PROCESS")
    assert run_all([short("one")], tmp_path)[1] == [("done", "one")]


def test_a_wrong_configuration_is_refused_before_anything_runs(stand_ins, tmp_path):
    with pytest.raises(UsageError, match="control.k_i"):
        run_all([short("one"), short("two", "control.k_i=99")], tmp_path)
    assert not list(tmp_path.glob("*/signals.npz"))


def test_a_small_real_run_gives_the_signals_of_a_pressing_arm(tmp_path, monkeypatch):
    monkeypatch.setattr(catalogue, "DURATION_S", 0.7)
    (one,), told = run_all([short("press")], tmp_path)
    assert told == [("done", "press")]
    assert one.stopped is None and one.signals.dof == 5
    assert 0.69 < one.signals.t[-1] < 0.71
    assert one.signals.force_true.max() > 1.0 and one.signals.stiffness.min() > 1000.0


def test_bad_numbers_of_jobs_are_refused():
    class Arguments:
        out, jobs, scheduler, fresh = None, 0, None, False

    with pytest.raises(UsageError, match="--jobs 0"):
        command.run(Arguments)
