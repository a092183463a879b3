"""The search: points of a Sobol sequence over the whole space, then corners of it, then CMA-ES (cmaes) from the worst of them, started
again from the next worst when it has come to rest. A generation is asked for as a whole, its size follows from the number of runs, and
the search looks at the order of its values alone: it is the same with one worker and with a thousand."""

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass, field

from reed_tools.campaign.definition import unit_number
from reed_tools.worst.space import Point

SHARE = 0.25             # of the runs: points of the sequence, and as many corners
CORNER_DESIGNS = 2       # at most
LEAST_POPULATION = 8
STEP = 0.2               # of the first generation, with 1 for the whole range
CLOSE = 1e-3             # a population within this share of the range has come to rest


@dataclass(frozen=True)
class Case:
    point: Point
    ratio: float         # what is made as large as possible; -inf: refused, no case
    result: object = None


@dataclass
class Found:
    cases: list[Case] = field(default_factory=list)  # in the order in which they were asked for
    generations: int = 0

    @property
    def worst(self) -> Case:
        """Of equal ones the first."""
        return max(self.cases, key=lambda case: case.ratio)


Evaluate = Callable[[list[Point]], list[Case]]  # all of a generation, in its order; fewer after an interruption


def population(axes: int) -> int:
    return max(LEAST_POPULATION, 4 + int(3 * math.log(axes)))


def search(axes: int, runs: int, seed: int, evaluate: Evaluate) -> Found:
    """Ends early where something has no ratio any more (infinite): nothing is worse than that."""
    found, size = Found(), population(axes)
    count = 2 ** max(0, int(math.log2(max(1.0, SHARE * runs))))
    if not generation(found, sobol(axes, count, seed), evaluate) or not look_at_corners(found, axes, count, seed, evaluate):
        return found
    starts = sorted(found.cases, key=lambda case: -case.ratio)
    for restart, first in enumerate(starts):
        optimizer = optimizer_from(first.point, size, seed + restart)
        while runs > len(found.cases):
            asked = [optimizer.ask() for _ in range(min(size, runs - len(found.cases)))]
            if not generation(found, [tuple(float(u) for u in point) for point in asked], evaluate) or len(asked) < size:
                return found
            optimizer.tell([(point, -case.ratio if math.isfinite(case.ratio) else math.inf)
                            for point, case in zip(asked, found.cases[-size:])])
            if optimizer.should_stop() or spread(asked) < CLOSE:
                break
        else:
            return found
    return found


def look_at_corners(found: Found, axes: int, count: int, seed: int, evaluate: Evaluate) -> bool:
    """All of them, or a design, a second one where the first has a corner that is worse than every point inside, and the corner to which
    they point. Whether the search goes on."""
    if 2**axes <= count:
        return generation(found, list(itertools.product((0.0, 1.0), repeat=axes)), evaluate)
    inside = found.worst.ratio
    for design in range(CORNER_DESIGNS):
        if not generation(found, corners(axes, count, f"{seed}/{design}"), evaluate):
            return False
        if found.worst.ratio <= inside:
            break
    return generation(found, [pointed_at(found.cases)], evaluate)


def pointed_at(cases: list[Case]) -> Point:
    """Of every axis the end with the larger main effect on a case's rank."""
    ranked = [case.point for case in sorted(cases, key=lambda case: case.ratio)]
    return tuple(float(sum(rank * (u - 0.5) for rank, u in enumerate(axis, -len(ranked) // 2)) > 0.0) for axis in zip(*ranked))


def generation(found: Found, points: list[Point], evaluate: Evaluate) -> bool:
    """Whether the search goes on."""
    cases = evaluate(points)
    found.cases += cases
    found.generations += 1
    return len(cases) == len(points) and found.worst.ratio < math.inf


def sobol(axes: int, count: int, seed: int) -> list[Point]:
    from scipy.stats import qmc

    return [tuple(map(float, row)) for row in qmc.Sobol(axes, scramble=True, rng=seed).random(count)]


def corners(axes: int, count: int, label: str) -> list[Point]:
    """A two-level design of resolution IV in a power of 2 runs: which end an axis has says the parity of some bits of the run's number,
    which bits says its mask. Masks are odd, so any three axes have each of their eight combinations of ends equally often. More than
    count / 2 axes share masks."""
    masks = sorted(range(1, max(2, count), 2), key=lambda mask: unit_number(f"{label}/mask/{mask}"))
    turned = [unit_number(f"{label}/end/{axis}") < 0.5 for axis in range(axes)]
    return [tuple(float((run & masks[axis % len(masks)]).bit_count() % 2 != turned[axis]) for axis in range(axes)) for run in range(count)]


def optimizer_from(point: Point, size: int, seed: int):
    """What it asks for outside is moved to the border: a corner is asked for itself."""
    import numpy as np
    from cmaes import CMA

    bounds = np.array([[0.0, 1.0]] * len(point))
    return CMA(np.array(point), STEP, bounds=bounds, seed=seed % 2**32, population_size=size, n_max_resampling=1)


def spread(points) -> float:
    import numpy as np

    return float(np.ptp(np.array(points), axis=0).max())
