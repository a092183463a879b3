"""One gain after the other, up and down, within the rules. The order is fixed and ties keep what there is: the same gains on one
core and on a hundred."""

import math
from collections.abc import Callable
from dataclasses import astuple, dataclass

from reed_tools.errors import UsageError
from reed_tools.tune.gains import STEPS, Gains
from reed_tools.tune.margins import Margin
from reed_tools.tune.trials import Trial

PASSES, MOST_REPEATS = 2, 4
LEAST_GAIN = 0.02          # of the score: less is not worth a change
RESERVE = Margin(2.5, 30.0)  # what a change has to leave, more than the configuration asks for


@dataclass(frozen=True)
class Step:
    what: str        # "K_d x 1.4"
    gains: Gains
    margin: Margin
    trial: Trial
    taken: bool
    refused: int     # candidates that a rule refused in this step


def improve(start: Step, margin_of: Callable[[Gains], Margin], judge: Callable[[list[Gains]], list[Trial]], told: Callable[[Step], None]) -> Step:
    """`margin_of` raises UsageError for gains that break a rule. `judge` runs many at once. `told` is called after every step."""
    best = start
    for _ in range(PASSES):
        before = best
        for key, _ in start.gains.values:
            best = along(best, key, margin_of, judge, told)
        if best is before:
            break
    return best


def along(best: Step, key: str, margin_of, judge, told) -> Step:
    factors = list(STEPS[key])
    for _ in range(MOST_REPEATS):
        allowed, refused = [], 0
        for factor in factors:
            gains = best.gains.scaled(key, factor)
            try:
                margin = margin_of(gains)
            except UsageError:
                refused += 1
                continue
            if enough(margin, best.margin):
                allowed.append((factor, gains, margin))
            else:
                refused += 1
        trials = judge([gains for _, gains, _ in allowed])
        found = min(zip(allowed, trials), key=lambda pair: pair[1].score, default=None)
        name = key.partition(".")[2]
        if found is None or not found[1].score < (1 - LEAST_GAIN) * best.trial.score:
            told(Step(f"{name} stays", best.gains, best.margin, best.trial, False, refused))
            return best
        (factor, gains, margin), trial = found
        best = Step(f"{name} x {factor:.2g}", gains, margin, trial, True, refused)
        told(best)
        factors = [factor]   # on in the same direction
    return best


def enough(margin: Margin, before: Margin) -> bool:
    """The reserve, or no less than there was."""
    return all(new >= min(old, least) for new, old, least in zip(astuple(margin), astuple(before), astuple(RESERVE)))


def usable(trial: Trial) -> bool:
    return math.isfinite(trial.score)
