"""What a run recorded is never lost between the programs and the report, and damage to it is named."""

import errno
import itertools
import json
import struct
import subprocess
import sys

import lcm
import pytest
import synthetic_run as synthetic

from reed_tools.errors import UsageError
from reed_tools.figures import command, plots
from reed_tools.figures.evaluate import evaluate
from reed_tools.record import configuration, event_file, merge, run_folder, whole_file



def lengths_at(block: bytes, number: int) -> int:
    """Where the two lengths of a record stand."""
    at = 0
    for _ in range(number):
        channel, data = struct.unpack_from(">20xII", block, at)
        at += 28 + channel + data
    return at + 20


@pytest.fixture
def folder(tmp_path):
    return synthetic.write(tmp_path / "run", [], duration_s=0.5)


@pytest.fixture
def merged(folder):
    assert run_folder.complete(folder) is None
    return folder


@pytest.fixture(autouse=True)
def no_pictures(monkeypatch):
    """They take a second each and are no record."""
    monkeypatch.setattr(plots, "draw_all", lambda *_: [])


def report(folder):
    """The exit status, or the error, of `tools/reed report`."""
    class Arguments:
        run_dir, json = folder, False

    return command.run(Arguments)


def test_records_are_those_that_liblcm_reads_and_writes(folder):
    path = folder / "firmware.lcmlog"
    log = lcm.EventLog(str(path), "r")
    theirs = [(event.timestamp, event.channel, event.data) for event in log]
    log.close()
    assert [tuple(event) for event in event_file.read(path)] == theirs and len(theirs) > 2000
    with open(folder / "copy", "wb") as file:
        assert event_file.write(file, event_file.read(path)) == path.stat().st_size
    assert (folder / "copy").read_bytes() == path.read_bytes()


@pytest.mark.parametrize("channel_size, data_size", [(0x7fffffff, 20), (20, 0x7fffffff), (0, 100), (64, 100), (13, 1), (13, 400_000)])
def test_a_record_with_wrong_lengths_is_left_out_and_the_others_are_read(folder, channel_size, data_size):
    path = folder / "firmware.lcmlog"
    block = bytearray(path.read_bytes())
    whole = list(event_file.read(path))
    struct.pack_into(">II", block, lengths_at(block, 1000), channel_size, data_size)
    path.write_bytes(block)
    assert list(event_file.read(path)) == whole[:1000] + whole[1001:]


def test_a_log_cut_anywhere_gives_every_whole_record_before_the_cut(folder):
    path = folder / "plant.lcmlog"
    block = path.read_bytes()
    whole = list(event_file.read(path))
    ends = list(itertools.accumulate(event.size for event in whole))
    assert ends[-1] == len(block)
    for cut in (1, 3, 27, 28, 29, whole[-1].size - 1, whole[-1].size, whole[-1].size + 1):
        path.write_bytes(block[:-cut])
        assert list(event_file.read(path)) == [event for event, end in zip(whole, ends) if end <= len(block) - cut], cut


@pytest.mark.parametrize("what", [KeyboardInterrupt(), OSError(errno.ENOSPC, "No space left on device")])
def test_a_merge_that_does_not_end_leaves_both_logs_and_no_half_of_one(folder, monkeypatch, what):
    def stop_in_the_middle(file, events):
        for number, event in enumerate(events):
            file.write(event.data)
            if number == 1000:
                raise what

    before = {part: (folder / part).read_bytes() for part in run_folder.PARTS}
    monkeypatch.setattr(merge, "write", stop_in_the_middle)
    if isinstance(what, OSError):
        problem = run_folder.complete(folder)
        assert problem.startswith(f"{folder / 'telemetry.lcmlog'}: no space left on device; ")
    else:
        with pytest.raises(KeyboardInterrupt):
            run_folder.complete(folder)
    assert {path.name for path in folder.iterdir()} == {"effective.toml", *run_folder.PARTS}
    assert before == {part: (folder / part).read_bytes() for part in run_folder.PARTS}


def test_a_merge_that_comes_out_short_keeps_both_logs(folder, monkeypatch):
    monkeypatch.setattr(merge, "write", lambda file, events: 1 + event_file.write(file, events))
    with pytest.raises(Exception, match="bytes were written and .* are there; the programs' own logs stay"):
        run_folder.complete(folder)
    assert all((folder / part).exists() for part in run_folder.PARTS)


