"""The picture of tools/reed bench: every ratio beside its aim, and the growth with the joints."""

from pathlib import Path

from reed_tools.bench.rows import Found


def draw(found: Found, machine: str, target: Path) -> bool:
    compared = [row for row in found.rows if row.ratio is not None and row.ratio != float("inf")]
    growth = found.details.get("growth_ns")
    if not compared and not growth:
        return False
    from reed_tools.show.drawing import STYLE, plt

    panels = [(ratios, compared)] * bool(compared) + [(grown, growth)] * bool(growth)
    heights = [0.36 * len(compared) + 0.9] * bool(compared) + [3.2] * bool(growth)
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(len(panels), 1, figsize=(7.4, sum(heights) + 0.5), squeeze=False, layout="constrained",
                                       height_ratios=heights)
        for axis, (panel, data) in zip(axes[:, 0], panels):
            panel(axis, data)
        figure.suptitle(machine, fontsize=8, x=0.01, ha="left")
        figure.savefig(target)
        plt.close(figure)
    return True


LEAST = 0.01  # what a ratio of zero is drawn as


def ratios(axis, rows) -> None:
    """A bar from the aim (black) to the ratio: green keeps it, red does not."""
    names = [f"{row.what}\nbeside {row.other}" for row in rows]
    for k, row in enumerate(rows):
        ratio, aim = max(row.ratio, LEAST), row.aim or 1.0
        colour = "#009E73" if row.ok else "#D55E00" if row.ok is False else "0.6"
        axis.barh(k, ratio - aim, left=aim, color=colour, height=0.5)
        axis.plot([aim, aim], [k - 0.35, k + 0.35], color="black", linewidth=2)
        towards_right = ratio > aim
        axis.annotate(f"{row.ratio:.2f}", (ratio, k), xytext=(4 if towards_right else -4, 0), textcoords="offset points",
                      ha="left" if towards_right else "right", va="center", fontsize=8)
    axis.set_yticks(range(len(rows)), names)
    axis.invert_yaxis()
    axis.tick_params(axis="y", labelsize=7)
    axis.set_xscale("log")
    axis.set_xlim(0.4 * min(max(min(row.ratio, row.aim or 1.0), LEAST) for row in rows),
                  2.5 * max(max(row.ratio, row.aim or 1.0) for row in rows))
    axis.xaxis.set_major_formatter("{x:g}")
    axis.set_xlabel("Reed / other side; black: aim; costs are to be left of it, speeds right")


def grown(axis, growth) -> None:
    from reed_tools.bench.steps import exponent

    for name, label, style in (("reed", "Reed", "o-"), ("pinocchio", "Slotine-Li from Pinocchio", "s--")):
        if name in growth:
            slope = exponent(dict(zip(growth["joints"], growth[name])))
            axis.loglog(growth["joints"], [ns / 1e3 for ns in growth[name]], style, label=f"{label}: exponent {slope:.2f}")
    axis.set_xticks(growth["joints"], [str(n) for n in growth["joints"]])
    axis.minorticks_off()
    axis.set_xlabel("joints")
    axis.set_ylabel("one control step [µs]")
    axis.legend()
