"""The arm in space: as it bends, desired, wall, force, trace of the tip."""

import numpy as np
import viser

from reed_tools.live.moment import Moment
from reed_tools.robots.arm_lines import ARM_RGB, FORCE_RGB, GHOST_RGB, TRACE_RGB, WALL_RGB, arrow, centre_line, drawn, wall_plate
from reed_tools.robots.joint_frames import dof

ARM_m, GHOST_m, TRACE_m, ARROW_m, HEAD_m = 0.018, 0.008, 0.003, 0.006, 0.014
TRACE_POINTS = 300
NOWHERE = np.zeros((1, 2, 3))


def segments(points: np.ndarray) -> np.ndarray:
    """A polyline as the pairs of points that a page draws; a point alone is a segment without length."""
    return np.stack([points[:-1], points[1:]], axis=1) if len(points) > 1 else NOWHERE


class Space:
    def __init__(self, server: viser.ViserServer, effective: dict | None):
        self.scene, self.arm = server.scene, (effective or {}).get("arm")
        self.scene.set_up_direction("+z")
        self.scene.add_grid("/floor", width=2.0, height=2.0, cell_size=0.1, section_size=0.5)
        self.scene.add_frame("/base", axes_length=0.1, axes_radius=0.004)
        self.tip_frame = self.scene.add_frame("/tip", axes_length=0.05, axes_radius=0.003)
        self.bent = self.scene.add_line_segments("/arm", NOWHERE, ARM_RGB, thickness=ARM_m)
        self.ghost = self.scene.add_line_segments("/desired", NOWHERE, GHOST_RGB, thickness=GHOST_m)
        self.trace = self.scene.add_line_segments("/trace", NOWHERE, TRACE_RGB, thickness=TRACE_m)
        self.force = self.scene.add_arrows("/force", NOWHERE, FORCE_RGB, shaft_radius=ARROW_m, head_radius=HEAD_m, head_length=0.03, visible=False)
        self.tips: list[tuple[np.ndarray, np.ndarray]] = []
        if effective and (plate := wall_plate(effective)):
            self.scene.add_box("/wall", color=WALL_RGB, dimensions=plate.size, opacity=0.5, wxyz=plate.q, position=plate.centre)

    def show(self, moment: Moment, scale: float) -> None:
        if moment.bent is None:
            return
        points = drawn(moment.rigid, moment.bent, scale)
        self.bent.points = segments(points)
        self.tip_frame.position = points[-1]
        if self.arm and moment.theta_d is not None and dof(self.arm) == len(moment.theta_d):
            self.ghost.points = segments(centre_line(self.arm, moment.theta_d[None])[0])
        ends = arrow(points[-1], moment.contact_force)
        self.force.visible = ends is not None
        if ends is not None:
            self.force.points = ends[None]
        self.tips = [*self.tips, (moment.rigid[-1], moment.bent[-1])][-TRACE_POINTS:]

    def draw_trace(self, scale: float) -> None:
        """Less often than the rest: it is sent whole."""
        self.trace.points = segments(np.array([drawn(rigid, bent, scale) for rigid, bent in self.tips]).reshape(-1, 3))

    def forget_trace(self) -> None:
        self.tips = []
