"""The pictures of a run, as PNG that stays readable in print: error, force, torque, parameters, timing."""

from pathlib import Path

import numpy as np

from reed_tools.figures import arm_plot, lyapunov, lyapunov_plot, marks
from reed_tools.figures.parameter_units import unit_of
from reed_tools.record.signals import Signals
from reed_tools.record.telemetry_log import Recording
from reed_tools.record.whole_file import replacing
from reed_tools.show.drawing import COLOURS, STYLE, WIDTH_IN, label_left, legend_right, panels, plt, set_margins, ticker

TIME = "time since the arm became active [s]"
NO_TIME_AXIS = ("arm", "timing")


def draw_all(folder: Path, recording: Recording, signals: Signals | None, effective: dict, summary: dict) -> list[Path]:
    """Writes every picture that the recording allows; returns them in reading order."""
    made = []
    with plt.rc_context(STYLE):
        figures = []
        if signals is not None:
            figures = [("arm", arm_plot.draw(recording, signals, effective)), ("joint_error", joint_error(signals)), ("tip_error", tip_error(signals)),
                       ("force", force(signals) if signals.has_wall else None),
                       ("torque", torque(signals, effective["arm"]["torque_limit"])),
                       ("parameters", parameters(signals, effective["arm"])),
                       ("lyapunov", bookkeeping(signals, effective))]
        if recording.has("REED_TIMING"):
            figures.append(("timing", timing(recording, summary)))
        for name, figure in figures:
            if figure is None:
                continue
            if name not in NO_TIME_AXIS:
                marks.draw(figure, signals, summary["reason"])
            with replacing(folder / f"{name}.png") as file:
                figure.savefig(file, format="png")
            plt.close(figure)
            made.append(folder / f"{name}.png")
    return made


def joint_error(signals: Signals):
    figure, (whole, tangential) = panels(2, 4.6)
    for j in range(signals.dof):
        whole.plot(signals.t, 1e3 * signals.joint_error[:, j], label=f"joint {j + 1}")
        tangential.plot(signals.t, 1e3 * signals.tangential_joint[:, j])
    marks.draw_reversals(whole, signals, 1e3 * signals.joint_error, COLOURS)
    whole.set_title("Joint error: planned reference − motor angle", loc="left")
    if signals.has_wall:
        tangential.set_title("without the part along D, by which the force loop leaves the plan on purpose", loc="left", fontsize=8)
    label_left(whole, "joint error [mrad]")
    label_left(tangential, "tangential part [mrad]")
    tangential.set_xlabel(TIME)
    legend_right(figure, whole)
    return figure


def tip_error(signals: Signals):
    figure, (axis,) = panels(1, 2.8)
    for k, name in enumerate("xyz"):
        axis.plot(signals.t, 1e3 * signals.tip_error[:, k], label=name)
    axis.plot(signals.t, 1e3 * np.linalg.norm(signals.tangential_tip, axis=1), color="black", linestyle=":",
              label="|tangential|")
    axis.set_title("Tip error: true bent tip − planned tip, world axes", loc="left")
    label_left(axis, "tip error [mm]")
    axis.set_xlabel(TIME)
    legend_right(figure, axis)
    return figure


def force(signals: Signals):
    figure, (axis, error) = panels(2, 4.6)
    axis.plot(signals.t, signals.force_measured, color="#56B4E9", linewidth=2.2, label="measured (wrist)")
    axis.plot(signals.t, signals.force_true, color="#D55E00", label="true")
    axis.plot(signals.t, signals.force_desired, color="black", linestyle="--", label="desired")
    axis.set_title("Normal force of the wall on the robot", loc="left")
    label_left(axis, "force [N]")
    legend_right(figure, axis)
    error.plot(signals.t, signals.force_desired - signals.force_true, color="#D55E00")
    label_left(error, "desired − true [N]")
    error.set_xlabel(TIME)
    return figure


