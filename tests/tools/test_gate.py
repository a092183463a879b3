"""tools/reed gate: the corpus covers what it promises, the same version is silent, a changed one is found unless a commit says so."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

from reed_tools import cli
from reed_tools.errors import UsageError
from reed_tools.gate import command, commits, corpus, kept, quick, trial, versions_built
from reed_tools.paths import BUILD, build
from reed_tools.record import tape
from reed_tools.run import joints

BASE, HEAD = "b" * 40, "a" * 40


@pytest.fixture(scope="module", autouse=True)
def built():
    build("reed_replay", "reed_one_process")


@pytest.fixture
def gate(monkeypatch, capsys):
    """gate(head=FOLDER, declared=[…], *words): with programs that are built already instead of commits."""

    def call(*words, head=BUILD / "bin", declared=()):
        monkeypatch.setattr(commits, "resolve", lambda name: BASE if name == "base" else HEAD)
        monkeypatch.setattr(commits, "require_clean", lambda: None)
        monkeypatch.setattr(commits, "declared", lambda base, head: list(declared))
        monkeypatch.setattr(versions_built, "programs", lambda commit, joints: BUILD / "bin" if commit == BASE else head)
        status = cli.main(["gate", "base", *words])
        said = capsys.readouterr()
        assert not said.err, said.err
        return status, said.out

    return call


@pytest.fixture
def changed(tmp_path):
    """Another version: its Lambda is a little smaller."""
    for name in ("reed_one_process", "reed_replay"):
        (tmp_path / name).write_text(f'#!/bin/sh\nexec {BUILD}/bin/{name} "$@" --set control.Lambda=14.5\n')
        (tmp_path / name).chmod(0o755)
    return tmp_path


def test_the_corpus_covers_what_it_promises(tmp_path):
    """Numbers of joints that this build has not are left to a build that has them."""
    known, seen = corpus.load(), corpus.Seen()
    assert 18 <= len(known.tapes) <= 25 and len({entry.name for entry in known.tapes}) == len(known.tapes)
    assert known.coverage["joints"] == list(joints.POSSIBLE) and known.coverage["modes"] == [0, 1, 2, 3]
    without = {f"joints{number}" for number in joints.POSSIBLE if number not in joints.built()}
    for entry in known.tapes:
        if entry.name not in without:
            result = trial.open_loop(BUILD / "bin", BUILD / "bin", entry, tmp_path)
            assert result.changed == [], entry.name
            assert 100 < len(result.recorded) < 3000, "a tape shows one thing"
            seen.add(result.recorded)
    assert set(seen.lacks(known.coverage)) == {name.replace("joints", "joints ") for name in without}


def test_no_more_numbers_of_joints_are_built_than_are_needed(tmp_path):
    known = corpus.load()
    assert {entry.name: entry.joints for entry in known.tapes if entry.name.startswith("joints")} == {f"joints{n}": n for n in (2, 3, 4, 6, 7, 8)}
    assert command.joints_of([entry for entry in known.tapes if entry.scenario in ("press_known", "joints2")], known) == [2, 5]
    assert command.joints_of(known.tapes, known) == known.coverage["joints"]
    assert command.joints_of([corpus.Entry("x", "of another version")], known) == known.coverage["joints"]
    (tmp_path / "CMakeCache.txt").write_text("REED_JOINTS:STRING=5;7\n")
    assert versions_built.with_those_before(tmp_path, [2, 5]) == "2;5;7"
    assert versions_built.with_those_before(tmp_path / "none", [2]) == "2"


def test_what_the_tapes_do_not_show_is_named():
    seen = corpus.Seen(modes={0, 1, 2}, laws={"pd"})
    assert seen.lacks({"modes": [0, 3], "laws": ["pd", "separated"]}) == ["modes 3", "laws separated"]


def test_the_same_version_is_silent(gate):
    status, said = gate("--only", "joints2")
    assert status == 0 and said == "same to the bit: tapes in open loop: 1, scenarios in closed loop: 1\n"
    status, said = gate("--only", "law_pd", "--json")
    found = json.loads(said)
    assert status == 0 and found == {"base": BASE, "head": HEAD, "tapes": 2, "scenarios": 0, "changed": [], "declared": [], "not_covered": []}


def test_a_change_that_no_commit_declares_fails_and_is_shown_signal_by_signal(gate, changed):
    status, said = gate("--only", "joints2", head=changed)
    assert status == 1 and "control.tau_law_j1" in said and "changed: 2 of 2 (" in said
    assert "no commit in between says `changes-control: why`" in said
    status, said = gate("--only", "joints2", "--json", head=changed)
    found = json.loads(said)["changed"]
    assert status == 1 and {one["tape"] for one in found} == {"joints2"} and {one["kind"] for one in found} == {"tape", "scenario"}
    law = next(one for one in found if one["kind"] == "tape" and one["signal"] == "control.s_j1")
    assert law["first_cycle"] >= 0 and 0 < law["largest"] < 1.0
    assert not any(one["signal"].startswith("measured.") for one in found if one["kind"] == "tape"), "open loop: the measurements are the tape's"
    assert any(one["signal"].startswith("measured.") for one in found if one["kind"] == "scenario"), "closed loop: the arm moves otherwise"


def test_a_change_that_a_commit_declares_passes(gate, changed):
    status, said = gate("--only", "joints2", head=changed, declared=["a softer surface"])
    assert status == 0 and "declared: a softer surface" in said and "control.tau_law_j1" in said


def test_a_version_that_refuses_a_scenario_has_changed(gate, tmp_path):
    for name in ("reed_one_process", "reed_replay"):
        (tmp_path / name).write_text("#!/bin/sh\necho 'odd: control.K_d: is gone' >&2\nexit 2\n")
        (tmp_path / name).chmod(0o755)
    status, said = gate("--only", "joints2", head=tmp_path)
    assert status == 1 and said.count("configuration") == 2


def test_coverage_is_asserted_on_the_whole_corpus(monkeypatch, gate):
    entry = next(one for one in corpus.load().tapes if one.name == "joints2")
    monkeypatch.setattr(corpus, "load", lambda: corpus.Corpus([entry], {"joints": [2], "modes": [2, 3]}, 0.2))
    monkeypatch.setattr(corpus, "scenarios", lambda longest_s: [])
    status, said = gate()
    assert status == 1 and "the tapes do not cover what config/gate/corpus.toml promises: modes 3" in said


@pytest.fixture
def repository(tmp_path, monkeypatch):
    """A small one, with the messages of its commits."""
    def git(*words):
        subprocess.run(["git", "-C", str(tmp_path), "-c", "user.name=t", "-c", "user.email=t@t", *words], check=True, capture_output=True)

    git("init", "-q")
    (tmp_path / "file").write_text("one")
    git("add", "file")
    for message in ("first", "second\n\nchanges-control: more damping", "third\n\nno changes-control: in the middle of a line",
                    "fourth\n\nChanges-Control:   two reasons  \nchanges-control:\n"):
        git("commit", "-q", "--allow-empty", "-m", message)
    monkeypatch.setattr(commits, "ROOT", tmp_path)
    monkeypatch.setattr(versions_built, "CACHE", tmp_path / "build" / "gate")
    return tmp_path


def test_declarations_are_lines_of_the_messages_in_between(repository):
    assert [line.strip() for line in commits.declared("HEAD~3", "HEAD")] == ["two reasons", "more damping"]
    assert commits.declared("HEAD~2", "HEAD~1") == [] and commits.declared("HEAD", "HEAD") == []
    assert len(commits.resolve("HEAD~1")) == 40


def test_bad_input_is_one_line(repository, capsys):
    assert cli.main(["gate", "nowhere"]) == 2
    assert "`nowhere` is no commit of" in capsys.readouterr().err
    assert cli.main(["gate", "--", "-x"]) == 2
    assert "`-x` is no commit of" in capsys.readouterr().err
    (repository / "file").write_text("two")
    assert cli.main(["gate", "HEAD~1"]) == 2
    problem = capsys.readouterr().err
    assert "the working tree is not clean (file)" in problem and "tools/reed gate BASE HEAD" in problem and problem.count("\n") == 1
    assert cli.main(["gate", "HEAD~1", "HEAD"]) == 2
    assert "has no reed_replay" in capsys.readouterr().err
    assert cli.main(["gate", "HEAD~1", "HEAD", "--jobs", "0"]) == 2
    assert cli.main(["gate", "HEAD~1", "HEAD", "--only", "nothing like this"]) == 2
    assert "no tape and no scenario has this in its name" in capsys.readouterr().err


def test_the_base_is_where_head_left_main_else_the_commit_before(repository, tmp_path):
    def git(*words):
        return subprocess.run(["git", "-C", str(repository), "-c", "user.name=t", "-c", "user.email=t@t", *words], check=True, capture_output=True, text=True).stdout.strip()

    git("branch", "-M", "main")
    assert commits.last_of_main() == git("rev-parse", "HEAD~1")
    git("checkout", "-q", "-b", "topic", "HEAD~2")
    git("commit", "-q", "--allow-empty", "-m", "one")
    git("commit", "-q", "--allow-empty", "-m", "two")
    assert commits.last_of_main() == git("rev-parse", "main~2")
    git("checkout", "-q", "--detach")
    git("branch", "-D", "main", "topic")
    assert commits.last_of_main() == git("rev-parse", "HEAD~1"), "no branch at all"
    git("update-ref", "refs/remotes/origin/main", "HEAD~2")
    assert commits.last_of_main() == git("rev-parse", "HEAD~2")


def test_a_clone_without_a_commit_before_says_so(repository, tmp_path, monkeypatch, capsys):
    shallow = tmp_path / "shallow"
    subprocess.run(["git", "clone", "-q", "--depth", "1", f"file://{repository}", str(shallow)], check=True, capture_output=True)
    monkeypatch.setattr(commits, "ROOT", shallow)
    assert commits.last_of_main() is None
    assert cli.main(["gate"]) == 2
    assert "BASE is missing, and this clone has no commit before HEAD (a shallow clone: `git fetch --deepen 1`)" in capsys.readouterr().err
    monkeypatch.setattr(quick, "record_all", lambda entries, jobs: {})
    monkeypatch.setattr(corpus, "load", lambda: corpus.Corpus([], {}, 1.0))
    assert cli.main(["gate", "--quick"]) == 0
    assert "not compared with a base: this clone has no commit before HEAD" in capsys.readouterr().out


def made(values, extra=(), events=()) -> tape.Tape:
    """A tape in memory: control.tau of one joint, and further signals."""
    names = ["num_events", "control.tau", *extra]
    header = tape.Header({"joints": "1"}, [tape.Field(name, name != "num_events", "f8" if name != "num_events" else "i4", 1) for name in names], "")
    rows = np.zeros(len(values), header.layout())
    rows["control.tau"][:, 0] = values
    rest = [b""] * len(values)
    for cycle, code in events:
        rows["num_events"][cycle] = 1
        rest[cycle] = tape.EVENT.pack(code, 0, 2, 1, 0, 0, 0, 1.0)
    return tape.Tape(Path("none"), header, rows, rest, True, 0)


def test_a_digest_is_of_bits_and_of_the_signals_that_it_names():
    of = ("control.tau",)
    first = kept.digest(made([1.0, 0.0]), of)
    assert first == kept.digest(made([1.0, 0.0], extra=["control.later"]), of), "a new signal is no change"
    others = [made([1.0, -0.0]), made([1.0]), made([np.nextafter(1.0, 2.0), 0.0]), made([1.0, 0.0], events=[(1, 7)]), made([1.0, 0.0], events=[(1, 8)])]
    assert len({first, *(kept.digest(one, of) for one in others)}) == 6
    with pytest.raises(kept.Gone, match="control.s"):
        kept.digest(made([1.0]), ("control.s",))


def test_what_is_written_is_read_again():
    tapes = {("tape", "a"): made([1.0], extra=["control.later"]), ("tape", "b"): made([2.0]), ("scenario", "a"): made([3.0])}
    written = kept.of_tapes(tapes)
    assert written.signals == ("control.tau",) and kept.parse(written.text(), "here") == written
    assert kept.differences(written, tapes) == ([], [])
    tapes |= {("tape", "b"): made([2.5]), ("scenario", "new"): made([1.0])}
    assert kept.differences(written, tapes) == ([("tape", "b")], [("scenario", "new")])
    with pytest.raises(UsageError, match="here: .*`tools/reed gate --write` makes it anew"):
        kept.parse("signals = 1", "here")


@pytest.fixture
def by_digests(monkeypatch, capsys):
    """by_digests(before, now, declared): --quick where the base and this checkout keep these tapes' digests, and the programs make `ran`."""
    def call(before, now, ran, declared=(), *words):
        entry = corpus.Entry("a", "joints2")
        monkeypatch.setattr(corpus, "load", lambda: corpus.Corpus([entry], {}, 0.1))
        monkeypatch.setattr(commits, "last_of_main", lambda: BASE)
        monkeypatch.setattr(commits, "resolve", lambda name: HEAD)
        monkeypatch.setattr(commits, "declared", lambda base, head: list(declared))
        monkeypatch.setattr(kept, "of_commit", lambda commit: before and kept.of_tapes({("tape", "a"): before}))
        monkeypatch.setattr(kept, "of_checkout", lambda: kept.of_tapes({("tape", "a"): now}))
        monkeypatch.setattr(quick, "record_all", lambda entries, jobs: {("tape", "a"): ran})
        monkeypatch.setattr(corpus, "lacks", lambda tapes, coverage: [])
        status = cli.main(["gate", "--quick", *words])
        said = capsys.readouterr()
        assert not said.err, said.err
        return status, said.out

    return call


