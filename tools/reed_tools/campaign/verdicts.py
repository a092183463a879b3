"""Whether a campaign holds what its file asks of all draws together."""

from dataclasses import dataclass

from reed_tools.campaign.definition import Campaign
from reed_tools.campaign.draws import Record


@dataclass
class Line:
    name: str
    value: float
    sign: str
    limit: float

    @property
    def ok(self) -> bool:
        return self.value >= self.limit if self.sign == "≥" else self.value <= self.limit


@dataclass
class Verdict:
    lines: list[Line]
    repeated: int      # draws that were run a second time
    different: list[int]  # those of them whose digest was another

    @property
    def ok(self) -> bool:
        return not self.different and all(line.ok for line in self.lines)


def judge(campaign: Campaign, records: list[Record], repeats: list[Record]) -> Verdict:
    """`repeats`: second runs of some of the draws."""
    count = max(1, len(records))
    first = {record.index: record.digest for record in records}
    lines = [Line("stable draws in percent", 100.0 * sum(record.stable for record in records) / count, "≥",
                  campaign.limits["stable_percent"]),
             Line("draws within the scenario's limits in percent", 100.0 * sum(record.within for record in records) / count, "≥",
                  campaign.limits["within_percent"]),
             Line("worst figure to its limit", max((record.ratio for record in records), default=0.0), "≤",
                  campaign.limits["worst_ratio"])]
    return Verdict(lines, len(repeats), [again.index for again in repeats if again.digest != first[again.index]])
