"""Where the workers are: a cluster of this machine's cores that ends with the command, or a scheduler that somebody else started."""

import logging
import socket
import tempfile
import warnings
from contextlib import contextmanager
from urllib.parse import urlsplit

from reed_tools.errors import UsageError

LOOPBACK = "127.0.0.1"
MOST_LOSSES = 3  # workers that one run may take with it before it is the run's fault
CONNECT_S = 10.0
QUIET = {"distributed": "critical", "distributed.client": "critical", "tornado": "critical", "tornado.application": "critical", "asyncio": "critical"}


@contextmanager
def client(jobs: int, scheduler: str | None):
    """A Dask client."""
    warnings.simplefilter("ignore")  # what Dask has to say about ports and versions; what decides is the canary
    import dask

    dask.config.set({"logging": QUIET, "distributed.scheduler.allowed-failures": MOST_LOSSES})  # read when distributed is imported
    with (of_scheduler(scheduler) if scheduler else of_this_machine(jobs)) as found:
        yield found


@contextmanager
def of_scheduler(address: str):
    from distributed import Client

    try:
        place = urlsplit(address)
        if place.scheme == "tcp" and place.hostname and place.port:  # Dask goes on trying where nobody listens
            socket.create_connection((place.hostname, place.port), CONNECT_S).close()
        found = Client(address, timeout=CONNECT_S, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise UsageError(f"--scheduler {address}: no Dask scheduler answers there: {str(error) or type(error).__name__}") from None
    try:
        yield found
    finally:
        found.close()


@contextmanager
def of_this_machine(jobs: int):
    """On the loopback interface alone. Scratch of all workers is one folder: what a killed one leaves goes with it."""
    import dask
    from distributed import Client, LocalCluster

    with tempfile.TemporaryDirectory(prefix="reed-workers-", ignore_cleanup_errors=True) as scratch:
        dask.config.set({"temporary-directory": scratch})
        with LocalCluster(n_workers=jobs, threads_per_worker=1, processes=True, host=LOOPBACK, dashboard_address=f"{LOOPBACK}:0",
                          worker_dashboard_address=None, memory_limit=None, local_directory=scratch, env={"TMPDIR": scratch},
                          silence_logs=logging.CRITICAL) as cluster, Client(cluster, set_as_default=False) as found:
            yield found
