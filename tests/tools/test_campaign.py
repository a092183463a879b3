"""Campaigns: draws follow from (seed, index) alone; finished draws are kept; what comes out can be read and repeated."""

import json
import math
import os
import shlex
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as xml
from dataclasses import replace

import pytest

from reed_tools.campaign import definition, draws, plots, verdicts
from reed_tools.campaign.definition import CAMPAIGNS, Drawn
from reed_tools.paths import BUILD, ROOT, SCENARIOS

HEAD = '[campaign]\nname = "small"\nscenario = "{scenario}"\ndraws = 4\nseed = 3\n'
WALL = '[[draw]]\nkey = "wall.stiffness_Npm"\nlog_uniform = [5e3, 20e3]\n'
SEED = '[[draw]]\nkey = "scenario.seed"\ninteger = [1, 1000]\n'


@pytest.fixture
def press_known():
    return definition.load(CAMPAIGNS / "press_known.toml")


def records_in(folder):
    return [json.loads(line) for line in (folder / "draws.jsonl").read_text().splitlines()]


def one_line(done, status):
    assert done.returncode == status, done.stdout + done.stderr
    lines = done.stderr.splitlines()
    assert len(lines) == 1 and lines[0].startswith("reed: "), done.stderr
    return lines[0]


# ---- sampling ----


def test_a_draw_follows_from_seed_and_index_and_not_from_those_before_it(press_known):
    forwards = [press_known.overrides(index) for index in range(20)]
    again = definition.load(CAMPAIGNS / "press_known.toml")
    assert [again.overrides(index) for index in reversed(range(20))] == forwards[::-1]
    assert len({tuple(overrides) for overrides in forwards}) == 20
    assert definition.load(CAMPAIGNS / "press_known.toml", seed=2).overrides(0) != forwards[0]


def test_draws_are_those_of_every_machine():
    """SHA-256 of "1/0/a/0" begins with these 8 bytes: by `printf 1/0/a/0 | sha256sum`."""
    digest = subprocess.run(["sha256sum"], input=b"1/0/a/0", capture_output=True, check=True).stdout.split()[0]
    assert definition.unit_number("1/0/a/0") == int(digest[:16], 16) // 2048 / 2**53


def test_a_number_more_leaves_all_others_as_they_were(press_known):
    more = replace(press_known, drawn=(Drawn("wall.damping_Nspm", "uniform", [0.0, 40.0]), *press_known.drawn))
    for index in range(5):
        before, after = press_known.values(index), more.values(index)
        assert after.pop("wall.damping_Nspm") and after == before


def test_a_value_from_the_command_line_is_drawn_no_more(press_known):
    given = definition.load(CAMPAIGNS / "press_known.toml", extra=("force.desired_N=7",))
    assert [entry for entry in given.overrides(3) if entry.startswith("force.desired_N")] == ["force.desired_N=7"]
    assert {key: value for key, value in press_known.values(3).items() if key != "force.desired_N"} == given.values(3)
    assert given.definition() != press_known.definition()


@pytest.mark.parametrize("distribution, support, middle", [
    ("uniform", [2.0, 4.0], 3.0), ("log_uniform", [0.5, 2.0], 1.0), ("integer", [1, 9], 5), ("choice", [10, 20, 30], 20)])
def test_distributions_fill_their_support_around_its_middle(distribution, support, middle):
    drawn = Drawn("x", distribution, support)
    values = sorted(drawn.value(1, index) for index in range(4001))
    assert support[0] <= values[0] and values[-1] <= support[-1]
    assert values[0] <= support[0] + 0.01 * support[-1] and values[-1] >= 0.99 * support[-1]
    assert values[2000] == pytest.approx(middle, rel=0.05)  # half the draws: 4001 of them leave 0.8 % of the range
    below = sum(value < math.sqrt(support[0] * support[-1]) for value in values) / len(values)
    if distribution == "log_uniform":
        assert below == pytest.approx(0.5, abs=0.03)


def test_entries_of_a_list_are_drawn_each_by_itself(press_known):
    factors = [[value / base for value, base in zip(press_known.values(index)["plant.p_true"], (0.7, 0.15, 0.12, 0.55, 0.4, 0.5))]
               for index in range(300)]
    assert all(0.5 <= factor <= 1.5 for row in factors for factor in row)
    first, second = [row[0] - 1.0 for row in factors], [row[1] - 1.0 for row in factors]
    correlation = sum(a * b for a, b in zip(first, second)) / math.sqrt(sum(a * a for a in first) * sum(b * b for b in second))
    assert abs(correlation) < 0.17  # three standard deviations of 300 independent pairs


