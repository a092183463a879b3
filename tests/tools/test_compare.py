"""tools/reed compare: what differs between runs, or campaigns, and nothing else."""

import json

import pytest
import synthetic_run as synthetic

from reed_tools.compare import command, figures
from reed_tools.errors import UsageError
from reed_tools.record import run_folder


@pytest.fixture
def two(tmp_path, monkeypatch):
    synthetic.write(tmp_path / "one", [("impact_peak_N", 10.0)])
    monkeypatch.setattr(synthetic, "IMPACT_N", 12.0)
    monkeypatch.setattr(synthetic, "EFFECTIVE", synthetic.EFFECTIVE.replace("seed = 7", "seed = 8"))
    synthetic.write(tmp_path / "two", [("impact_peak_N", 10.0)])
    for name in ("one", "two"):
        run_folder.complete(tmp_path / name)
    return [tmp_path / "one", tmp_path / "two"]


def compare(folders, as_json=True, out=None):
    class Arguments:
        json = as_json

    Arguments.folders, Arguments.out = list(folders), out
    return command.run(Arguments)


def test_only_what_differs_is_listed_verdict_first(two, capsys):
    assert compare(two) == 0
    said = json.loads(capsys.readouterr().out)
    assert said["runs"] == list(map(str, two))
    found = {entry["figure"]: entry["values"] for entry in said["differences"]}
    assert list(found)[:3] == ["verdict", "cause", "digest"]
    assert found["verdict"] == ["pass", "fail"] and found["config.scenario.seed"] == [7, 8]
    assert found["checks.impact_peak_N"] == [9.0, 12.0]
    assert set(found) == {"verdict", "cause", "digest", "config.scenario.seed", "checks.impact_peak_N"}


def test_a_run_does_not_differ_from_itself(two, capsys):
    compare([two[0], two[0], two[0]])
    assert json.loads(capsys.readouterr().out)["differences"] == []


def test_the_page_has_differences_curves_and_checks(two, capsys, tmp_path):
    assert compare(two, as_json=False, out=tmp_path / "page") == 0
    said = capsys.readouterr().out
    assert "checks.impact_peak_N" in said and "one" in said and "two" in said
    page = (tmp_path / "page" / "compare.html").read_text()
    order = [page.index(f"<h2>{title}</h2>") for title in ("Differences", "Curves", "Checks")]
    assert order == sorted(order) and page.count("data:image/png;base64,") == 1 and "http" not in page
    assert "<td>config.scenario.seed</td><td>7</td><td>8</td>" in page


def test_runs_of_other_arms_and_lengths_have_none_where_they_have_nothing():
    one = {"a": 1.0, "b": [1, 2]}
    assert figures.differences([one, {"a": 1.0, "c": 3}], repeatable=True) == \
        [figures.Difference("b", [[1, 2], None]), figures.Difference("c", [None, 3])]


def test_what_no_repetition_keeps_counts_on_the_clock_only():
    pair = [{"timing_us.rx.p50": 1.0, "wall_s": 3.0, "overruns": 0}, {"timing_us.rx.p50": 2.0, "wall_s": 4.0, "overruns": 1}]
    assert [entry.figure for entry in figures.differences(pair, repeatable=True)] == ["overruns"]
    assert len(figures.differences(pair, repeatable=False)) == 3


def test_tables_are_named_by_their_keys_and_their_names():
    assert figures.flat({"a": {"b": 1}, "c": [{"name": "x", "v": 2}, {"v": 3}], "d": [1, 2]}, "") == \
        {"a.b": 1, "c.x.name": "x", "c.x.v": 2, "c.1.v": 3, "d": [1, 2]}


@pytest.mark.parametrize("value, text", [(None, "–"), (8, "8"), (1.23456, "1.235"), (True, "True"), ([0.5, [1, 2]], "[0.5, [1, 2]]"),
                                         ("a" * 64, "a" * 23 + "…"), ("a sentence of some length that says why", "a sentence of some length that says why")])
def test_values_in_tables_are_short(value, text):
    assert figures.in_short(value) == text


def campaign(folder, worst):
    folder.mkdir()
    (folder / "campaign.toml").write_text("")
    (folder / "summary.json").write_text(json.dumps({"schema": 1, "campaign": "c", "verdict": "pass", "worst": [],
                                                     "figures": [{"name": "impact_peak_N", "worst": worst, "median": 4.0}]}))
    return folder


def test_campaigns_are_compared_by_their_distributions(tmp_path, capsys):
    compare([campaign(tmp_path / "a", 5.0), campaign(tmp_path / "b", 6.0)])
    assert json.loads(capsys.readouterr().out)["differences"] == [{"figure": "figures.impact_peak_N.worst", "values": [5.0, 6.0]}]


def test_wrong_folders_are_one_line(two, tmp_path):
    with pytest.raises(UsageError, match="two or more folders are needed"):
        compare(two[:1])
    with pytest.raises(UsageError, match="is neither a run nor a campaign"):
        compare([two[0], tmp_path])
    with pytest.raises(UsageError, match="runs go with runs"):
        compare([two[0], campaign(tmp_path / "c", 1.0)])
    (two[1] / "telemetry.lcmlog").write_bytes(b"")
    with pytest.raises(UsageError, match="telemetry.lcmlog is damaged"):
        compare(two)


def test_folders_of_one_name_are_told_apart_by_their_path(tmp_path):
    assert command.labels([tmp_path / "a" / "run", tmp_path / "b" / "run"]) == [str(tmp_path / "a" / "run"), str(tmp_path / "b" / "run")]
    assert command.labels([tmp_path / "a", tmp_path / "b"]) == ["a", "b"]
