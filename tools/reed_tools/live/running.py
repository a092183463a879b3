"""Telemetry to page. A run that begins replaces the one before; between runs the last one stays to be seen."""

import time
from typing import TYPE_CHECKING

from reed_tools.live.batch import CLOCK, LcmFeed
from reed_tools.live.curves import History, rows
from reed_tools.live.known_run import configuration_of
from reed_tools.live.moment import Moment
from reed_tools.live.words import headline

if TYPE_CHECKING:  # it needs viser
    from reed_tools.live.page import Page

TICK_s, CURVES_s, WORDS_s = 1 / 60, 0.2, 0.25
DEFAULT_RATE_hz = 1000.0


class Running:
    def __init__(self):
        self.feed = LcmFeed()
        self.heard = time.monotonic()
        self.begin()

    def begin(self) -> None:
        self.moment, self.history = Moment(), History()
        self.rate_hz, self.parameters = DEFAULT_RATE_hz, None  # None: the run is not known yet

    def forever(self, page: "Page") -> None:
        curves_at = words_at = 0.0
        while True:
            started = time.monotonic()
            self.tick(page, started)
            if started - curves_at >= CURVES_s and not page.pause.value:
                curves_at = started
                page.draw(self.history)
            if started - words_at >= WORDS_s and not page.pause.value:
                words_at = started
                page.say(self.moment, headline(self.moment, started - self.heard))
            time.sleep(max(0.0, TICK_s - (time.monotonic() - started)))

    def tick(self, page: "Page", now: float) -> None:
        batch = self.feed.take()
        if not batch:
            return
        self.heard = now
        if batch.restarted:
            self.begin()
            page.forget_trace()
        self.moment.update(batch)
        if self.parameters is None and self.moment.cycle is not None and "REED_ADAPTATION" in batch.tables:
            self.meet(page, batch.tables["REED_ADAPTATION"]["p_hat"].shape[1])
        if self.parameters is not None:
            self.history.add(rows(batch, self.rate_hz, self.parameters))
        if CLOCK in batch.tables and not page.pause.value:
            page.show(self.moment)

    def meet(self, page: "Page", parameters: int) -> None:
        effective = configuration_of(self.moment.run, self.moment.dof)
        self.rate_hz = effective["timing"]["rate_hz"] if effective else DEFAULT_RATE_hz
        self.parameters = parameters
        page.know(self.moment.dof, parameters, effective)