def test_a_part_of_the_draws_may_be_asked_for(press_known):
    from reed_tools.campaign.command import selected

    options = {"draws": 23, "first": None, "count": None}
    assert selected(press_known, options) == list(range(23))
    assert selected(press_known, {**options, "first": 7, "count": 3}) == [7, 8, 9]


def test_every_campaign_there_is_draws_what_the_programs_accept(tmp_path):
    """First and last draw of each; the reader refuses unknown keys and numbers out of range."""
    for path in CAMPAIGNS.glob("*.toml"):
        campaign = definition.load(path)
        for index in (0, campaign.draws - 1):
            command = [BUILD / "bin" / "reed_config", "--config", campaign.scenario]
            for entry in campaign.overrides(index):
                command += ["--set", entry]
            done = subprocess.run(command, capture_output=True, text=True, timeout=30)
            assert done.returncode == 0, done.stderr


# ---- judging ----


def record(index, value, limit=10.0, status="finished", digest="d"):
    checks = [{"name": "force", "limit": limit, "value": value, "ok": value is not None and value <= limit},
              {"name": "faults", "limit": 0, "value": 0, "ok": True}]
    return draws.Record(index, "definition", "build", ["scenario.seed=5", "wall.friction=0.2"], status, "", checks, digest=digest)


def test_the_verdict_counts_stable_and_within_and_finds_the_worst(press_known):
    records = [record(k, 5.0) for k in range(97)] + [record(97, 12.0), record(98, 19.0), record(99, 9.0)]
    assert verdicts.judge(press_known, records, []).ok
    stable, within, worst = verdicts.judge(press_known, records, []).lines
    assert (stable.value, within.value, worst.value) == (100.0, 98.0, 1.9)
    assert not verdicts.judge(press_known, [*records[:99], record(99, 21.0)], []).ok
    assert not verdicts.judge(press_known, [*records[:99], record(99, None)], []).ok
    assert not verdicts.judge(press_known, [*records[:99], record(99, 5.0, status="fault")], []).ok
    bouncing = record(99, 5.0)
    bouncing.stability.append({"name": "contact_lost_ms", "limit": 0, "value": 12.0, "ok": False})
    assert not bouncing.stable and bouncing.deciding["name"] == "contact_lost_ms"
    assert not verdicts.judge(press_known, [*records[:99], bouncing], []).ok
    assert not verdicts.judge(press_known, [record(k, 11.0) for k in range(6)] + records[:94], []).ok
    assert [one.index for one in draws.worst_first(records)[:2]] == [98, 97]


def test_a_second_run_with_another_digest_fails_the_campaign(press_known):
    records = [record(k, 5.0) for k in range(4)]
    assert verdicts.judge(press_known, records, [record(2, 5.0)]).ok
    verdict = verdicts.judge(press_known, records, [record(2, 5.0, digest="other")])
    assert not verdict.ok and verdict.different == [2]


def test_a_broken_limit_of_zero_is_worse_than_any_ratio():
    bad = record(0, 5.0)
    bad.checks[1].update(value=1, ok=False)
    assert bad.stable and bad.ratio == math.inf and bad.deciding["name"] == "faults"


# ---- with a stand-in for the program ----


@pytest.fixture
def small(tmp_path):
    """A campaign of four draws whose limits the stand-ins' synthetic figures hold."""
    text = (SCENARIOS / "press_known.toml").read_text()
    scenario = tmp_path / "lenient.toml"
    text = text.replace("duration_s = 3.0", "duration_s = 1.0", 1)  # as long as the stand-ins fly
    scenario.write_text(text[:text.index("[[checks]]")] + '[[checks]]\nname = "force_peak_N_last_second"\nlimit = 100.0\n')
    path = tmp_path / "small.toml"
    path.write_text(HEAD.format(scenario=scenario) + WALL + SEED)
    return path


