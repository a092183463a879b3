"""How good gains are: the scenario's checks over a few draws that differ in what a controller cannot know."""

import math
from dataclasses import dataclass

from reed_tools.campaign import one_draw
from reed_tools.campaign.definition import Campaign
from reed_tools.campaign.draws import ratio_of

RIPPLE = {"name": "torque_ripple_percent_last_second", "limit": 2.0}  # of the torque limit: more is an oscillation
WALLS, SPRINGS, FRICTIONS = (1.0, 0.6, 1.6), (1.0, 1.1, 0.8), (1.0, 0.7, 1.5)  # times the scenario's, draw after draw
SHARPNESS = 4  # of the mean over checks: the worst figures decide, the others count a little


@dataclass(frozen=True)
class Trial:
    score: float             # 1: every figure at its limit; inf: refused, stopped, or it oscillates
    why: str                 # of an infinite one
    worst: tuple[str, float] # the figure that is closest to its limit, and its share of it


def draws(effective: dict, count: int) -> list[list[str]]:
    """Overrides of each draw. The first is the scenario itself."""
    found = []
    for number in range(count):
        entries = [f"scenario.seed={effective['scenario']['seed'] + number}"]
        if number:
            at = number % len(WALLS)
            entries += [f"plant.stiffness_scale={effective['plant']['stiffness_scale'] * SPRINGS[at]:.6g}",
                        f"plant.friction_scale={effective['plant']['friction_scale'] * FRICTIONS[at]:.6g}"]
            entries += [f"wall.stiffness_Npm={effective['wall']['stiffness_Npm'] * WALLS[at]:.6g}"] if effective["wall"]["present"] else []
        found.append(entries)
    return found


@dataclass(frozen=True)
class Item:
    candidate: int
    draw: int
    fixed: tuple[str, ...]    # overrides of every draw of the candidate: its gains are among them
    drawn: tuple[str, ...]    # of this draw


def run(scenario: str, build: str, item: Item, interrupted: list):
    """In a worker. The campaign has no file: its records are not kept."""
    campaign = Campaign("tune", "", scenario, 1, 0, {}, [RIPPLE], item.fixed, (), "")
    return one_draw.run_entries(campaign, build, item.draw, [*item.fixed, *item.drawn], interrupted)


def judge(records: list) -> Trial:
    """Of one candidate's draws."""
    for record in records:
        if not record.stable:
            broken = [check for check in [*record.stability, *record.checks] if check["value"] is None or not check["ok"]]
            why = record.message or f"{broken[0]['name']} is {broken[0]['value']}"
            return Trial(math.inf, why, ("", math.inf))
    shares = [(check["name"], ratio_of(check)) for record in records for check in record.checks if check["limit"] > 0]
    exact = [check["name"] for record in records for check in record.checks if check["limit"] <= 0 and not check["ok"]]
    if exact:
        return Trial(math.inf, f"{exact[0]} is not 0", ("", math.inf))
    if not shares:
        return Trial(math.inf, "the scenario checks no figure that gains can change", ("", math.inf))
    score = (sum(share ** SHARPNESS for _, share in shares) / len(shares)) ** (1 / SHARPNESS)
    return Trial(score, "", max(shares, key=lambda entry: entry[1]))
