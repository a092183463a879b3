"""tools/reed bode: gain and phase of one joint's loop, measured on the bending arm, with the margins that it leaves."""

import json
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from reed_tools import folders, streams
from reed_tools.bode import multisine, standing
from reed_tools.bode.loop_gain import LoopGain, Margins, estimate, margins
from reed_tools.errors import RunError, UsageError
from reed_tools.run import hil, in_memory, scenario

SETTLE_S = 1.5           # after the last motion that was asked for
MOST_PERIODS = 100
PEAK_SHARE = 0.05        # of the torque limit
AT_LIMIT = 0.999
EXAMPLE = """examples:
  tools/reed bode press_known --joint 2                # in contact, pressing
  tools/reed bode free_motion --joint 1 --out out/bode # free; bode.json and bode.png in a folder"""


def add_arguments(parser) -> None:
    parser.add_argument("scenario", metavar="SCENARIO", help="a name in config/scenarios or a path: where the arm stands, free or in contact; "
                        "slides and sines become a hold")
    parser.add_argument("--joint", type=int, required=True, metavar="N", help="from 1")
    parser.add_argument("--amplitude", type=float, metavar="N·m", help="of each of the sinusoids; default: their sum stays near 5 %% of the torque limit")
    parser.add_argument("--periods", type=int, default=4, metavar="P", help="seconds that are measured; default %(default)s")
    parser.add_argument("--set", action="append", default=[], metavar="SECTION.KEY=VALUE", help="override; repeatable")
    parser.add_argument("--out", type=folders.argument, metavar="DIR", help="folder for bode.json and bode.png; default out/<time>-bode-<scenario>")
    parser.add_argument("--json", action="store_true", help="print the content of bode.json, the rest on standard error")


@dataclass(frozen=True)
class Measured:
    joint: int
    amplitude_Nm: float
    loop: LoopGain
    margins: Margins

    def as_json(self) -> dict:
        return {"joint": self.joint, "amplitude_Nm": self.amplitude_Nm, "frequency_hz": self.loop.frequency_hz.tolist(),
                "gain": np.abs(self.loop.L).tolist(), "phase_deg": np.degrees(np.unwrap(np.angle(self.loop.L))).tolist(),
                "coherence": self.loop.coherence.tolist(), "gain_margin": self.margins.gain, "phase_margin_deg": self.margins.phase_deg,
                "delay_margin_s": self.margins.delay_s, "crossover_hz": self.margins.crossover_hz}


def run(arguments) -> int:
    if not 1 <= arguments.periods <= MOST_PERIODS:
        raise UsageError(f"--periods {arguments.periods}: allowed: 1 to {MOST_PERIODS}")
    if arguments.amplitude is not None and not 0 < arguments.amplitude < 1e3:
        raise UsageError(f"--amplitude {arguments.amplitude:g}: allowed: above 0 N·m, up to 1000")
    with streams.result_alone(arguments.json):
        found = measure(arguments.scenario, arguments.joint, arguments.amplitude, arguments.periods, arguments.set)
        folder = folders.fresh(arguments.out, f"bode-{Path(arguments.scenario).stem}", ("bode.json", "bode.png"), "a measured loop already")
        show(found, folder)
    if arguments.json:
        print(json.dumps(found.as_json()))
    return 0


