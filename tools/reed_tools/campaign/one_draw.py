"""One draw, in a worker: run in lockstep on a bus in memory, and judged by the scenario's checks."""

import contextlib
import functools
import tempfile
from pathlib import Path

from reed_tools.campaign.definition import Campaign
from reed_tools.campaign.draws import Record
from reed_tools.errors import UsageError
from reed_tools.run import hil, in_memory, scenario

NOT_READ_BY_FIGURES = ("wall.", "plant.", "force.", "disturbance.", "sensors.", "drives.", "link.", "scenario.seed")


def known_to_figures(campaign: Campaign, entries: list[str]) -> dict:
    """A draw's configuration as far as figures read it. The program reads and checks all of it; where no figure can differ, it is
    not written and parsed again for every draw."""
    if all(drawn.key.startswith(NOT_READ_BY_FIGURES) for drawn in campaign.drawn):
        with contextlib.suppress(UsageError):  # what is wrong without the drawn numbers may be right with them
            return effective_of(campaign.scenario, campaign.fixed)
    return effective_of(campaign.scenario, tuple(entries))


@functools.lru_cache(maxsize=1)
def effective_of(name: str, entries: tuple[str, ...]) -> dict:
    with tempfile.TemporaryDirectory(prefix="reed-draw-") as scratch:
        return scenario.write_effective(name, None, list(entries), Path(scratch, "effective.toml"))


def run_draw(campaign: Campaign, build: str, index: int, interrupted: list) -> Record | None:
    """None: interrupted before the end."""
    try:
        return run_entries(campaign, build, index, campaign.overrides(index), interrupted)
    except UsageError as error:
        raise UsageError(f"draw {index}: {error}") from None


def run_entries(campaign: Campaign, build: str, index: int, entries: list[str], interrupted: list) -> Record | None:
    """The campaign's scenario with `entries` over it. Raises what refuses them."""
    from reed_tools.figures import checks, summary
    from reed_tools.record import signals

    record = Record(index, campaign.definition(), build, entries, "finished")
    effective = known_to_figures(campaign, entries)
    with tempfile.TemporaryDirectory(prefix="reed-draw-") as scratch:
        ended = in_memory.run(effective, campaign.scenario, Path(scratch), interrupted, entries)
        if ended.outcome.interrupted:
            return None
        if ended.status == hil.REFUSED:
            raise UsageError(ended.said)
        if ended.died:
            record.status, record.message = "died", ended.died
            return record
        if ended.status == hil.STOPPED:
            record.status, record.message = "fault", ended.said
        recording = ended.recording()
        data = summary.run_data(effective, recording, signals.join(recording))
        record.checks, record.digest = checks.evaluate(effective["checks"], data), recording.digest("lockstep")
        record.stability = checks.evaluate(campaign.stable, data)
    return record
