"""A worker proves that it computes what the tool computes before it gets a run: a short run whose digest must be the tool's."""

import asyncio
import hashlib
import socket
import tempfile
from dataclasses import dataclass
from pathlib import Path

from distributed import Status
from distributed.diagnostics.plugin import WorkerPlugin

from reed_tools.paths import ARMS, SCENARIOS
from reed_tools.run import in_memory, scenario

SCENARIO, ENTRIES = "press_known", ["scenario.duration_s=0.5", "scenario.seed=77"]
verdicts: dict[str, str] = {}  # in a worker, by session: "" or why it gets no run


@dataclass(frozen=True)
class Identity:
    build: str      # of the programs
    config: str     # of config/arms and config/scenarios
    digest: str     # of the canary's run, or how it ended without one

    def difference(self, own: "Identity") -> str:
        """Why this one is not the tool's; "" if it is."""
        names = {"build": "its programs are build", "config": "its files of config/ have the digest", "digest": "its canary's digest is"}
        return next((f"{text} {getattr(self, key)[:60]}, here {getattr(own, key)[:60]}" for key, text in names.items()
                     if getattr(self, key) != getattr(own, key)), "")


def identity() -> Identity:
    return Identity(in_memory.build(), config_digest(), run())


def config_digest() -> str:
    total = hashlib.sha256()
    for path in sorted([*ARMS.glob("*.toml"), *SCENARIOS.glob("*.toml")]):
        total.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return total.hexdigest()[:12]


def run() -> str:
    with tempfile.TemporaryDirectory(prefix="reed-canary-") as scratch:
        config = Path(scratch, "effective.toml")
        ended = in_memory.run(scenario.write_effective(SCENARIO, None, ENTRIES, config), config, Path(scratch), [])
        if ended.status or ended.outcome.stopped_because:
            return f"none: {ended.outcome.stopped_because or f'status {ended.status}'}; {ended.said}"
        return ended.recording().digest("lockstep")


class Canary(WorkerPlugin):
    """Every worker of the scheduler runs it when it meets the session: at once, when it joins, and when it was started again.
    One that computes the same gets the resource that the session's runs ask for; no other gets a run."""

    def __init__(self, session: str, own: Identity):
        self.session, self.own = session, own

    def setup(self, worker) -> None:
        """Not before the worker has started: one that is lost in its start is not replaced."""
        self.proof = asyncio.ensure_future(self.prove(worker))

    async def prove(self, worker) -> None:
        while worker.status != Status.running:
            await asyncio.sleep(0.05)
        try:
            why = (await asyncio.to_thread(identity)).difference(self.own)
        except Exception as error:  # whatever it is, this worker cannot run a draw
            why = f"its canary did not run: {error}"
        if not why:
            await worker.set_resources(**{self.session: 1})
            worker.status = Status.paused   # and back: a scheduler looks for runs that wait for somebody when a worker's
            worker.status = Status.running  # status changes, and not when its resources do
        verdicts[self.session] = f"on {socket.gethostname()}: {why}" if why else ""

    async def teardown(self, worker) -> None:
        if verdicts.pop(self.session, None) == "":
            await worker.set_resources(**{self.session: 0})


def verdict(session: str) -> str | None:
    """In a worker. None: its canary has not ended yet."""
    return verdicts.get(session)