def test_quick_says_same_or_wants_a_declaration(by_digests):
    one, other = made([1.0]), made([2.0])
    assert by_digests(one, one, one) == (0, f"same as {BASE[:12]}: 1 digests\n")
    status, said = by_digests(one, other, other)
    assert status == 1 and f"changed since {BASE[:12]}: tape a\n" in said and "no commit since then says `changes-control: why`" in said
    status, said = by_digests(one, other, other, ["more damping"])
    assert status == 0 and "declared: more damping" in said
    status, said = by_digests(one, one, other, ["more damping"])
    assert status == 1 and "config/gate/digests.toml is not of this checkout: tape a" in said, "declared, but the file is the old one"
    status, said = by_digests(None, one, one)
    assert status == 0 and f"not compared with a base: {BASE[:12]} keeps no digests" in said
    status, said = by_digests(one, other, other, [], "--json")
    found = json.loads(said)
    assert status == 1 and [row["tape"] for row in found["changed"]] == ["a"] and set(found) >= {"base", "head", "tapes", "scenarios", "declared"}


def test_quick_and_write_are_of_the_whole_corpus(capsys):
    for words in (["--quick", "HEAD~1", "HEAD"], ["--quick", "--only", "x"], ["--write", "HEAD"], ["--write", "--quick"]):
        assert cli.main(["gate", *words]) == 2
        assert capsys.readouterr().err.count("\n") == 1


def test_this_checkout_keeps_a_digest_of_every_tape():
    """Those of scenarios are renewed with the next change of behaviour; `tools/reed test gate` compares them all."""
    own = kept.of_checkout()
    assert set(own.digests["tape"]) == {entry.name for entry in corpus.load().tapes}
    assert set(own.digests["scenario"]) and "control.tau" in own.signals


def test_a_list_that_cannot_be_read_is_one_line(tmp_path):
    (tmp_path / "corpus.toml").write_text("[[tapes]]\nname = 'x'\n")
    with pytest.raises(UsageError, match="corpus.toml: 'scenario'; it lists"):
        corpus.load(tmp_path / "corpus.toml")


def test_files_beside_the_list_are_found_and_names_are_left_to_each_version():
    known = {entry.name: entry for entry in corpus.load().tapes}
    assert known["joints3"].scenario == str(corpus.FILE.with_name("joints3.toml")) and known["joints2"].scenario == "joints2"
