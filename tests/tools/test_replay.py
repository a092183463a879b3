"""tools/reed replay: every recorded run is the same to the bit; the first difference is found; bad tapes are one line."""

import json
import resource
import shutil
import signal
import struct
import subprocess
import time
import tomllib
import zlib

import numpy as np
import own_address
import pytest

from reed_tools import cli
from reed_tools.errors import UsageError
from reed_tools.law import choice as law_choice
from reed_tools.paths import PYTHON, ROOT, build, program
from reed_tools.record import tape
from reed_tools.replay import differences
from reed_tools.replay.player import Changes, replay
from reed_tools.run import hil, plans, scenario

BUS = own_address.bus()
SHORT = "scenario.duration_s=0.6"
# Faults of the bus and the sensor, a law that is caught by the limits, a trip, a switch of the force source, another number of joints.
RUNS = {
    "press": ("press_known", [SHORT]),
    "sensor_loss": ("press_sensor_loss", []),
    "unknown": ("fluctuating_unknown", [SHORT]),
    "computed_torque": ("free_motion", [SHORT, "control.law=computed_torque"]),
    "trip": ("fluctuating_unknown", ["control.law=paper_printed", "scenario.duration_s=2.0"]),
    "two_joints": ("joints2", [SHORT]),
}


@pytest.fixture(scope="module", autouse=True)
def built():
    build("reed_replay", "reed_one_process")


def record(folder, name, entries, bus=hil.MEMORY, clock="lockstep"):
    effective = scenario.write_effective(name, None, list(entries), folder / "effective.toml", halves=True)
    plan = plans.make(effective, folder / "effective.toml", bus, clock, folder, lcm=False, commit="0123abc",
                      host_pause=clock == "realtime")
    hil.run(plan, lambda mode, t_s: None)
    return folder / tape.NAME


@pytest.fixture(scope="module")
def tapes(tmp_path_factory):
    """By name, each recorded when it is asked for."""
    found = {}

    def get(name):
        if name not in found:
            found[name] = record(tmp_path_factory.mktemp(name), *RUNS[name])
        return found[name]

    return get


def reed(capsys, *argv):
    status = cli.main(["replay", *map(str, argv)])
    said = capsys.readouterr()
    return status, said.out, said.err


@pytest.mark.parametrize("name", RUNS)
def test_a_lockstep_run_replays_to_the_bit(name, tapes, capsys):
    status, said, problem = reed(capsys, tapes(name), "--json")
    found = json.loads(said)
    assert (status, found["same"], found["first"], found["missing"]) == (0, True, None, None), said + problem
    recorded = tape.read(tapes(name))
    assert found["cycles"] == len(recorded) > 150 and recorded.complete


def test_the_runs_hold_what_a_replay_has_to_survive(tapes):
    read = {name: tape.read(tapes(name)) for name in RUNS}
    assert set(np.unique(read["press"]["control.mode"])) >= {0, 1, 2}, "off, ready and active"
    assert read["trip"]["control.mode"][-1] == 3, "a fault"
    assert len(set(np.unique(read["sensor_loss"]["control.force_source"]))) > 1, "a switch of the force source"
    assert read["two_joints"].header.joints == 2
    assert any(read["press"].events(k) for k in range(len(read["press"])))


def test_a_run_on_the_clock_replays_to_the_bit_however_late_the_machine_was(tmp_path, capsys):
    """On a machine that is busy with other work there are overruns by themselves; the budget makes sure of some."""
    build("reed_firmware", "reed_plant_sim")
    path = record(tmp_path, "press_known", ["scenario.duration_s=1.0", "timing.compute_budget_us=20", "timing.rx_budget_us=530",
                                            "timing.phase_action=degrade"], BUS, "realtime")
    recorded = tape.read(path)
    status, said, problem = reed(capsys, tmp_path)
    assert status == 0 and said.startswith(f"same: {recorded.usable()} cycles"), said + problem
    assert recorded["loop.degrade"].any() or recorded["timing.compute_over"][-1] > 0, "budgets were broken, and replayed"


