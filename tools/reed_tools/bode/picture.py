"""bode.png: gain, phase and coherence over the frequency, with the margins in words."""

from pathlib import Path

import numpy as np

from reed_tools.show.drawing import STYLE, plt


def draw(found, target: Path) -> None:
    loop, m = found.loop, found.margins
    with plt.rc_context(STYLE):
        figure, (gain, phase, coherence) = plt.subplots(3, 1, figsize=(7.5, 7.0), layout="constrained", sharex=True, height_ratios=(3, 3, 1))
        gain.loglog(loop.frequency_hz, np.abs(loop.L), "o-", markersize=3)
        gain.axhline(1.0, color="0.5", linewidth=0.8)
        gain.set(ylabel="gain of L")
        degrees = np.degrees(np.unwrap(np.angle(loop.L)))
        degrees -= 360 * round((degrees[0] + 90) / 360)
        phase.semilogx(loop.frequency_hz, degrees, "o-", markersize=3)
        phase.axhline(-180.0, color="0.5", linewidth=0.8)
        phase.set(ylabel="phase of L [deg]")
        if m.crossover_hz:
            for axis in (gain, phase):
                axis.axvline(m.crossover_hz, color="#D55E00", linewidth=0.8, linestyle="--")
        coherence.semilogx(loop.frequency_hz, loop.coherence, "o-", markersize=3)
        coherence.set(ylabel="coherence", ylim=(0, 1.05), xlabel="frequency [Hz]")
        margin = f"gain margin {m.gain:.2f}" if m.gain else "gain margin beyond the band"
        if m.phase_deg is not None:
            margin += f", phase margin {m.phase_deg:.1f}°, delay margin {1e3 * m.delay_s:.2f} ms"
        gain.set_title(f"Joint {found.joint}, loop open between drive and arm\n{margin}", loc="left")
        figure.savefig(target)
        plt.close(figure)
