"""The page: space in the middle, curves on the left, words and controls on the right."""

import contextlib
import io

import viser

from reed_tools.live.curves import LONGEST_s, History, Plot, plots
from reed_tools.live.diagrams import Diagrams
from reed_tools.live.moment import Moment
from reed_tools.live.space import Space
from reed_tools.live.words import page_text

CURVES_px = 460
CAMERA_m, LOOK_AT_m = (0.7, -0.88, 0.55), (0.2, 0.0, 0.2)


class Page:
    def __init__(self, host: str, port: int):
        with contextlib.redirect_stdout(io.StringIO()):  # its own banner; the command says where the page is
            self.server = viser.ViserServer(host=host, port=port, label="Reed", verbose=False)
        gui = self.server.gui
        gui.configure_theme(control_layout="fixed", control_width="medium", show_logo=False, show_share_button=False)
        gui.set_panel_label("Reed")
        self.server.initial_camera.position, self.server.initial_camera.look_at = CAMERA_m, LOOK_AT_m
        self.scale = gui.add_slider("bending drawn ×", min=1, max=50, step=1, initial_value=1)
        self.window_s = gui.add_slider("curves, last s", min=1, max=LONGEST_s, step=1, initial_value=10)
        self.pause = gui.add_checkbox("pause", False)
        self.words = gui.add_html("")
        self.count = gui.add_html("")
        panel = gui.add_panel()
        self.tab = panel.add_tab("Curves")
        panel.dock_left()
        panel.set_width(CURVES_px)
        self.updates = 0
        self.diagrams: Diagrams | None = None
        self.all_diagrams: dict[str, Diagrams] = {}  # by the plots that they show
        self.space: Space | None = None
        self.known: tuple | None = None

    def know(self, dof: int, parameters: int, effective: dict | None) -> None:
        """Builds what depends on the arm; the same arm again keeps the page as it is."""
        names = effective["arm"]["param_names"] if effective and len(effective["arm"]["param_names"]) == parameters else \
            [f"p{k + 1}" for k in range(parameters)]
        known = (dof, tuple(names), repr(effective))
        if known == self.known:
            return
        self.known = known
        with self.server.atomic():
            self.server.scene.reset()
            self.server.scene.configure_default_lights(cast_shadow=False)
            self.space = Space(self.server, effective)
            self.use_diagrams(plots(dof, effective, names))

    def use_diagrams(self, wanted: list[Plot]) -> None:
        """Those with these plots, new or from a run before; the others are hidden."""
        if self.diagrams:
            self.diagrams.show(False)
        if (key := repr(wanted)) not in self.all_diagrams:
            with self.tab:
                self.all_diagrams[key] = Diagrams(self.server, wanted)
        self.diagrams = self.all_diagrams[key]
        self.diagrams.show(True)

    def show(self, moment: Moment) -> None:
        """The state of this instant: once per update, counted on the page."""
        self.updates += 1
        with self.server.atomic():
            if self.space:
                self.space.show(moment, self.scale.value)
            self.count.content = f'<span id="reed-updates" style="color:#aaa;font-size:11px;padding:0 .75em">update {self.updates}</span>'

    def forget_trace(self) -> None:
        if self.space:
            self.space.forget_trace()

    def draw(self, history: History, until_utime: float | None = None) -> None:
        """Curves and trace: what is sent whole."""
        with self.server.atomic():
            if self.space:
                self.space.draw_trace(self.scale.value)
            if self.diagrams:
                self.diagrams.draw(history.window(self.window_s.value, until_utime))

    def say(self, moment: Moment, state: str) -> None:
        if (text := page_text(moment, state)) != self.words.content:
            self.words.content = text
