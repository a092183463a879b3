"""A moment of a run in words: mode, active law, active limits, bus, loop, events. HTML for the page."""

from html import escape

from reed_tools.live.moment import Moment
from reed_tools.record.event_names import in_text
from reed_tools.record.signals import FAULT, MODES, SOURCES
from reed_tools.text import plain

LAWS = {"none": "no force law", "known": "force known from the wrench", "unknown": "force unknown", "observer": "force from the observer"}
LIMITS = ("torque", "torque rate", "normal speed", "an old measurement is held", "torque ramps down")  # bits of control_t.limits
DRIVES = ("off", "ready", "enabled", "braked", "fault")
BUS_FAULTS = (("lost", "lost"), ("crc_errors", "damaged"), ("repeated", "repeated"), ("wrong_sequence", "out of order"),
              ("out_of_range", "out of range"), ("late", "late"), ("tx_refused", "refused by the interface"))
SILENCE_s = 2.0
OFF = MODES.index("off")


def headline(moment: Moment, silent_s: float) -> str:
    if moment.cycle is None:
        return "waiting for a run"
    finished = moment.run is not None and moment.run.finished
    if finished or (silent_s > SILENCE_s and moment.mode == OFF):
        return "the run has ended; waiting for the next one"
    if silent_s > SILENCE_s:
        return f"nothing heard for {silent_s:.0f} s: the run ended early or is paused"
    return f"running, {MODES[moment.mode]}"


def limits_at_work(bits: int) -> str:
    return ", ".join(name for bit, name in enumerate(LIMITS) if bits >> bit & 1) or "none"


def bus_health(bus) -> str:
    if bus is None:
        return "no counters yet"
    faults = [f"{getattr(bus, name)} {text}" for name, text in BUS_FAULTS if getattr(bus, name)]
    return f"{', '.join(faults) or 'healthy'} ({bus.frames_rx} frames received, {bus.frames_tx} sent)"


def drives(moment: Moment) -> str:
    old = [f"joint {k + 1}: {age} cycles old" for k, age in enumerate(moment.ages) if age]
    states = sorted({DRIVES[state] for state in moment.drives if 0 <= state < len(DRIVES)})
    return f"{' and '.join(states)}{'; ' if old else ''}{', '.join(old)}"


def event_line(event) -> str:
    style = ' style="color:#b00020"' if event.mode == FAULT else ""
    joint = f", joint {event.joint + 1}" if event.joint >= 0 else ""
    return f"<div{style}>cycle {event.cycle}: {escape(plain(in_text(event)))}{joint}</div>"


def page_text(moment: Moment, state: str) -> str:
    rows = [("state", state)]
    if moment.run is not None:
        rows.append(("run", f"{moment.run.scenario} on {moment.run.arm}, {moment.run.clock} clock, {moment.run.rate_hz:g} Hz"))
    if moment.cycle is not None:
        law = f"{moment.run.law}: " if moment.run is not None else ""
        rows += [("time", f"{moment.t_s:.2f} s since active, cycle {moment.cycle}"), ("mode", MODES[moment.mode]),
                 ("active law", law + LAWS[SOURCES[moment.source]]), ("active limits", limits_at_work(moment.limits)),
                 ("force", f"{moment.force_measured:.2f} N measured, {moment.force_desired:.2f} N desired"), ("drives", drives(moment)),
                 ("bus", bus_health(moment.bus)), ("loop", f"{moment.missed} cycles missed, {moment.overruns} overruns")]
    body = "".join(f'<tr><td style="color:#777;padding-right:.6em;vertical-align:top;white-space:nowrap">{name}</td>'
                   f"<td>{escape(plain(text))}</td></tr>" for name, text in rows)
    events = "".join(event_line(event) for event in reversed(moment.events))
    return (f'<div style="font-size:13px;padding:0 .75em"><table>{body}</table>'
            f'<div style="margin-top:.5em;color:#777">events, newest first</div>{events}</div>')
