"""The trace of a run in the trace event format: phases end to end, instants for misses, late frames and events."""

import json
from types import SimpleNamespace as Message

import own_address

from reed_tools.record import trace_events


def timing(cycle: int, missed: int = 0, missed_host_paused: int = 0) -> tuple:
    return "REED_TIMING", Message(utime=1_000_000 + 1000 * cycle, cycle=cycle, wake_ns=5_000, rx_ns=100_000, compute_ns=20_000,
                                  tx_ns=8_000, cycle_ns=128_000, missed=missed,
                                  missed_host_paused=missed_host_paused)


def test_phases_follow_each_other_without_gap_or_overlap():
    events, cycles = trace_events.trace([timing(0), timing(1)])
    spans = [event for event in events if event["ph"] == "X" and event["args"]["cycle"] == 1]
    assert cycles == 2
    assert [span["name"] for span in spans] == ["wake", "receive", "compute", "transmit"]
    for before, after in zip(spans, spans[1:]):
        assert abs(before["ts"] + before["dur"] - after["ts"]) < 1e-6
    assert spans[1]["ts"] == 1000.0


def test_misses_late_frames_and_mode_changes_are_instants():
    mode = "REED_EVENT", Message(utime=1_000_500, cycle=0, mode=2, code=1, joint=-1, value=3.0, text="mode changed")
    bus = "REED_BUS", Message(utime=1_002_000, cycle=2, late=4)
    events, _ = trace_events.trace([timing(0), mode, timing(1, missed=3), bus, timing(2, missed=5, missed_host_paused=2)])
    instants = {event["name"]: event["args"] for event in events if event["ph"] == "i"}
    assert instants["missed"] == {"cycles": 2}, "the last one"
    assert instants["host pause"] == {"missed cycles": 2}
    assert instants["late frames"] == {"frames": 4}
    assert instants["mode changed"]["mode"] == 2
    assert len([event for event in events if event["name"] == "missed"]) == 2
    assert len([event for event in events if event["name"] == "host pause"]) == 1


def test_run_trace_writes_a_file_that_perfetto_reads(reed, tmp_path):
    """Its trace event format: an object with traceEvents, each with a name, a phase letter, a process and a thread; times in µs."""
    done = reed("run", "--trace", "--bus", own_address.bus(), "--out", tmp_path)
    trace = json.loads((tmp_path / "trace.json").read_text())
    events, cycles = trace["traceEvents"], json.loads((tmp_path / "summary.json").read_text())["cycles"]
    assert done.returncode in (0, 1), done.stderr
    assert {event["ph"] for event in events} <= {"X", "i", "M"}
    for event in events:
        assert event["name"] and {"pid", "tid"} <= event.keys()
        assert event["ph"] == "M" or event["ts"] >= -1000.0
        assert event["ph"] != "X" or event["dur"] >= 0.0
    for phase in ("receive", "compute", "transmit"):
        assert sum(event["name"] == phase for event in events) == cycles
    assert any(event["ph"] == "i" for event in events), "the changes of mode are instants"
