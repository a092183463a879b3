"""The paper's figures 9 to 17 as Reed gets them: left with the paper's gains, right by the law `separated` with the scenario's, on the same axes."""

import base64
import io

import numpy as np

from reed_tools.figures import lyapunov, lyapunov_plot
from reed_tools.figures.parameter_units import unit_of
from reed_tools.paper.phases import phases
from reed_tools.paper.runs import Result
from reed_tools.robots import rigid_arm
from reed_tools.show.drawing import COLOURS, STYLE, WIDTH_IN, plot_with_band, plt

FLOOR = 1e-3   # of logarithmic axes: mrad, N
TIME = "time since the arm became active [s]"


def grid(rows: int, results: tuple[Result, Result], height_in: float = 2.1, logarithmic: bool = False, share="row"):
    figure, axes = plt.subplots(rows, 2, sharex=True, sharey=share, squeeze=False, figsize=(WIDTH_IN, height_in * rows + 0.75))
    figure.subplots_adjust(left=0.1, right=0.985, top=1 - 0.42 / (height_in * rows + 0.75),
                           bottom=0.45 / (height_in * rows + 0.75), hspace=0.16, wspace=0.08)
    for column, (side, result) in enumerate(zip(("paper's gains", "scenario's gains"), results)):
        axes[0][column].set_title(f"{side}: {result.experiment.law}", loc="left", fontsize=9)
        axes[-1][column].set_xlabel(TIME, fontsize=8)
        for axis in axes[:, column]:
            if logarithmic:
                axis.set_yscale("log")
            if result.stopped:
                axis.axvline(result.signals.t[-1], color="#b00020", linewidth=1.0)
                axis.annotate("arm stopped", (result.signals.t[-1], 0.97), xycoords=("data", "axes fraction"), fontsize=7,
                              color="#b00020", xytext=(3, -6), textcoords="offset points")
    axes[0][0].set_xlim(0.0, 3.0)
    axes[0][0].set_xticks([0, 1, 2, 3], ["0", "1", "2", "3"])
    return figure, axes


def per_joint(axis, t, values, legend: bool = False, **style) -> None:
    for joint in range(values.shape[1]):
        axis.plot(t, values[:, joint], color=COLOURS[joint % len(COLOURS)], linewidth=0.9,
                  label=f"joint {joint + 1}" if legend else None, **style)


def torques(axis, signals) -> None:
    for joint in range(signals.dof):
        plot_with_band(axis, signals.t, signals.torque[:, joint], COLOURS[joint % len(COLOURS)], f"joint {joint + 1}")


def force_and_trajectory(results):
    """Fig. 9"""
    figure, axes = grid(2, results)
    for (top, bottom), result in zip(axes.T, results):
        signals = result.signals
        top.plot(signals.t, signals.force_true, color=COLOURS[1], label="true")
        top.plot(signals.t, signals.force_desired, color="black", linestyle="--", label="desired")
        seen = phases(signals)
        if seen:
            end = seen.stable_s if seen.stable_s is not None else signals.t[-1]
            spans = [(seen.contact_s, seen.peak_s, "0.9", "rising"), (seen.peak_s, end, "0.95", "decreasing")]
            for start, stop, shade, name in spans:
                top.axvspan(start, stop, color=shade, zorder=-1, label=name)
        planned = signals.joint_error + signals.position
        per_joint(bottom, signals.t, 1e3 * (signals.position - planned[0]), legend=True)
        bottom.plot(signals.t, 1e3 * (planned - planned[0]), color="black", linestyle=":", linewidth=0.9)
    axes[0][0].set_ylabel("normal force [N]")
    axes[1][0].set_ylabel("angle − start [mrad]\n(dotted: planned)")
    axes[0][1].legend(ncols=2)
    axes[1][1].legend(ncols=3, fontsize=7)
    return figure


def control_signals(results):
    """Fig. 10"""
    figure, axes = grid(1, results, height_in=2.8)
    for (axis,), result in zip(axes.T, results):
        torques(axis, result.signals)
        axis.axvline(0.1, color="0.4", linestyle="--", linewidth=0.8)
    axes[0][0].set_ylabel("U [N·m]")
    axes[0][1].legend(ncols=3, fontsize=7)
    return figure


def parameters(results):
    """Fig. 11"""
    figure, axes = grid(1, results, height_in=2.8)
    for (axis,), result in zip(axes.T, results):
        names(axis, result, result.signals.p_hat, result.effective["arm"]["p_true"])
    axes[0][0].set_ylabel("p̂; ticks at the right: truth")
    axes[0][1].legend(ncols=3, fontsize=7)
    return figure


def names(axis, result: Result, values, truth=None) -> None:
    for k, name in enumerate(result.effective["arm"]["param_names"]):
        axis.plot(result.signals.t, values[:, k], color=COLOURS[k % len(COLOURS)], label=f"{name} [{unit_of(result.effective['arm'], name)}]")
        if truth:
            axis.plot([2.94, 3.0], [truth[k]] * 2, color=COLOURS[k % len(COLOURS)], linewidth=2.5)


