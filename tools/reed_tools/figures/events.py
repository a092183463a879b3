"""What happened in a run: the events of both programs in one list, and why the arm stopped."""

import math

from reed_tools.figures import metrics
from reed_tools.record.event_names import in_text, name_of, stops_the_arm
from reed_tools.record.telemetry_log import Recording

UNITS = ("N", "N·m", "N·m/s", "rad", "rad/s", "m/s", "cycles")
CHANNELS = {"REED_EVENT": "controller", "REED_PLANT_EVENT": "plant"}


def of_run(recording: Recording, rate_hz: float) -> list[dict]:
    """t in s since the arm became active; joint from 0 on as in telemetry, None where it is about no single one."""
    zero = metrics.zero_cycle(recording)
    found = [(message.cycle, channel, message) for channel in CHANNELS for message in recording.singles[channel]]
    return [{"t_s": round((cycle - zero) / rate_hz, 6), "code": message.code, "name": name_of(message.code),
             "joint": message.joint if message.joint >= 0 else None,
             "value": message.value if math.isfinite(message.value) else None, "from": CHANNELS[channel], "text": in_text(message)}
            for cycle, channel, message in sorted(found, key=lambda entry: entry[0])]


def reason(events: list[dict]) -> dict | None:
    """The first event that stopped the arm."""
    trip = next((event for event in events if event["from"] == "controller" and stops_the_arm(event["code"])), None)
    return {key: trip[key] for key in ("code", "name", "joint", "value", "t_s", "text")} if trip else None


def in_words(reason: dict) -> str:
    """The unit is at the end of an event's text; it is shown behind the value."""
    what, comma, unit = reason["text"].rpartition(", ")
    what, unit = (what, f" {unit}") if comma and unit in UNITS else (reason["text"], "")
    where = f" of joint {reason['joint'] + 1}" if reason["joint"] is not None else ""
    value = f": {reason['value']:.4g}{unit}" if reason["value"] is not None else ""
    return f"{what}{where}{value}, at {reason['t_s']:.3f} s"


def cause(reason: dict | None, checks: list[dict]) -> str | None:
    """One line: why the run failed; None if it passed."""
    broken = [check for check in checks if not check["ok"]]
    if not broken:
        return None
    if reason:
        return in_words(reason)
    # What is missing explains what is too large.
    first = min(broken, key=lambda check: (check["name"] != "missing_s", check["why"] is None))
    said = f"{first['name']}: {first['why']}" if first["why"] else f"{first['name']} {first['value']:.4g}, limit {first['limit']:.4g}"
    return said + (f" (and {len(broken) - 1} more)" if len(broken) > 1 else "")
