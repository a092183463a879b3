"""The picture of plant.py: what a simulated second costs, by elements, by joints, and MuJoCo's beside it."""

from pathlib import Path

from reed_tools.show.drawing import STYLE, plt


def draw(ours: list, joints: list, theirs: list, target: Path) -> None:
    """Costs as plant.py measures them: of a5 by elements, of equal links by joints, of MuJoCo by integrator."""
    with plt.rc_context(STYLE):
        figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 4.2), layout="constrained", width_ratios=(3, 2))
        steps = sorted({cost.step_s for cost in ours}, reverse=True)
        for step, marker in zip(steps, "os"):
            costs = [cost for cost in ours if cost.step_s == step]
            curve(left, costs, marker=marker, label=f"Reed's plant, step {1e3 * step:g} ms; 1 ... {len(costs)} elements per member")
        for k, integrator in enumerate(dict.fromkeys(cost.side for cost in theirs)):
            costs = [cost for cost in theirs if cost.side == integrator]
            line = curve(left, costs, linestyle="--", marker="^v>"[k], label=f"MuJoCo {integrator}, largest stable step (at the point)")
            for c in costs:
                left.annotate(f"{1e3 * c.step_s:.3g} ms", (c.coordinates, 1e3 / c.times_real_time), fontsize=7,
                              color=line.get_color(), xytext=(5, -9), textcoords="offset points")
        left.set_title("Arm a5 pressing on a wall, one core", loc="left")
        left.set(xlabel="coordinates: 5 motors, 5 joints, the rest elastic", yscale="log",
                 ylabel="processor time per simulated second [ms]")
        right.plot(range(2, 2 + len(joints)), [1e3 / cost.times_real_time for cost in joints], "s-", color="#D55E00")
        right.set_title(f"Reed's plant, equal links, step {1e3 * joints[0].step_s:g} ms", loc="left")
        right.set(xlabel="joints, each with one elastic link of 10 coordinates", ylim=(0, None),
                  ylabel="processor time per simulated second [ms]")
        figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=2)
        figure.savefig(target)
        plt.close(figure)


def curve(axis, costs: list, **style):
    line, = axis.plot([cost.coordinates for cost in costs], [1e3 / cost.times_real_time for cost in costs], **style)
    return line
