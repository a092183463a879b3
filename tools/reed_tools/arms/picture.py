"""An arm in one pose: its frames, its links as straight lines, and, where links or joints bend, its shape under its weight."""

import json
import subprocess
from pathlib import Path

import numpy as np

from reed_tools.errors import UsageError
from reed_tools.paths import program
from reed_tools.robots import arm_lines, nominal
from reed_tools.robots.chain import Chain, frames_of
from reed_tools.show.drawing import STYLE, plt

AXES = ("#D55E00", "#009E73", "#0072B2")  # x, y, z
ARROW = 0.09      # of the arm's size
SAG_DRAWN = 0.12  # of the arm's size: what the largest displacement is drawn as


def frames(chain: Chain, q: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """Rotation and origin of the base, of every link and of the tool."""
    at = frames_of(chain, q[None])
    links = list(zip(at.R[:, 0], at.p[:, 0]))
    return [(np.eye(3), np.zeros(3)), *links, (at.R[-1, 0] @ chain.tool_rotation, at.tool(chain)[0])]


def pose_of(text: str | None, arm: nominal.NominalArm) -> np.ndarray:
    if text is None:
        return (arm.position_min + arm.position_max) / 2
    try:
        q = np.array([float(word) for word in text.split(",")])
    except ValueError:
        q = np.zeros(0)
    if len(q) != arm.dof or not np.isfinite(q).all():
        raise UsageError(f"--at {text}: allowed: {arm.dof} angles in rad, as 0.1,0.2,…")
    return q


def bent(path: Path, q: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Points of the arm at rest and under its weight, from the program that knows the flexible arm; None without stiffness."""
    done = subprocess.run([str(program("reed_inspect")), "--arm", str(path), "--modes", "1", "--at=" + ",".join(map(repr, map(float, q)))],
                          capture_output=True, text=True)
    if done.returncode:
        return None
    found = json.loads(done.stdout)
    return np.array(found["undeformed_m"]), np.array(found["deformed_m"])


def draw(name: str, at: str | None, target: Path | None) -> Path:
    path, arm = nominal.path_of(name), nominal.load(name)
    q = pose_of(at, arm)
    placed = frames(arm.chain, q)
    points = np.array([p for _, p in placed])
    size = max(float(np.ptp(points, axis=0).max()), 0.05)
    target = target or Path(f"arm-{arm.name}.png")
    with plt.rc_context(STYLE):
        figure = plt.figure(figsize=(7.5, 7.0), layout="constrained")
        axis = figure.add_subplot(projection="3d")
        axis.plot(*arm_lines.centre_line(nominal.read(path), q[None])[0].T, color="0.55", linewidth=2.5, label="without load")
        if shape := bent(path, q):
            rest, under = shape
            largest = float(np.linalg.norm(under - rest, axis=1).max())
            scale = SAG_DRAWN * size / largest if largest > 0 else 1.0
            axis.plot(*(rest + scale * (under - rest)).T, color="#CC79A7", label=f"under its weight, displacement × {scale:.2g} (largest {1e3 * largest:.3g} mm)")
        for k, (R, p) in enumerate(placed):
            for direction, colour in zip(R.T, AXES):
                axis.plot(*np.array([p, p + ARROW * size * direction]).T, color=colour, linewidth=1.5)
            axis.text(*(p + 0.02 * size), "base" if k == 0 else "tool" if k == len(placed) - 1 else str(k), fontsize=8)
        middle, half = (points.min(axis=0) + points.max(axis=0)) / 2, 0.62 * size
        axis.set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half), zlim=(middle[2] - half, middle[2] + half),
                 xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")
        axis.set_box_aspect((1, 1, 1))
        axis.set_title(f"Arm {arm.name}: frames of base, links and tool; x red, y green, z blue", loc="left")
        axis.legend(loc="upper left")
        try:
            figure.savefig(target)
        except (OSError, ValueError) as error:
            raise UsageError(f"--out {target}: {getattr(error, 'strerror', None) or error}") from None
        finally:
            plt.close(figure)
    return target