def cartesian_input(results):
    """Fig. 12: the torques as the tip force they amount to, (J Jᵀ)⁻¹ J U"""
    figure, axes = grid(1, results, height_in=2.8)
    for (axis,), result in zip(axes.T, results):
        J = rigid_arm.tip_jacobian(result.effective["arm"], result.signals.position)
        JJt = J @ np.swapaxes(J, 1, 2) + 1e-9 * np.eye(3)
        force = np.linalg.solve(JJt, np.einsum("nij,nj->ni", J, result.signals.torque)[:, :, None])[:, :, 0]
        for k, label in enumerate("xyz"):
            plot_with_band(axis, result.signals.t, force[:, k], COLOURS[k], label)
    axes[0][0].set_ylabel("U as a force at the tip [N]")
    axes[0][1].legend(ncols=3)
    return figure


def joint_input(results):
    """Fig. 13: torques, and how far the arm is from the sliding surface"""
    figure, axes = grid(2, results)
    for (top, bottom), result in zip(axes.T, results):
        torques(top, result.signals)
        bottom.semilogy(result.signals.t, np.maximum(np.linalg.norm(result.signals.s, axis=1), 1e-4), color=COLOURS[0])
    axes[0][0].set_ylabel("U [N·m]")
    axes[1][0].set_ylabel("‖s‖ [rad/s]")
    axes[0][1].legend(ncols=3, fontsize=7)
    return figure


def unknown_adaptation(results):
    """Figs. 14 and 15: what each law learns when the force is unknown"""
    figure, axes = grid(2, results, share=False)
    for (top, bottom), result in zip(axes.T, results):
        paper = result.effective["control"]["law"] == "paper_corrected"
        names(top, result, result.signals.eta_hat if paper else result.signals.p_hat)
        top.set_ylabel("η̂ (39)" if paper else "p̂ (34)", labelpad=2)
        for k, label in enumerate(("σ̂₀ [N·m·s/rad]", "σ̂₁ [N·m]")):
            bottom.plot(result.signals.t, result.signals.sigma[:, k], color=COLOURS[k], linestyle=("-", "--")[k], label=label)
    axes[1][0].set_ylabel("σ̂ (40), (41)", labelpad=2)
    axes[1][0].ticklabel_format(axis="y", scilimits=(-1, 3))
    axes[0][1].legend(ncols=3, fontsize=7)
    axes[1][1].legend()
    figure.subplots_adjust(wspace=0.17)
    return figure


def known_errors(results):
    """Fig. 16"""
    figure, axes = grid(2, results, logarithmic=True)
    for (top, bottom), result in zip(axes.T, results):
        signals = result.signals
        joints(top, signals, "all")
        tangential = 1e3 * np.sqrt(np.mean(signals.tangential_joint**2, axis=1))
        top.plot(signals.t, np.maximum(tangential, FLOOR), color=COLOURS[2], linewidth=0.8, label="tangential")
        pressing = signals.force_desired > 0
        bottom.plot(signals.t[pressing], np.maximum(np.abs(signals.force_desired - signals.force_true)[pressing], FLOOR),
                    color=COLOURS[1], linewidth=0.7)
    axes[0][0].set_ylabel("joint error,\nrms of joints [mrad]")
    axes[1][0].set_ylabel("|force error| [N]")
    axes[0][0].legend()
    return figure


def unknown_errors(results):
    """Fig. 17"""
    figure, axes = grid(2, results, logarithmic=True)
    for (top, bottom), result in zip(axes.T, results):
        joints(top, result.signals)
        bottom.plot(result.signals.t, parameter_error(result), color=COLOURS[2])
        bottom.set_yscale("linear")
        bottom.set_ylim(0.0, None)
    axes[0][0].set_ylabel("joint error,\nrms of joints [mrad]")
    axes[1][0].set_ylabel("parameter error\n(1 at the start)")
    return figure


def joints(axis, signals, label: str | None = None) -> None:
    error = np.sqrt(np.mean(signals.joint_error**2, axis=1))
    axis.plot(signals.t, np.maximum(1e3 * error, FLOOR), color=COLOURS[0], linewidth=0.8, label=label)


def parameter_error(result: Result) -> np.ndarray:
    """Of p̂ from the truth; for the paper's law of its bound η̂ from the distance it has to cover. 1 at the start."""
    arm, signals = result.effective["arm"], result.signals
    truth = np.array(arm["p_true"])
    if result.effective["control"]["law"] == "paper_corrected":
        error = np.abs(truth - np.array(arm["p_nom"])) - signals.eta_hat
    else:
        error = truth - signals.p_hat
    size = np.linalg.norm(error, axis=1)
    return size / max(size[0], 1e-12)


def bookkeeping(results):
    """(42)-(46): V, and its derivative as predicted and as seen"""
    figure, axes = grid(2, results, share=False)
    for (top, bottom), result in zip(axes.T, results):
        book = lyapunov.of_run(result.signals, result.effective)
        lyapunov_plot.draw(top, bottom, book)
        for axis in (top, bottom):
            axis.legend(fontsize=7, ncols=2, frameon=True, framealpha=0.85, edgecolor="none")
    axes[0][0].set_ylabel("V [J]")
    axes[1][0].set_ylabel("V̇ [W]")
    figure.subplots_adjust(wspace=0.17)
    return figure


def png(draw, results) -> bytes:
    with plt.rc_context(STYLE):
        figure = draw(results)
        out = io.BytesIO()
        figure.savefig(out, format="png")
        plt.close(figure)
    return out.getvalue()


def inline(data: bytes) -> str:
    return "data:image/png;base64," + base64.b64encode(data).decode()
