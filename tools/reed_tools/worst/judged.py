"""What a run says about a point: the ratio of its worst figure to its limit, and the line that repeats it."""

import math
import shlex
from dataclasses import dataclass

from reed_tools.campaign import one_draw
from reed_tools.campaign.definition import Campaign
from reed_tools.campaign.draws import Record
from reed_tools.errors import UsageError

REFUSED = "refused"  # status of a record whose configuration no arm would start with


@dataclass(frozen=True)
class Judged:
    record: Record

    @property
    def ratio(self) -> float:
        """A point that is refused at start is no case."""
        return -math.inf if self.record.status == REFUSED else self.record.ratio

    @property
    def aim(self) -> str:
        """The figure that decides, or how the run ended."""
        check = self.record.deciding
        return check["name"] if check else self.record.status

    @property
    def value(self) -> float | None:
        """Of that figure."""
        check = self.record.deciding
        return check["value"] if check else None

    def line(self, scenario: str) -> str:
        words = ["tools/reed", "run", scenario, "--bus", "memory"]
        for entry in self.record.overrides:
            words += ["--set", entry]
        return shlex.join(words)

    def text(self) -> str:
        check = self.record.deciding
        if not check or self.record.message:
            return f"{self.record.status}: {self.record.message}"
        value = "no value" if check["value"] is None else f"{check['value']:g}"
        return f"{check['name']} = {value}, limit {check['limit']:g}"


def run(campaign: Campaign, build: str, item: tuple[int, list[str]], interrupted: list) -> Judged | None:
    """In a worker."""
    number, entries = item
    try:
        record = one_draw.run_entries(campaign, build, number, entries, interrupted)
    except UsageError as error:
        record = Record(number, campaign.definition(), build, entries, REFUSED, str(error))
    return record and Judged(record)