def test_a_campaign_writes_its_draws_junit_and_page(reed, small, tmp_path):
    folder = tmp_path / "out"
    done = reed("campaign", small, "--jobs", 2, "--repeat", 1, "--out", folder)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "\x1b" not in done.stdout and "4 / 4 draws" in done.stdout and "PASS" in done.stdout
    drawn = records_in(folder)
    assert sorted(one["index"] for one in drawn) == [0, 1, 2, 3]
    suite = xml.parse(folder / "junit.xml").getroot()
    assert (suite.tag, suite.get("tests"), suite.get("failures"), suite.get("errors")) == ("testsuite", "8", "0", "0")
    assert {case.get("name") for case in suite} >= {"draw 0", "draw 3", "worst figure to its limit", "draws run twice are equal"}
    page = (folder / "campaign.html").read_text()
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["verdict"] == "pass" and summary["repeated"] == 1 and len(summary["worst"]) == 4
    for one in drawn:
        assert all(entry in page for entry in one["overrides"] if not entry.startswith("scenario.seed")), one
    assert page.count("tools/reed run") == 4 and page.count("<img") == 2
    again = reed("campaign", "--resume", folder, "--repeat", 0, "--json")  # every draw is there
    found = json.loads(again.stdout)
    assert again.returncode == 0 and found == {"folder": str(folder), **json.loads((folder / "summary.json").read_text())}
    assert found["verdict"] == "pass" and "PASS" in again.stderr
    assert "http" not in page and "src=\"data:image/png;base64," in page


def test_resuming_runs_only_what_is_missing(reed, small, tmp_path):
    folder = tmp_path / "out"
    assert reed("campaign", small, "--count", 2, "--repeat", 0, "--out", folder).returncode == 0
    before = (folder / "draws.jsonl").read_text()
    with open(folder / "draws.jsonl", "a") as file:
        file.write('{"index": 3, "defin')  # the machine stopped while this was written
    done = reed("campaign", "--resume", folder, "--draws", 4, "--repeat", 0)
    assert done.returncode == 0 and "4 draws" in done.stdout and "2 to run" in done.stdout, done.stdout + done.stderr
    assert (folder / "draws.jsonl").read_text().startswith(before)
    assert sorted(one["index"] for one in records_in(folder)) == [0, 1, 2, 3]


def test_an_interrupted_campaign_keeps_its_finished_draws(reed, small, tmp_path):
    folder = tmp_path / "out"
    process = reed.start("campaign", small, "--draws", 40, "--jobs", 1, "--out", folder)
    wait_for_line(folder / "draws.jsonl")
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 1 and f"--resume {folder}" in out and not err, out + err
    kept = len(records_in(folder))
    assert 1 <= kept < 40 and f"interrupted after {kept} of 40" in out
    assert json.loads((folder / "summary.json").read_text())["finished"] == kept


def test_a_program_that_dies_is_status_3_and_its_draw_is_run_again(reed, small, tmp_path):
    folder = tmp_path / "out"
    done = reed("campaign", small, "--count", 1, "--out", folder, REED_FAKE_ONE_PROCESS="die")
    assert "bus lost" in one_line(done, 3)
    suite = xml.parse(folder / "junit.xml").getroot()
    assert suite.get("errors") == "1"
    done = reed("campaign", "--resume", folder, "--repeat", 0)
    assert done.returncode == 0 and "1 to run" in done.stdout, done.stdout + done.stderr


def test_draws_of_another_campaign_and_lines_that_are_no_draw_are_refused(tmp_path):
    draws.append(tmp_path, record(0, 5.0))
    assert [one.index for one in draws.read(tmp_path, "definition")] == [0]
    with pytest.raises(definition.UsageError, match="draws.jsonl:1: a draw of another campaign"):
        draws.read(tmp_path, "another")
    (tmp_path / "draws.jsonl").write_text('{"index": 3}\n')
    with pytest.raises(definition.UsageError, match="draws.jsonl:1: not a draw"):
        draws.read(tmp_path, "definition")