def test_report_merges_what_a_killed_tool_left(folder):
    (folder / "telemetry.lcmlog.part").write_bytes(b"half of a merge")
    assert report(folder) == 0
    assert {"telemetry.lcmlog", "SHA256SUMS", "summary.json", "report.html"} <= {path.name for path in folder.iterdir()}
    assert not any((folder / part).exists() for part in run_folder.PARTS)
    assert json.loads((folder / "summary.json").read_text())["cycles"] == 600


def test_a_tool_killed_between_rename_and_delete_left_a_whole_log(folder):
    parts = {part: (folder / part).read_bytes() for part in run_folder.PARTS}
    run_folder.complete(folder)
    whole = (folder / "telemetry.lcmlog").read_bytes()
    (folder / "plant.lcmlog").write_bytes(parts["plant.lcmlog"])
    assert report(folder) == 0
    assert (folder / "telemetry.lcmlog").read_bytes() == whole and not (folder / "plant.lcmlog").exists()


def test_report_leaves_the_logs_of_a_run_that_goes_on_alone(folder):
    with subprocess.Popen([sys.executable, "-c", "import sys; f = open(sys.argv[1], 'ab'); print(1, flush=True); sys.stdin.read()",
                           str(folder / "firmware.lcmlog")], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as writer:
        writer.stdout.readline()
        with pytest.raises(UsageError, match=f"its run goes on, process {writer.pid} writes firmware.lcmlog"):
            report(folder)
        writer.stdin.close()
    assert report(folder) == 0


def test_a_full_disk_still_gives_the_figures_and_names_the_file(folder, monkeypatch):
    def full(path):
        raise OSError(errno.ENOSPC, "No space left on device", str(path))

    for module in (merge, whole_file):
        monkeypatch.setattr(module, "replacing", full)
    assert run_folder.complete(folder).startswith(f"{folder}/telemetry.lcmlog: no space left on device")
    figures, problem = evaluate(folder)
    assert figures["verdict"] == "pass" and figures["cycles"] == 600
    assert problem.startswith(f"{folder}/summary.json: no space left on device; the records are kept, `tools/reed report ")


def test_a_run_knows_the_sums_of_its_records(merged):
    done = subprocess.run(["sha256sum", "-c", "SHA256SUMS"], cwd=merged, capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout == "effective.toml: OK\ntelemetry.lcmlog: OK\n"


def flipped(path, at):
    block = bytearray(path.read_bytes())
    block[at] ^= 1
    path.write_bytes(block)


def long_record(path):
    block = bytearray(path.read_bytes())
    struct.pack_into(">I", block, lengths_at(block, 1000) + 4, 0x7fffffff)
    path.write_bytes(block)


DAMAGE = {
    "one bit of a message": ("telemetry.lcmlog", lambda path: flipped(path, 200_000)),
    "one bit of a number": ("effective.toml", lambda path: path.write_text(path.read_text().replace("seed = 7", "seed = 5"))),
    "the sums": ("SHA256SUMS", lambda path: path.write_text("")),
    # what is seen without sums, too
    "a length": ("telemetry.lcmlog", long_record),
    "the last byte": ("telemetry.lcmlog", lambda path: path.write_bytes(path.read_bytes()[:-1])),
    "emptied log": ("telemetry.lcmlog", lambda path: path.write_bytes(b"")),
    "emptied configuration": ("effective.toml", lambda path: path.write_text("")),
    "no text": ("effective.toml", lambda path: path.write_bytes(b"\xff\xfe")),
}


@pytest.mark.parametrize("what, with_sums", [*((what, True) for what in DAMAGE), *((what, False) for what in list(DAMAGE)[3:])])
def test_damage_is_one_line_and_the_result_stays(merged, what, with_sums):
    (merged / "summary.json").write_text("of the run")
    name, damage = DAMAGE[what]
    damage(merged / name)
    if not with_sums:  # a folder of an earlier version
        (merged / "SHA256SUMS").unlink()
    with pytest.raises(UsageError, match=f"{name}( is damaged)?: ") as refused:
        report(merged)
    assert "\n" not in str(refused.value)
    assert (merged / "summary.json").read_text() == "of the run"


@pytest.mark.parametrize("section", ["scenario", "arm", "control", "timing"])
def test_a_configuration_without_a_section_is_named(merged, section):
    text = (merged / "effective.toml").read_text()
    (merged / "effective.toml").write_text(text.replace(f"[{section}]", f"[no_{section}]"))
    with pytest.raises(UsageError, match=rf"effective.toml: \[{section}\] is missing"):
        configuration.load(merged / "effective.toml")
    with pytest.raises(UsageError, match=r"effective.toml: \[\[checks\]\] is missing"):
        (merged / "effective.toml").write_text(text.replace("checks = []", ""))
        configuration.load(merged / "effective.toml")
