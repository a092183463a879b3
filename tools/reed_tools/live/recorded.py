"""A finished run on the page: the same moments and curves, at the time that a slider says."""

import math
import time
from pathlib import Path
from typing import TYPE_CHECKING

from reed_tools.errors import UsageError
from reed_tools.live.batch import CLOCK, until, whole
from reed_tools.live.curves import History, rows
from reed_tools.live.moment import Moment
from reed_tools.record import configuration, run_folder
from reed_tools.record.telemetry_log import load
from reed_tools.robots.joint_frames import dof

if TYPE_CHECKING:  # it needs viser
    from reed_tools.live.page import Page

TICK_s, CURVES_s = 1 / 60, 0.2


def require(folder: Path) -> None:
    for name in ("effective.toml", "telemetry.lcmlog"):
        if not (folder / name).is_file():
            raise UsageError(f"{folder} is not a run folder: it has no {name}")
    run_folder.require_unchanged(folder)


class Recorded:
    def __init__(self, folder: Path):
        self.name = folder.resolve().name
        self.effective = configuration.load(folder / "effective.toml")
        self.recording = load(folder / "telemetry.lcmlog")
        if not (self.recording.has(CLOCK) and self.recording.has("REED_ADAPTATION")):
            raise UsageError(f"{folder / 'telemetry.lcmlog'} holds no cycle: there is nothing to show")
        utime = self.recording.tables[CLOCK]["utime"]
        self.start_us, self.length_s = int(utime[0]), float(utime[-1] - utime[0]) / 1e6
        self.parameters = self.recording.tables["REED_ADAPTATION"]["p_hat"].shape[1]
        self.history = History(math.inf)
        self.history.add(rows(whole(self.recording), self.effective["timing"]["rate_hz"], self.parameters))

    def moment(self, at_s: float) -> Moment:
        moment = Moment()
        moment.update(until(self.recording, self.start_us + round(at_s * 1e6)))
        return moment

    def forever(self, page: "Page") -> None:
        page.know(dof(self.effective["arm"]), self.parameters, self.effective)
        at_s = page.server.gui.add_slider("time [s]", min=0.0, max=round(self.length_s, 3), step=0.001, initial_value=0.0, order=-2)
        play = page.server.gui.add_checkbox("play", True, order=-1)
        shown, drawn, drawn_at = None, None, 0.0
        while True:
            started = time.monotonic()
            if play.value and not page.pause.value:
                at_s.value = 0.0 if at_s.value >= self.length_s - TICK_s else round(at_s.value + TICK_s, 3)
            if (wanted := (at_s.value, page.scale.value)) != shown:
                if shown and wanted[0] < shown[0]:
                    page.forget_trace()
                shown, moment = wanted, self.moment(at_s.value)
                page.show(moment)
            if started - drawn_at >= CURVES_s and drawn != (*shown, page.window_s.value):
                drawn, drawn_at = (*shown, page.window_s.value), started
                page.draw(self.history, self.start_us + shown[0] * 1e6)
                page.say(moment, f"recorded: {self.name}")
            time.sleep(max(0.0, TICK_s - (time.monotonic() - started)))
