"""The search: points of a Sobol sequence over the whole space, then CMA-ES (cmaes) from the worst of them, started again from the next
worst when it has come to rest. A generation is asked for as a whole and has always the same size, and the search looks at the order
of its values alone: it is the same with one worker and with a thousand."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from reed_tools.worst.space import Point

SOBOL_SHARE = 0.25       # of the runs
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
    start = 2 ** max(0, int(math.log2(max(1.0, SOBOL_SHARE * runs))))
    if not generation(found, sobol(axes, start, seed), evaluate):
        return found
    starts = sorted(found.cases, key=lambda case: -case.ratio)
    for restart, first in enumerate(starts):
        optimizer = optimizer_from(first.point, size, seed + restart)
        while runs - len(found.cases) >= size:
            asked = [optimizer.ask() for _ in range(size)]
            if not generation(found, [tuple(float(u) for u in point) for point in asked], evaluate):
                return found
            optimizer.tell([(point, -case.ratio if math.isfinite(case.ratio) else math.inf)
                            for point, case in zip(asked, found.cases[-size:])])
            if optimizer.should_stop() or spread(asked) < CLOSE:
                break
        else:
            return found
    return found


def generation(found: Found, points: list[Point], evaluate: Evaluate) -> bool:
    """Whether the search goes on."""
    cases = evaluate(points)
    found.cases += cases
    found.generations += 1
    return len(cases) == len(points) and found.worst.ratio < math.inf


def sobol(axes: int, count: int, seed: int) -> list[Point]:
    from scipy.stats import qmc

    return [tuple(map(float, row)) for row in qmc.Sobol(axes, scramble=True, rng=seed).random(count)]


def optimizer_from(point: Point, size: int, seed: int):
    import numpy as np
    from cmaes import CMA

    bounds = np.array([[0.0, 1.0]] * len(point))
    return CMA(np.array(point), STEP, bounds=bounds, seed=seed % 2**32, population_size=size)


def spread(points) -> float:
    import numpy as np

    return float(np.ptp(np.array(points), axis=0).max())
