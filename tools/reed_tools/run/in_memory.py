"""One run in lockstep, controller and plant in one process, on a bus in memory, without telemetry on the network: what the commands
with many runs are made of."""

from dataclasses import dataclass
from pathlib import Path

from reed_tools import versions
from reed_tools.run import hil, plans


@dataclass(frozen=True)
class Ended:
    plan: hil.Plan
    outcome: hil.Outcome

    @property
    def status(self) -> int:
        (status,) = self.outcome.statuses.values()
        return status

    @property
    def said(self) -> str:
        """The program's last words."""
        return hil.last_words(self.plan, self.plan.controller)

    @property
    def died(self) -> str:
        """How, of a program that neither came to the run's end, nor stopped the arm, nor refused its input."""
        if self.outcome.stopped_because or self.status not in (0, hil.STOPPED, hil.REFUSED):
            return f"{self.outcome.stopped_because or f'the program ended with {self.status}'}; {self.said}"
        return ""

    def recording(self):
        from reed_tools.record import telemetry_log  # numpy: not before something has run

        return telemetry_log.load(self.plan.log("firmware"), self.plan.log("plant"))


def programs() -> list[str]:
    return list(plans.names(hil.MEMORY).values())


def build() -> str:
    """Of the program that it runs."""
    return versions.build(programs())


def run(effective: dict, config: Path | str, folder: Path, interrupted: list | None = None, entries: list[str] = (),
        start_s: float = plans.START_S) -> Ended:
    """`effective`: the content of `config` as far as it decides how long the run may be; `start_s` is for the arm's start. Ends early
    once `interrupted` is not empty; without that list, at a signal."""
    plan = plans.make(effective, config, hil.MEMORY, "lockstep", folder, start_s, lcm=False, candump=False, lock_memory=False, entries=list(entries))
    return Ended(plan, hil.run(plan, None, interrupted))