def torque(signals: Signals, limits: list[float]):
    figure, axes = panels(signals.dof, 1.2 * signals.dof + 0.8)
    set_margins(figure, top_in=0.6, hspace=0.34)
    for j, axis in enumerate(axes):
        used = float(np.abs(signals.torque[:, j]).max()) / limits[j]
        axis.plot(signals.t, signals.torque[:, j], color=COLOURS[j % len(COLOURS)])
        if used > 0.5:  # a limit far away would flatten the curve
            for sign in (-1, 1):
                axis.axhline(sign * limits[j], color="0.3", linestyle="--", linewidth=0.8)
        axis.set_title(f"limit ±{limits[j]:g} N·m, largest {100 * used:.0f} % of it", loc="right", fontsize=8)
        label_left(axis, f"joint {j + 1}\n[N·m]")
        axis.yaxis.set_major_locator(ticker.MaxNLocator(3))
    figure.suptitle("Commanded torque; dashed where it comes near: the drive's limit", x=0.01, ha="left", fontsize=10)
    axes[-1].set_xlabel(TIME)
    return figure


def parameters(signals: Signals, arm: dict):
    count = signals.p_hat.shape[1] if signals.p_hat.ndim == 2 else 0
    if count == 0:
        return None
    columns = 3 if count > 4 else min(2, count)
    rows = -(-count // columns)
    figure, axes = plt.subplots(rows, columns, sharex=True, figsize=(WIDTH_IN, 1.7 * rows + 0.9), squeeze=False)
    set_margins(figure, top_in=0.6, hspace=0.35, wspace=0.28)
    for k, axis in enumerate(axes.flat):
        if k >= count:
            axis.set_axis_off()
            continue
        axis.axhspan(arm["p_lo"][k], arm["p_hi"][k], color="0.92", zorder=-1, label="box")
        axis.axhline(arm["p_true"][k], color="black", linestyle="--", linewidth=0.9, label="truth")
        axis.plot(signals.t, signals.p_hat[:, k], color=COLOURS[0], label="estimate")
        axis.set_title(f"{arm['param_names'][k]} [{unit_of(arm, arm['param_names'][k])}]", loc="left")
        if k + columns >= count:
            axis.set_xlabel("time [s]")
            axis.tick_params(labelbottom=True)
    figure.suptitle("Structural parameters as the controller estimates them", x=0.01, ha="left", fontsize=10)
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="upper right", ncols=3)
    return figure


def bookkeeping(signals: Signals, effective: dict):
    book = lyapunov.of_run(signals, effective)
    if book is None:
        return None
    figure, (top, bottom) = panels(2, 4.6)
    lyapunov_plot.draw(top, bottom, book)
    legend_right(figure, top, bottom)
    top.set_title("Stability: V of " + ("(42)" if book.force_known else "(45)") + ", from the plant's truth", loc="left")
    label_left(top, "V [J]")
    label_left(bottom, "V̇ [W]")
    bottom.set_xlabel(TIME)
    return figure


def timing(recording: Recording, summary: dict):
    """One histogram per phase on common logarithmic axes, with its 99th percentile."""
    table = recording.tables["REED_TIMING"]
    names = [name for name, figures in summary["timing_us"].items() if figures]
    period_us, paced = 1e6 / summary["rate_hz"], summary["clock"] != "lockstep"
    shortest, longest = (1e-3 * function([function(table[f"{name}_ns"]) for name in names]) for function in (np.min, np.max))
    bins = np.geomspace(max(0.5 * shortest, 0.1), max(2 * period_us * paced, longest, 1.0), 140)
    figure, axes = panels(len(names), 1.2 * len(names) + 0.8)
    set_margins(figure, top_in=0.6, hspace=0.34)
    for axis, name, colour in zip(axes, names, COLOURS):
        values = np.clip(table[f"{name}_ns"] * 1e-3, bins[0], None)
        axis.hist(values, bins=bins, color=colour)
        if paced:
            axis.axvline(period_us, color="black", linestyle="--", linewidth=0.8)
        figures = summary["timing_us"][name]
        axis.axvline(figures["p99"], color="0.4", linestyle=":", linewidth=0.9)
        axis.set_title(f"p50 {figures['p50']:.1f}   p99 {figures['p99']:.1f}   max {figures['max']:.0f} µs", loc="right", fontsize=8)
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.yaxis.set_major_locator(ticker.LogLocator(numticks=4))
        axis.yaxis.set_minor_locator(ticker.NullLocator())
        axis.set_ylim(bottom=0.7)
        label_left(axis, f"{name}\n[cycles]")
    about = f"dashed: period {period_us:.0f} µs" if paced else "no period: each cycle waits for the plant"
    figure.suptitle(f"Time per phase, {summary['clock']} clock; dotted: p99, {about}", x=0.01, ha="left", fontsize=10)
    axes[-1].set_xlabel("duration [µs]")
    return figure
