"""What a campaign draws, as a space: a point has a number from 0 to 1 for everything that is drawn. The seed of the noise is none of it:
it is the scenario's own."""

from dataclasses import dataclass

from reed_tools.campaign.definition import Campaign, Drawn, text_of
from reed_tools.errors import UsageError

SEED = "scenario.seed"


@dataclass(frozen=True)
class Axis:
    drawn: Drawn
    entry: int | None   # of a list whose entries are drawn each by itself

    @property
    def name(self) -> str:
        return self.drawn.key if self.entry is None else f"{self.drawn.key}[{self.entry}]"


Point = tuple[float | None, ...]  # by axis; None: nominal, what it is where nothing is drawn


class Space:
    def __init__(self, campaign: Campaign):
        self.campaign = campaign
        self.drawn = [drawn for drawn in campaign.drawn if drawn.key != SEED]
        self.axes = [Axis(drawn, entry) for drawn in self.drawn
                     for entry in (range(len(drawn.times)) if isinstance(drawn.times, list) else [None])]
        if not self.axes:
            raise UsageError(f"campaign {campaign.name}: nothing is drawn but the noise: no space to search; [[draw]] names what has a range")

    def entries(self, point: Point) -> list[str]:
        """As overrides. Of a list a nominal entry has the factor 1; other nominal values are left to the scenario."""
        found, values = list(self.campaign.fixed), iter(point)
        for drawn in self.drawn:
            if isinstance(drawn.times, list):
                numbers = [base if (u := next(values)) is None else drawn.at(u) * base for base in drawn.times]
                found.append(f"{drawn.key}={text_of(numbers)}")
            elif (u := next(values)) is not None:
                factor = drawn.at(u)
                found.append(f"{drawn.key}={text_of(factor if drawn.times is None else factor * drawn.times)}")
        return found
