"""What a case does not need: its parameters go back to nominal, one after the other, while it still fails, or, where it fails nothing,
while it stays the worst."""

from collections.abc import Callable

from reed_tools.worst.search import Case, Evaluate

STAYS = 0.95  # of its ratio: still the worst


def still(worst: Case) -> Callable[[Case], bool]:
    """A case that fails may lose ratio, as long as it fails by the same figure."""
    if worst.ratio > 1.0:
        return lambda case: case.ratio > 1.0 and figure(case) == figure(worst)
    return lambda case: case.ratio >= STAYS * worst.ratio


def figure(case: Case) -> str:
    return getattr(case.result, "aim", "")


def shrink(worst: Case, evaluate: Evaluate) -> tuple[Case, Case]:
    """Tries every parameter that is left, and gives up the one whose loss costs least; until each is needed. Returns the worst case,
    which may be one on the way, and the reduced one."""
    case = worst
    while True:
        holds = still(worst)
        kept = [axis for axis, u in enumerate(case.point) if u is not None]
        tried = [one for one in evaluate([without(case.point, axis) for axis in kept]) if holds(one)]
        if not tried:
            return worst, case
        case = max(tried, key=lambda one: one.ratio)
        worst = max(worst, case, key=lambda one: one.ratio)


def without(point, axis: int):
    return tuple(None if position == axis else u for position, u in enumerate(point))
