"""What test_engine.py lets the engine do in a process of its own."""

import os
import resource
import signal
import time

from reed_tools.errors import ReedError, UsageError

DRAWS = 6


def nothing(item, interrupted):
    return item


def refuse_three(item, interrupted):
    if item == 3:
        raise UsageError("item 3: no")
    return item


def kill_two(item, interrupted):
    if item == 2:
        os.kill(os.getpid(), signal.SIGKILL)
    return item


def main(what: str) -> None:
    from reed_tools.engine import canary
    from reed_tools.engine.engine import Engine

    if what == "another":
        own = canary.identity()
        canary.identity = lambda: canary.Identity(own.build, own.config, "0123")  # of the tool; the workers import their own
    try:
        with Engine(1) as engine:
            run(engine, what)
    except ReedError as error:
        print(f"{type(error).__name__}: {error}")
    if what == "overhead":
        print(cost_ms(Engine))


def run(engine, what: str) -> None:
    if what == "overhead":
        return
    function = {"raise": refuse_three, "kill": kill_two}.get(what, nothing)
    assert sorted(item for item, _ in engine.map(function, range(5)))


def cost_ms(engine_of) -> float:
    """CPU time of tool and workers per item, the difference between many and none."""
    def total(count):
        before = time.process_time() + children()
        with engine_of(1) as engine:
            assert [item for item, result in engine.map(nothing, range(count)) if item != result] == []
        return time.process_time() + children() - before

    def children():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    none, many = total(1), total(401)
    return 1e3 * (many - none) / 400