def measure(name: str, joint: int, amplitude_Nm: float | None, periods: int, entries: list[str]) -> Measured:
    with tempfile.TemporaryDirectory(prefix="reed-bode-") as scratch:
        effective = scenario.write_effective(name, None, entries, Path(scratch, "asked.toml"))
        standing.require_joint(effective, joint)
        rate_hz = effective["timing"]["rate_hz"]
        lines = multisine.frequencies(rate_hz)
        limit_Nm = effective["arm"]["torque_limit"][joint - 1]
        if amplitude_Nm is None:
            amplitude_Nm = float(f"{multisine.amplitude_of(PEAK_SHARE * limit_Nm, len(lines)):.3g}")
        begin_s = standing.there_s(effective) + SETTLE_S
        still = Path(scratch, "standing.toml")
        still.write_text(standing.text(Path(scratch, "asked.toml")), encoding="utf-8")
        added = [f"scenario.duration_s={begin_s + periods / multisine.BASE_HZ + 0.1:.6g}", f"drives.excitation_joint={joint}",
                 f"drives.excitation_Nm={amplitude_Nm:.17g}", f"drives.excitation_hz=[{', '.join(f'{f:g}' for f in lines)}]"]
        effective = scenario.write_effective(str(still), None, added, Path(scratch, "effective.toml"))
        u, w = recorded(effective, Path(scratch, "effective.toml"), Path(scratch), joint, begin_s, round(periods * rate_hz / multisine.BASE_HZ),
                        amplitude_Nm, lines)
    unsaturated(u, limit_Nm * effective["limits"]["torque_scale"], amplitude_Nm, joint)
    loop = estimate(u, w, rate_hz, lines, periods)
    return Measured(joint, amplitude_Nm, loop, margins(loop))


def recorded(effective: dict, config: Path, folder: Path, joint: int, begin_s: float, count: int, amplitude_Nm: float, lines: list[float]):
    """u and w of `count` cycles. The plant notes at a SYNC its time and the torque of the period before it."""
    ended = in_memory.run(effective, config, folder)
    if ended.outcome.interrupted:
        raise RunError("interrupted")
    if ended.status == hil.REFUSED:
        raise UsageError(ended.said)
    if ended.status == hil.STOPPED:
        raise UsageError(f"the arm stopped under the excitation of {amplitude_Nm:g} N·m: {ended.said}; a smaller --amplitude may not")
    if ended.died:
        raise RunError(ended.died)
    plant = ended.recording().tables["REED_PLANT"]
    t_s, torque = plant["t_s"], plant["torque"][:, joint - 1]
    free = np.flatnonzero(~plant["braked"].astype(bool))
    first = np.searchsorted(t_s, t_s[free[0]] + begin_s) if len(free) else len(t_s)
    if first + count + 1 > len(t_s) or np.any(np.diff(plant["cycle"][first:first + count + 1]) != 1):
        raise RunError("the plant recorded too few cycles of the excitation")
    return torque[first + 1:first + 1 + count], multisine.sum_at(t_s[first:first + count], amplitude_Nm, lines)


def unsaturated(u: np.ndarray, limit_Nm: float, amplitude_Nm: float, joint: int) -> None:
    peak, rest = np.max(np.abs(u)), abs(np.mean(u))
    if peak >= AT_LIMIT * limit_Nm:
        room = max(0.0, 0.8 * (limit_Nm - rest) / (peak - rest))
        raise UsageError(f"--amplitude {amplitude_Nm:g}: the torque of joint {joint} reaches its limit of {limit_Nm:g} N·m; "
                         f"about {amplitude_Nm * room:.2g} N·m would not" if room else
                         f"--joint {joint}: the torque at rest is at its limit of {limit_Nm:g} N·m already")


def show(found: Measured, folder: Path) -> None:
    from reed_tools.bode import picture

    (folder / "bode.json").write_text(json.dumps(found.as_json(), indent=1) + "\n", encoding="utf-8")
    picture.draw(found, folder / "bode.png")
    m = found.margins
    words = [f"gain margin {m.gain:.2f}" if m.gain else "no phase of -180 degrees in the measured band",
             f"phase margin {m.phase_deg:.1f} degrees at {m.crossover_hz:.1f} Hz, delay margin {1e3 * m.delay_s:.2f} ms"
             if m.phase_deg is not None else "no gain of 1 in the measured band"]
    low = found.loop.frequency_hz[found.loop.coherence < 0.9]
    print(f"joint {found.joint}, {found.amplitude_Nm:g} N·m per line: {'; '.join(words)}")
    if len(low):
        print(f"coherence below 0.9 at {', '.join(f'{f:g}' for f in low[:8])}{' …' if len(low) > 8 else ''} Hz: noise or friction decides there, --amplitude or --periods help")
    print(f"written {folder / 'bode.json'} and {folder / 'bode.png'}")