def test_held_up_programs_and_late_frames_replay_to_the_bit(tmp_path, capsys):
    """Both programs are stopped for some ms again and again."""
    build("reed_firmware", "reed_plant_sim")
    scenario.write_effective("press_known", None, ["scenario.duration_s=20", "timing.max_missed_in_row=1000", "timing.overrun=hold",
                                                   "limits.stop_age_cycles=900"], tmp_path / "effective.toml")
    common = ["--config", str(tmp_path / "effective.toml"), "--bus", BUS, "--clock", "realtime", "--no-lcm"]
    with open(tmp_path / "output.txt", "wb") as output:
        plant = subprocess.Popen([str(program("reed_plant_sim")), *common], stdout=output, stderr=output)
        time.sleep(0.5)
        firmware = subprocess.Popen([str(program("reed_firmware")), *common, "--enable", "--tape", str(tmp_path / tape.NAME)], stdout=output, stderr=output)
        try:
            time.sleep(1.0)
            for turn in range(24):
                one = (plant, firmware)[turn % 2]
                one.send_signal(signal.SIGSTOP)
                time.sleep(0.004)
                one.send_signal(signal.SIGCONT)
                time.sleep(0.03)
            firmware.send_signal(signal.SIGINT)
            firmware.wait(20)
        finally:
            for one in (firmware, plant):
                one.kill()
                one.wait()
    recorded = tape.read(tmp_path / tape.NAME)
    assert recorded["timing.missed"][-1] > 0 and recorded["loop.gap"].any() and recorded["loop.hold"].any(), (tmp_path / "output.txt").read_text()
    assert recorded["bus.late"][-1] > 0, "late frames"
    status, said, problem = reed(capsys, tmp_path)
    assert status == 0 and said.startswith(f"same: {recorded.usable()} cycles"), said + problem
    assert recorded.usable() > 100


def long_run(folder):
    """30 s of lockstep, and how to wait until some of it is on the tape."""
    scenario.write_effective("drift_30s", None, [], folder / "effective.toml")
    with open(folder / "output.txt", "wb") as output:
        both = subprocess.Popen([str(program("reed_one_process")), "--config", str(folder / "effective.toml"), "--no-lcm", "--enable",
                                 "--tape", str(folder / tape.NAME)], stdout=output, stderr=output)
    patience = time.monotonic() + 60
    while time.monotonic() < patience and not ((folder / tape.NAME).exists() and (folder / tape.NAME).stat().st_size > 1_000_000):
        time.sleep(0.05)
    return both


