"""--jobs and --scheduler: where runs go, the same for every command that runs many."""

import os
import re

from reed_tools.errors import UsageError

MOST_JOBS = 1024
ADDRESS = re.compile(r"(tcp|tls)://(\[[0-9A-Fa-f:.]+\]|[^\s/:\[\]]+):([0-9]{1,5})")


def add_arguments(parser) -> None:
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--jobs", type=int, metavar="N", help="runs at a time on this machine; default: one per core that this process may use")
    where.add_argument("--scheduler", metavar="tcp://HOST:PORT", help="on the workers of this Dask scheduler (docs/cluster.md)")


def check(arguments) -> None:
    """A mistake is a line before anything starts."""
    if arguments.jobs is not None and not 1 <= arguments.jobs <= MOST_JOBS:
        raise UsageError(f"--jobs {arguments.jobs}: allowed: a whole number from 1 to {MOST_JOBS}")
    found = ADDRESS.fullmatch(arguments.scheduler) if arguments.scheduler is not None else None
    if arguments.scheduler is not None and (found is None or not 1 <= int(found[3]) <= 65535):
        raise UsageError(f"--scheduler {arguments.scheduler}: allowed: tcp://HOST:PORT or tls://HOST:PORT of a Dask scheduler")


def jobs(arguments) -> int:
    return arguments.jobs or len(os.sched_getaffinity(0))


def place(arguments) -> str:
    """For people: where the runs go."""
    return f"on the workers of {arguments.scheduler}" if arguments.scheduler else f"{jobs(arguments)} at a time"
