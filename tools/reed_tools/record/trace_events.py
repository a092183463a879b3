"""One run as a trace that ui.perfetto.dev and chrome://tracing open: a span per phase, instants for what happened."""

import json
from pathlib import Path

from reed_tools.paths import use_message_types
from reed_tools.record import event_file, whole_file

LOOP, EVENTS = 1, 2  # rows of the trace
PHASES = (("receive", "rx_ns"), ("compute", "compute_ns"), ("transmit", "tx_ns"))


def write(log: Path, target: Path) -> int:
    """Writes the trace of one telemetry log; returns the number of cycles in it."""
    use_message_types()
    import reed

    kinds = {"REED_TIMING": reed.timing_t, "REED_EVENT": reed.event_t, "REED_BUS": reed.bus_t}
    messages = ((event.channel, kinds[event.channel].decode(event.data)) for event in event_file.read(log)
                if event.channel in kinds)
    events, cycles = trace(messages)
    whole_file.write_text(target, json.dumps({"displayTimeUnit": "ns", "traceEvents": events}))
    return cycles


def trace(messages) -> tuple[list[dict], int]:
    events = [name(LOOP, "control loop"), name(EVENTS, "events")]
    start, cycles, missed, missed_host_paused, late = None, 0, 0, 0, 0
    for channel, message in messages:
        start = message.utime if start is None else start
        at_us = float(message.utime - start)
        if channel == "REED_TIMING":
            cycles += 1
            events += spans(message, at_us)
            if message.missed > missed:
                events.append(instant("missed", at_us + message.cycle_ns / 1e3, {"cycles": message.missed - missed}))
            missed = message.missed
            if message.missed_host_paused > missed_host_paused:
                events.append(instant("host pause", at_us + message.cycle_ns / 1e3,
                                      {"missed cycles": message.missed_host_paused - missed_host_paused}))
            missed_host_paused = message.missed_host_paused
        elif channel == "REED_EVENT":
            events.append(instant(message.text, at_us, {"code": message.code, "joint": message.joint, "value": message.value,
                                                        "mode": message.mode, "cycle": message.cycle}))
        else:
            if message.late > late:
                events.append(instant("late frames", at_us, {"frames": message.late - late}))
            late = message.late
    return events, cycles


def spans(timing, at_us: float) -> list[dict]:
    """The wake-up's delay, then the phases one after the other."""
    found = [span("wake", at_us - timing.wake_ns / 1e3, timing.wake_ns, timing.cycle)] if timing.wake_ns > 0 else []
    for phase, field in PHASES:
        duration_ns = getattr(timing, field)
        found.append(span(phase, at_us, duration_ns, timing.cycle))
        at_us += duration_ns / 1e3
    return found


def span(title: str, at_us: float, duration_ns: int, cycle: int) -> dict:
    return {"name": title, "ph": "X", "pid": 1, "tid": LOOP, "ts": round(at_us, 3), "dur": duration_ns / 1e3, "args": {"cycle": cycle}}


def instant(title: str, at_us: float, arguments: dict) -> dict:
    return {"name": title, "ph": "i", "s": "t", "pid": 1, "tid": EVENTS, "ts": round(at_us, 3), "args": arguments}


def name(row: int, title: str) -> dict:
    return {"name": "thread_name", "ph": "M", "pid": 1, "tid": row, "args": {"name": title}}
