"""a5 with links of another shape: an upper arm of two pieces that are not in line, with different stiffnesses in both planes; a skew
flat forearm; a hand that is rigid for a part."""

from reed_tools.paths import ROOT

UPPER_1 = """[[member]]
link = 2
to_m = [0.15, 0.0, 0.1]
tube = {outer = 0.03, wall = 0.0015, material = "aluminium"}
"""
UPPER_2 = """[[member]]
link = 2
from_m = [0.15, 0.0, 0.1]
to_m = [0.35, 0.0, 0.0]
y_axis = [0.0, 1.0, 0.0]
box = {width = 0.03, height = 0.02, wall = 0.0015, material = "aluminium"}
"""
FOREARM = """[[member]]
link = 3
to_m = [0.27, 0.03, 0.0]
EA = 7.0e6
EI_y = 900.0
EI_z = 350.0
GJ = 400.0
rhoA = 0.3
"""
HAND = """[[member]]
link = 5
from_m = [0.0, 0.0, -0.15]
to_m = [0.0, 0.0, -0.05]
box = {width = 0.02, height = 0.02, wall = 0.0}
rhoA = 0.0
"""


def text(*members: str) -> str:
    """The arm file. Without members: those above."""
    a5 = (ROOT / "config/arms/a5.toml").read_text()
    rigid = a5[:a5.index("[[sections]]")] + a5[a5.index("[truth]"):]
    return "\n".join([rigid, *(members or (UPPER_1, UPPER_2, FOREARM, HAND))])
