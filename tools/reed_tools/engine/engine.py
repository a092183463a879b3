"""Runs side by side, by Dask.

    with Engine(jobs, scheduler) as engine:
        for item, result in engine.map(function, items): ...

`function(item, interrupted)` runs in a worker. Its result follows from the item and the build alone, so what a lost worker had not
finished is run again by another one, and the result is the same. It returns None where the list `interrupted`, empty at first,
is not empty any more before the end."""

import itertools
import pickle
import queue
import threading
import time
import uuid
from contextlib import ExitStack, suppress

from reed_tools.engine import place, task, worker
from reed_tools.errors import ReedError, RunError, UsageError
from reed_tools.run import hil

POLL_S = 0.2
LOOK_S = 5.0             # between looks at who has joined and who has left
WORKERS_PATIENCE_S = 60.0  # without any worker at the start
LOST_PATIENCE_S = 300.0    # without any that is left, or comes back
STOP_PATIENCE_S = 2 * hil.STOP_PATIENCE_S
HEAR_PATIENCE_S = 30.0      # for workers that have not said at the end whether they may run
AHEAD = 2                # runs given to a worker: it never waits for the next one


class Engine:
    def __init__(self, jobs: int, scheduler: str | None = None):
        self.jobs, self.scheduler = jobs, scheduler
        self.session = f"reed-{uuid.uuid4().hex[:12]}"
        self.accepted: list[str] = []     # addresses of workers
        self.refused: dict[str, str] = {}  # and why
        self.stopped = False
        self.asked: list = []              # filled by a signal

    # ---- from start to end ----

    def __enter__(self):
        self.stack = ExitStack()
        with ExitStack() as stack:
            self.asked = stack.enter_context(hil.stop_requests())
            self.client = stack.enter_context(place.client(self.jobs, self.scheduler))
            from reed_tools.engine import canary  # it imports distributed

            self.canary = canary
            stack.callback(self.leave)
            own = canary.Canary(self.session, canary.identity())
            with suppress(OSError):  # a worker was lost that ran its canary: the scheduler has the plugin, for it too when it is back
                self.client.register_plugin(own, name=self.session)
            self.await_workers()
            self.stack = stack.pop_all()
        return self

    def __exit__(self, *_):
        self.stack.close()

    @property
    def interrupted(self) -> bool:
        return bool(self.asked)

    def leave(self) -> None:
        """Runs that are left end; workers of a scheduler stay for others."""
        self.hear_the_rest()
        self.stop_runs()
        if self.scheduler and self.client.status == "running":
            with suppress(OSError):  # likewise
                self.client.unregister_worker_plugin(self.session)

    # ---- workers ----

    def await_workers(self) -> None:
        """Until one may run something."""
        end = time.monotonic() + WORKERS_PATIENCE_S
        while not self.look() and not self.interrupted:
            undecided = len(self.known) - len(self.refused)
            if self.refused and not undecided:
                raise UsageError(f"--scheduler {self.scheduler}: no worker computes what this build computes; the first "
                                 f"{next(iter(self.refused.values()))}" if self.scheduler else next(iter(self.refused.values())))
            if time.monotonic() > end and not undecided:
                raise UsageError(f"--scheduler {self.scheduler}: it has no worker after {WORKERS_PATIENCE_S:g} s; docs/cluster.md starts one")
            time.sleep(POLL_S)

    def look(self) -> bool:
        """Who may run something now. Workers that may not are named once."""
        self.known = self.client.run(self.canary.verdict, self.session, on_error="ignore")
        self.accepted = [address for address, why in self.known.items() if why == ""]
        for address, why in self.known.items():
            if why and address not in self.refused:
                self.refused[address] = why
                print(f"  worker {address} is left out, {why}", flush=True)
        self.refused = {address: why for address, why in self.refused.items() if address in self.known}
        self.looked = time.monotonic()
        return bool(self.accepted)

    def hear_the_rest(self) -> None:
        """A short campaign can be over before a worker with another build has said so."""
        end = time.monotonic() + HEAR_PATIENCE_S
        while self.scheduler and not self.interrupted and self.client.status == "running" and time.monotonic() < end:
            self.look()
            if len(self.accepted) + len(self.refused) == len(self.known):
                return
            time.sleep(POLL_S)

    def stop_runs(self) -> None:
        """Programs end in order, as after a Ctrl-C in a run; a worker that does not answer is left to the end of its cluster."""
        if not self.stopped and self.client.status == "running":
            self.stopped = True
            asking = threading.Thread(target=self.client.run, args=(worker.stop, self.session), kwargs={"on_error": "ignore"}, daemon=True)
            asking.start()
            asking.join(STOP_PATIENCE_S)

    # ---- runs ----

    def map(self, function, items):
        """Yields (item, result) in the order in which they are done. Raises what `function` raised. After a signal `interrupted` is
        set, what runs is ended, and what was done by then is yielded."""
        waiting, running, done = iter(items), {}, queue.Queue()
        call, packed = task.travelling(), pickle.dumps(function)
        lonely_since = given_up = None
        try:
            while True:
                room = 0 if self.interrupted else AHEAD * len(self.accepted) - len(running)
                for item in itertools.islice(waiting, max(0, room)):
                    future = self.client.submit(call, packed, pickle.dumps(item), self.session, resources={self.session: 1},
                                                key=f"{self.session}-{uuid.uuid4().hex}", pure=False)
                    running[future] = item
                    future.add_done_callback(done.put)
                if self.interrupted:
                    self.stop_runs()
                    given_up = given_up or time.monotonic() + STOP_PATIENCE_S
                if not running or given_up and time.monotonic() > given_up:
                    return
                try:
                    future = done.get(timeout=POLL_S)
                except queue.Empty:
                    lonely_since = self.check(lonely_since)
                    continue
                item = running.pop(future)
                result = self.result(future, item)
                if result is not None:
                    yield item, result
        finally:
            if running:
                self.client.cancel(list(running))

    def check(self, lonely_since: float | None) -> float | None:
        """While nothing comes: whether anybody is still there who works. Returns since when nobody is."""
        if self.client.status != "running":
            raise RunError(f"the scheduler {self.scheduler or 'of the local workers'} was lost")
        now = time.monotonic()
        if now - self.looked > LOOK_S and not self.interrupted and self.look():
            return None
        if self.accepted or len(self.known) > len(self.refused):  # one of them runs its canary
            return None
        if lonely_since and now - lonely_since > LOST_PATIENCE_S:
            raise RunError(f"every worker was lost, and none came back within {LOST_PATIENCE_S:g} s")
        return lonely_since or now

    def result(self, future, item):
        from distributed import CancelledError, KilledWorker

        try:
            return future.result()
        except ReedError:
            raise
        except KilledWorker:
            raise RunError(f"{item}, or the run before it: {place.MOST_LOSSES + 1} workers died that had it") from None
        except CancelledError:
            raise RunError(f"the scheduler {self.scheduler or 'of the local workers'} was lost") from None
        except Exception as error:
            raise RunError(f"internal error in a worker, {type(error).__name__}: {error}") from None
