"""What is true of a run at one instant, gathered from batches."""

from dataclasses import dataclass, field

import numpy as np

from reed_tools.live.batch import CLOCK, Batch
from reed_tools.robots.arm_frames import points

MOST_EVENTS = 12


@dataclass
class Moment:
    cycle: int | None = None              # None: nothing has been heard of this run
    utime: int = 0
    t_s: float = 0.0                      # since the arm became active
    mode: int = 0
    source: int = 0
    limits: int = 0
    dof: int = 0
    force_desired: float = 0.0            # N
    force_measured: float = 0.0           # N
    theta_d: np.ndarray | None = None     # rad
    bent: np.ndarray | None = None        # m, [points, 3]
    rigid: np.ndarray | None = None       # m, the same points without bending
    contact_force: np.ndarray = field(default_factory=lambda: np.zeros(3))  # N, on the robot, world axes
    ages: list[int] = field(default_factory=list)
    drives: list[int] = field(default_factory=list)
    missed: int = 0
    overruns: int = 0
    run: object = None                    # the last run_t
    bus: object = None                    # the last bus_t
    events: list = field(default_factory=list)

    def update(self, batch: Batch) -> None:
        for channel, read in ((CLOCK, self.control), ("REED_SHAPE", self.shape), ("REED_PLANT", self.plant),
                              ("REED_MEASURED", self.measured), ("REED_TIMING", self.timing)):
            if (table := batch.tables.get(channel)) is not None:
                read({name: values[-1] for name, values in table.items()})
        self.run = (batch.singles.get("REED_RUN") or [self.run])[-1]
        self.bus = (batch.singles.get("REED_BUS") or [self.bus])[-1]
        happened = batch.singles.get("REED_EVENT", []) + batch.singles.get("REED_PLANT_EVENT", [])
        self.events = [*self.events, *sorted(happened, key=lambda event: event.utime)][-MOST_EVENTS:]

    def control(self, row: dict) -> None:
        self.cycle, self.utime, self.t_s = int(row["cycle"]), int(row["utime"]), float(row["t_s"])
        self.mode, self.source, self.limits = int(row["mode"]), int(row["force_source"]), int(row["limits"])
        self.force_desired, self.force_measured = float(row["f_d"]), float(row["f"])
        self.theta_d, self.dof = row["theta_d"], int(row["dof"])

    def shape(self, row: dict) -> None:
        self.bent, self.rigid = points(row, ""), points(row, "rigid_")

    def plant(self, row: dict) -> None:
        self.contact_force = row["contact_force"]

    def measured(self, row: dict) -> None:
        self.ages, self.drives = row["age"].tolist(), row["drive_state"].tolist()

    def timing(self, row: dict) -> None:
        self.missed, self.overruns = int(row["missed"]), int(row["overruns"])