def test_the_operators_stop_replays_in_its_cycle(tmp_path, capsys):
    both = long_run(tmp_path)
    both.send_signal(signal.SIGINT)
    both.wait(30)
    recorded = tape.read(tmp_path / tape.NAME)
    stop = recorded["loop.stop_wanted"]
    assert recorded.complete and stop[-1] and not stop[len(stop) // 2], "some cycles before the end"
    assert recorded["control.mode"][-1] == 0
    status, said, problem = reed(capsys, tmp_path)
    assert status == 0 and said.startswith("same: "), said + problem


def test_a_law_from_outside_replays_with_its_file_and_is_named_when_it_is_gone(tmp_path, capsys):
    law = tmp_path / "own_law.py"
    shutil.copy(ROOT / "examples" / "own_law" / "own_law.py", law)
    chosen = law_choice.choose(str(law), "lockstep")
    effective = scenario.write_effective("free_motion", None, ["scenario.duration_s=0.2"], tmp_path / "effective.toml", halves=True)
    hil.run(plans.make(effective, tmp_path / "effective.toml", hil.MEMORY, "lockstep", tmp_path, lcm=False, law=chosen.spec,
                       environment=chosen.environment), lambda mode, t_s: None)
    status, said, problem = reed(capsys, tmp_path)
    assert status == 0 and said.startswith("same: "), said + problem
    law.unlink()
    status, _, problem = reed(capsys, tmp_path)
    assert status == 2 and "is not there any more; --law names where it is now" in problem and problem.count("\n") == 1


def with_bit(value: float) -> float:
    """The neighbour of a number: one bit further."""
    return struct.unpack("<d", struct.pack("<Q", struct.unpack("<Q", struct.pack("<d", value))[0] ^ 1))[0]


def test_one_bit_of_one_gain_is_found_in_the_first_cycle_in_which_it_can_be_seen(tapes, capsys):
    """K_d acts through K_d s alone: while the product rounds to the same number, nothing differs."""
    recorded = tape.read(tapes("press"))
    gains = [float(gain) for gain in tomllib.loads(recorded.header.config)["control"]["K_d"]]
    changed = [gains[0], with_bit(gains[1]), *gains[2:]]
    s = recorded["control.s"][:, 1]
    visible = np.flatnonzero(s * gains[1] != s * changed[1])
    status, said, _ = reed(capsys, tapes("press"), "--json", "--set", f"control.K_d={changed!r}")
    first = json.loads(said)["first"]
    assert status == 1 and first["signal"] == "control.tau_law_j2"
    before, after = (struct.unpack("<d", bytes.fromhex(first[side][2:])[::-1])[0] for side in ("recorded", "replayed"))
    assert before == recorded["control.tau_law"][first["cycle"], 1] and before != after
    assert 0 <= np.searchsorted(visible, first["cycle"]) < 20 and first["cycle"] in visible, "a sum may swallow the bit for some cycles"


def test_one_bit_in_one_frame_is_found_in_its_cycle(tapes, tmp_path, capsys):
    """The record is sealed again, so that only the replay can notice."""
    cycle = 250
    data = bytearray(tapes("press").read_bytes())
    at, number = len(tape.MARK), -1
    while number < cycle:
        start = at
        kind, size = tape.HEAD.unpack_from(data, at)
        number += kind == tape.CYCLE
        at += tape.HEAD.size + size + tape.SUM.size
    end = at - tape.SUM.size
    data[end - 1 - 48 - tape.FRAME.size - 1] ^= 1  # behind it the command's frame; before it the last received one
    data[end:at] = tape.SUM.pack(zlib.crc32(data[start:end]))
    (tmp_path / "changed.reed").write_bytes(data)
    status, said, _ = reed(capsys, tmp_path / "changed.reed")
    assert status == 1 and f"differs: cycle {cycle}, " in said


def test_a_tape_that_was_cut_anywhere_is_read_up_to_its_last_whole_cycle(tapes, tmp_path, capsys):
    whole, generator = tapes("press").read_bytes(), np.random.default_rng(7)
    count = len(tape.read(tapes("press")))
    header = whole.index(b"\nconfig\n") + len(tape.read(tapes("press")).header.config) + 20
    counts = []
    for cut in sorted(generator.integers(header, len(whole) - 1, 200)):
        (tmp_path / "cut.reed").write_bytes(whole[:cut])
        found = tape.read(tmp_path / "cut.reed")
        assert not found.complete and found.missing() and found.usable() == len(found) <= count
        counts.append(len(found))
    assert counts == sorted(counts) and counts[-1] > 0.9 * count
    status, said, _ = reed(capsys, tmp_path / "cut.reed")
    assert status == 0 and said.startswith(f"same: {counts[-1]} cycles") and "not replayed: the tape" in said


def test_a_program_that_was_killed_leaves_a_tape_up_to_its_last_second(tmp_path, capsys):
    both = long_run(tmp_path)
    both.kill()
    both.wait()
    found = tape.read(tmp_path / tape.NAME)
    assert 100 < len(found) < 35_000 and not found.complete
    status, said, _ = reed(capsys, tmp_path)
    assert status == 0 and said.startswith(f"same: {len(found)} cycles") and ("without its end" in said or "cut or damaged" in said)


def test_another_value_in_the_configuration_is_a_what_if_with_plots(tapes, tmp_path, capsys):
    status, said, _ = reed(capsys, tapes("press"), "--set", "force.desired_N=4", "--out", tmp_path / "what")
    assert status == 1 and "open loop" in said
    assert (tmp_path / "what" / "commands.png").stat().st_size > 10_000 and (tmp_path / "what" / "estimates.png").stat().st_size > 10_000


def test_the_header_says_what_ran(tapes):
    header = tape.read(tapes("press")).header
    assert header.values["schema"] == "1" and header.values["reed"] and header.commit == "0123abc"
    assert (header.values["scenario"], header.values["arm"], header.values["clock"], header.joints) == ("press_known", "a5", "lockstep", 5)
    assert header.config == (tapes("press").parent / "controller.toml").read_text(), "so their sums are equal"


def damaged(whole: bytes, how: str) -> bytes:
    if how == "empty":
        return b""
    if how == "foreign":
        return b"LCM log, or what it is" * 10
    if how == "header":
        return whole[:40] + bytes([whole[40] ^ 1]) + whole[41:]
    kind, size = tape.HEAD.unpack_from(whole, 8)
    text = whole[16:16 + size]
    text = text.replace(b"schema 1\n", b"schema 9\n") if how == "future" else text.replace(b"timing.rx_ns", b"timing.xx_ns")
    head = tape.HEAD.pack(kind, len(text)) + text
    return whole[:8] + head + tape.SUM.pack(zlib.crc32(head)) + whole[16 + size + 4:]


@pytest.mark.parametrize("how, words", [("empty", "is no tape; allowed: the tape.reed of a run folder"), ("foreign", "is no tape"),
                                        ("header", "its header is damaged"), ("future", "tape schema 9, this Reed reads 1"),
                                        ("other", "has no value timing.rx_ns, which this program needs")])
def test_a_file_that_cannot_be_replayed_is_one_line(how, words, tapes, tmp_path, capsys):
    (tmp_path / "bad.reed").write_bytes(damaged(tapes("press").read_bytes(), how))
    status, said, problem = reed(capsys, tmp_path / "bad.reed")
    assert status == 2 and words in problem and problem.count("\n") == 1 and not said
    if how in ("empty", "foreign", "future"):
        done = subprocess.run([str(program("reed_replay")), "--tape", str(tmp_path / "bad.reed"), "--config", "press_known", "--out",
                               str(tmp_path / "out")], capture_output=True, text=True)
        assert done.returncode == 2 and done.stderr.count("\n") == 1 and not (tmp_path / "out").exists()


def test_a_folder_without_a_tape_another_arm_and_a_law_that_is_gone_are_one_line(tapes, tmp_path, capsys):
    for argv, words in (([tmp_path], "has no tape.reed, so there is nothing to replay"), ([tmp_path / "no"], "there is no such run folder"),
                        ([tapes("press"), "--arm", "p2"], "5 numbers for 2 joints"),
                        ([tapes("press"), "--set", "control.K_d=-1"], "control.K_d"), ([tapes("press"), "--law", "no.so"], "--law no.so"),
                        ([tapes("press"), "--closed"], "--closed needs a run folder")):
        status, _, problem = reed(capsys, *argv)
        assert status == 2 and words in problem and problem.count("\n") == 1, problem


def test_a_hole_ends_the_replay_and_is_named(tapes, tmp_path):
    """The ring was full for two cycles."""
    whole, at, cycle, parts = tapes("press").read_bytes(), 8, 0, [b"REEDTAPE"]
    while at < len(whole):
        kind, size = tape.HEAD.unpack_from(whole, at)
        end = at + tape.HEAD.size + size + tape.SUM.size
        cycle += kind == tape.CYCLE
        if not (kind == tape.CYCLE and cycle in (201, 202)):
            parts.append(whole[at:end])
        at = end
    (tmp_path / "hole.reed").write_bytes(b"".join(parts))
    found = tape.read(tmp_path / "hole.reed")
    assert found.usable() == 200 and found.missing().startswith("cycles 200 to 201 are not on the tape")
    again = replay(found, Changes(), tmp_path)
    assert len(again) == 200 and differences.first(found, again, found.usable()) is None


def test_differences_are_of_bits(tapes):
    one, other = tape.read(tapes("press")), tape.read(tapes("press"))
    assert differences.every(one, other) == []
    other.rows = other.rows.copy()
    one.rows = one.rows.copy()
    one.rows["control.f"][3] = other.rows["control.f"][3] = np.nan
    one.rows["control.z"][5], other.rows["control.z"][5] = 0.0, -0.0
    one.row_bytes = one.rows.view(np.uint8).reshape(len(one), -1)
    other.row_bytes = other.rows.view(np.uint8).reshape(len(other), -1)
    found = differences.every(one, other)
    assert [(entry.signal, entry.cycle, entry.before, entry.after) for entry in found] == [
        ("control.z", 5, "0x0000000000000000", "0x8000000000000000")], "NaN equals NaN, and -0 is not 0"


def test_a_minute_of_tape_takes_seconds(tmp_path):
    """Processor time, in parts that a test can wait for; the least of three, since other threads and a shared host add to it."""
    path = record(tmp_path, "press_known", ["scenario.duration_s=6.0"])
    per_cycle = []
    for _ in range(3):
        started = time.process_time()
        recorded = tape.read(path)
        read_s = time.process_time() - started
        children = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        again = replay(recorded, Changes(), tmp_path)
        played_s = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - children
        assert differences.first(recorded, again) is None
        per_cycle.append((2 * read_s + played_s) / len(recorded))
    print(f"{60_000 * min(per_cycle):.2f} s of processor time for a minute at 1 kHz")
    assert 60_000 * min(per_cycle) < 5.0


def test_an_unknown_tape_is_refused_by_the_reader_too(tmp_path):
    shutil.copy(ROOT / "README.md", tmp_path / "tape.reed")
    with pytest.raises(UsageError, match="is no tape"):
        tape.read(tmp_path / "tape.reed")


def test_the_command_has_an_example_in_its_help():
    done = subprocess.run([*PYTHON, str(ROOT / "tools/reed_tools/__main__.py"), "replay", "--help"], capture_output=True, text=True)
    assert done.returncode == 0 and "tools/reed replay out/RUN --set" in done.stdout
