"""A page that moves and can be asked: the arm in space, curves to zoom and read values off. Everything is inside the page: scripts,
the library uPlot (show/page), and the numbers."""

import base64
import json
from pathlib import Path

import numpy as np

PAGE = Path(__file__).with_name("page")
SCRIPTS = ("uPlot.iife.min.js", "reed.js", "arm.js", "curves.js")
STYLES = ("uPlot.min.css", "interactive.css")
# No address is asked for anything: a browser refuses what this page does not hold.
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"
ARM = """<div class="interactive" id="reed-arm" hidden>
<canvas tabindex="0" aria-label="the arm in space; drag to turn it, wheel to zoom"></canvas>
<div class="controls"><button type="button" class="play">▶ play</button>
<input class="time" type="range" aria-label="time"><output class="clock"></output>
<label>speed <select class="speed"><option value="1">× 1</option><option value="0.25">× 1/4</option><option value="0.1">× 1/10</option></select></label>
<label>bending drawn <input class="scale" type="range" min="0" max="100" step="1" value="0"><output class="factor"></output></label>
<button type="button" class="home">view</button></div>
<p class="legend"></p><p class="keys hint"></p></div>"""
CURVES = '<div class="interactive" id="reed-curves" hidden></div>'


def floats(values: np.ndarray) -> dict:
    """Numbers as a page takes them: 32-bit, little-endian, base64."""
    flat = np.ascontiguousarray(values, dtype="<f4")
    return {"shape": list(flat.shape), "base64": base64.b64encode(flat.tobytes()).decode()}


def head() -> str:
    style = "\n".join((PAGE / name).read_text(encoding="utf-8") for name in STYLES)
    return f'<meta http-equiv="Content-Security-Policy" content="{POLICY}"><style>{style}</style>'


def scripts(data: dict) -> str:
    """At the end of the body. `<` in a name must not end the element."""
    numbers = json.dumps(data, allow_nan=False).replace("<", "\\u003c")
    code = "\n".join((PAGE / name).read_text(encoding="utf-8") for name in SCRIPTS)
    return f'<script type="application/json" id="reed-data">{numbers}</script>\n<script>{code}</script>'
