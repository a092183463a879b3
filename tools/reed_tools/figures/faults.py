"""The faults of a scenario, and whether they were injected: one that was not is no test of anything."""

from reed_tools.figures import metrics
from reed_tools.record.event_names import name_of
from reed_tools.record.telemetry_log import Recording


def of_run(effective: dict, recording: Recording, rate_hz: float) -> list[dict]:
    """t in s since the arm became active; None: it never began, or it did not end."""
    zero = metrics.zero_cycle(recording)
    times: dict[tuple[str, int], float] = {}
    for message in recording.singles["REED_PLANT_EVENT"]:
        times.setdefault((name_of(message.code), int(message.value)), round((message.cycle - zero) / rate_hz, 6))
    return [{"id": fault["id"], "target": fault["target"], "kind": fault["kind"], "from_s": times.get(("fault_begins", number)),
             "to_s": times.get(("fault_ends", number)), "executed": ("fault_begins", number) in times}
            for number, fault in enumerate(effective.get("fault", []))]


def checks(injected: list[dict]) -> list[dict]:
    """A line of the verdict, in a scenario with faults."""
    idle = [fault["id"] for fault in injected if not fault["executed"]]
    why = f"not executed, what starts it never came: {', '.join(idle)}" if idle else None
    return [{"name": "faults_not_executed", "limit": 0, "value": len(idle), "ok": not idle, "why": why}] if injected else []