@pytest.mark.parametrize("argv, told", [
    (["nowhere"], "press_known"),
    (["--draws", "0"], "whole number"),
    (["--from", "200"], "--from 200"),
    (["--jobs", "-1"], "--jobs"),
    (["--draws", "1000000000000"], "--draws 1000000000000: allowed: a whole number from 1 to 1000000"),
    (["--count", "1000000000000"], "--count"),
    (["--jobs", "99999"], "--jobs"),
    (["--scheduler", "nowhere"], "--scheduler nowhere: allowed: tcp://HOST:PORT"),
    (["--scheduler", "tcp://127.0.0.1:99999"], "allowed: tcp://HOST:PORT"),
    (["--scheduler", "tcp://127.0.0.1:1"], "--scheduler tcp://127.0.0.1:1: no Dask scheduler answers there"),
    (["--scheduler", "tcp://127.0.0.1:1", "--jobs", "2"], "not allowed with"),
    (["--resume", "/nowhere"], "/nowhere"),
    (["--set", "wall.stifness_Npm=1"], "stiffness_Npm"),
    (["--out", "/proc/nowhere"], "/proc/nowhere"),
    (["--bogus"], "--bogus"),
])
def test_bad_input_is_one_line_and_status_2(reed, tmp_path, argv, told):
    place = [] if "--out" in argv or "--resume" in argv else ["--out", tmp_path / "out"]
    assert told in one_line(reed("campaign", *argv, *place), 2)


@pytest.mark.parametrize("text, told", [
    ("[campaign]\nname = 1", "scenario"),
    (HEAD.format(scenario="x").replace("draws = 4", "draws = 0"), "campaign.draws"),
    (HEAD.format(scenario="x") + "colour = 1\n", "campaign.colour"),
    (HEAD.format(scenario="x") + "[stable]\nbeauty = 1\n", "stable.beauty"),
    (HEAD.format(scenario="x") + '[[draw]]\nkey = "a"\n', "uniform"),
    (HEAD.format(scenario="x") + '[[draw]]\nkey = "a"\nuniform = [2, 1]\n', "low < high"),
    (HEAD.format(scenario="x") + '[[draw]]\nkey = "a"\nlog_uniform = [0, 1]\n', "0 < low"),
    (HEAD.format(scenario="x") + '[[draw]]\nkey = "a"\nchoice = ["b"]\ntimes = 2\n', "multiplies"),
    ("campaign", "not TOML"),
    ("# gr\xfcn\n" + HEAD.format(scenario="x"), "not TOML: .*utf-8"),
    ("a = " + "[" * 30000, "not TOML"),
    ("a = " + "9" * 5000, "not TOML"),
    ("campaign = 3\n", "campaign: expected a table"),
    ("limits = [1]\n" + HEAD.format(scenario="x"), "limits: expected a table"),
    ("draw = 3\n" + HEAD.format(scenario="x"), "draw: expected"),
    ("draw = [3]\n" + HEAD.format(scenario="x"), "draw: expected"),
    ("set = 'a'\n" + HEAD.format(scenario="x"), "set: expected a table"),
    (HEAD.format(scenario="x") + "[set]\nwall.friction = 0.2\n", 'quotes, like "wall.friction" = 0.2'),
    (HEAD.format(scenario="x").replace('"small"', "3"), "campaign.name = 3: expected text"),
    (HEAD.format(scenario="x").replace('"small"', r'"a\u0007"'), "campaign.name"),
    (HEAD.format(scenario="x").replace('"x"', "[1]"), "campaign.scenario"),
    (HEAD.format(scenario="x") + "description = 3\n", "campaign.description"),
    (HEAD.format(scenario="x").replace("draws = 4", "draws = 1000001"), "campaign.draws = 1000001: .* to 1000000"),
    (HEAD.format(scenario="x").replace("seed = 3", "seed = -1"), "campaign.seed"),
    (HEAD.format(scenario="x") + "[limits]\nworst_ratio = " + "9" * 400 + "\n", "limits.worst_ratio"),
    (HEAD.format(scenario="x") + '[[draw]]\nkey = "a"\ninteger = [0, ' + "9" * 400 + "]\n", "integer"),
])
def test_a_bad_campaign_file_is_refused_with_its_key(tmp_path, text, told):
    path = tmp_path / "bad.toml"
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(definition.UsageError, match=told):
        definition.load(path)


def test_a_description_may_have_lines(tmp_path):
    path = tmp_path / "good.toml"
    path.write_text(HEAD.format(scenario="x") + 'description = """one\ntwo"""\n')
    assert definition.load(path).description == "one\ntwo"
    path.write_text(HEAD.format(scenario="x") + 'description = "one\\u001btwo"\n')
    with pytest.raises(definition.UsageError, match="campaign.description = .*without control characters"):
        definition.load(path)


@pytest.mark.parametrize("damage", [b"", b"{", b"[]", b"{}", b"\xff\xfe", b"[" * 50000, b'{"draws": "4"}', b'{"draws": true}',
                                    b'{"seed": -1}', b'{"set": "a=b"}', b'{"set": [3]}', b'{"count": 1000000000000}'])
def test_damaged_options_are_one_line(reed, tmp_path, damage):
    good = {"seed": None, "set": [], "draws": None, "first": None, "count": None}
    (tmp_path / "campaign.toml").write_text(HEAD.format(scenario="press_known"))
    try:
        changed = json.loads(damage)
        content = json.dumps({**good, **changed}).encode() if changed else damage
    except (ValueError, TypeError, RecursionError):
        content = damage
    (tmp_path / "options.json").write_bytes(content)
    assert "options.json: damaged" in one_line(reed("campaign", "--resume", tmp_path), 2)


@pytest.mark.parametrize("line", [b"\xff", b"3", b"[" * 50000, b'{"index": "0"}', b'{"checks": [3]}', b'{"checks": [{"name": "a"}]}',
                                  b'{"overrides": ["a"]}', b'{"overrides": "a=b"}', b'{"message": 3}', b'{"colour": 3}'])
def test_damaged_draws_are_one_line(tmp_path, line):
    draws.append(tmp_path, record(0, 5.0))
    good = json.loads((tmp_path / "draws.jsonl").read_text())
    try:
        line = json.dumps({**good, **json.loads(line)}).encode()
    except (ValueError, TypeError, RecursionError):
        pass
    with open(tmp_path / "draws.jsonl", "ab") as file:
        file.write(line + b"\n")
    with pytest.raises(definition.UsageError, match="draws.jsonl:2: not a draw"):
        draws.read(tmp_path, "definition")


def test_what_a_file_says_is_text_in_page_and_junit(reed, small, tmp_path):
    """A description with markup, and a seed that is none, reach neither HTML nor XML as such."""
    small.write_text(small.read_text().replace('name = "small"', 'name = "<i>&small"').replace(
        WALL, WALL + '[set]\n"scenario.description" = "<script>alert(1)</script> --seed <b>9</b> [/nope]"\n'))
    done = reed("campaign", small, "--count", 1, "--repeat", 0, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stdout + done.stderr
    page = (tmp_path / "out" / "campaign.html").read_text()
    assert "<script>" not in page and "<b>9" not in page and "<i>" not in page and "&lt;script&gt;" in page
    assert "\x1b" not in done.stdout and "[/nope]" in done.stdout
    assert "<script>alert(1)" in xml.parse(tmp_path / "out" / "junit.xml").getroot()[-1].find("system-out").text


# ---- with the programs themselves ----


def test_a_real_campaign_passes_and_its_worst_draw_repeats_bit_by_bit(tmp_path):
    folder = tmp_path / "out"
    done = call("campaign", "press_known", "--draws", "4", "--repeat", "0", "--out", folder)
    assert done.returncode == 0, done.stdout + done.stderr
    worst = json.loads((folder / "summary.json").read_text())["worst"][0]
    words = shlex.split(worst["command"])
    assert words[:2] == ["tools/reed", "run"]
    call(*words[1:], "--bus", "memory", "--out", tmp_path / "again")
    assert json.loads((tmp_path / "again" / "summary.json").read_text())["digest"] == worst["digest"]


def call(*argv):
    environment = {**os.environ, "REED_BUILD_DIR": str(BUILD), "PYTHONPATH": str(ROOT / "tools")}
    return subprocess.run([sys.executable, "-m", "reed_tools", *map(str, argv)], env=environment, capture_output=True, text=True,
                          timeout=120)


def wait_for_line(path):
    deadline = time.monotonic() + 60
    while not (path.exists() and path.read_text().endswith("\n")):
        assert time.monotonic() < deadline
        time.sleep(0.05)


def test_drawn_entries_have_the_names_of_what_they_belong_to():
    arm = {"param_names": ["m2", "bv"], "dh": [[0.0]] * 3, "param_shapes": [{"param": "m2", "mass": 1.0}, {"param": "bv", "viscous_weights": [1.0]}]}
    assert plots.entry_name("plant.p_true", 0, arm) == "plant.p_true: m2 [kg]"
    assert plots.entry_name("plant.p_true", 1, arm) == "plant.p_true: bv [N·m·s/rad]"
    assert plots.entry_name("arm.coulomb", 2, arm) == "arm.coulomb: joint 3"
