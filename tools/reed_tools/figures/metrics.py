"""The figures of a run: windows of one second, timing, modes, parameters."""

import numpy as np

from reed_tools.record.signals import ACTIVE, MODES, SOURCES, Signals
from reed_tools.record.telemetry_log import Recording

SHORTEST_WINDOW_S = 0.1  # a rest shorter than this at the end gets no window of its own
PERCENTILES = {"p50": 50.0, "p99": 99.0, "p999": 99.9}


def rms(x: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(x))))


def rms_of_norm(x: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.sum(np.square(x), axis=1))))


def peak(x: np.ndarray) -> float:
    return float(np.max(np.abs(x)))


def window_edges(end_s: float) -> list[tuple[float, float]]:
    """0-1, 1-2, 2-3 s …, and what is left at the end."""
    whole = int(end_s + 1e-6)
    edges = [float(k) for k in range(whole + 1)]
    if end_s - whole > SHORTEST_WINDOW_S or whole == 0:
        edges.append(end_s)
    return list(zip(edges[:-1], edges[1:]))


def force_error(signals: Signals, inside: np.ndarray) -> np.ndarray | None:
    """f_d - f (true contact force) where something is desired; None without a wall or a wish."""
    rows = inside & (signals.force_desired > 0)
    return (signals.force_desired - signals.force_true)[rows] if signals.has_wall and rows.any() else None


def figures(signals: Signals, inside: np.ndarray) -> dict:
    force = force_error(signals, inside)
    return {
        "joint_rms_mrad": 1e3 * rms(signals.joint_error[inside]),
        "joint_peak_mrad": 1e3 * peak(signals.joint_error[inside]),
        "tangential_joint_rms_mrad": 1e3 * rms(signals.tangential_joint[inside]),
        "tip_rms_mm": 1e3 * rms_of_norm(signals.tip_error[inside]),
        "tangential_tip_rms_mm": 1e3 * rms_of_norm(signals.tangential_tip[inside]),
        "force_rms_N": None if force is None else rms(force),
        "force_peak_N": None if force is None else peak(force),
    }


def in_window(signals: Signals, from_s: float, to_s: float, rate_hz: float) -> np.ndarray:
    """Half open, with half a period of tolerance: sample times are multiples of the period, up to rounding."""
    half = 0.5 / rate_hz
    return (signals.t > from_s - half) & (signals.t < to_s - half)


def windows(signals: Signals | None, rate_hz: float) -> list[dict]:
    if signals is None:
        return []
    result = []
    for from_s, to_s in window_edges(float(signals.t[-1]) + 1.0 / rate_hz):
        inside = in_window(signals, from_s, to_s, rate_hz)
        if inside.any():
            result.append({"from_s": round(from_s, 6), "to_s": round(to_s, 6), **figures(signals, inside)})
    return result


def timing_us(recording: Recording, clock: str) -> dict:
    """Percentiles of each phase. Waking up has no meaning where nothing sleeps."""
    table = recording.tables["REED_TIMING"]
    result = {}
    for name in ("wake", "rx", "compute", "tx", "cycle"):
        values = table[f"{name}_ns"] * 1e-3
        if not len(values) or (name == "wake" and clock == "lockstep"):
            result[name] = None
            continue
        result[name] = percentiles(values)
    return result


def percentiles(values: np.ndarray) -> dict[str, float]:
    return {**{key: round(float(np.percentile(values, q)), 3) for key, q in PERCENTILES.items()}, "max": round(float(values.max()), 3)}


def zero_cycle(recording: Recording) -> int:
    """Where t = 0: the arm became active, or, if it never did, the record begins."""
    control = recording.tables["REED_CONTROL"]
    active = np.flatnonzero(control["mode"] == ACTIVE)
    return int(control["cycle"][active[0] if len(active) else 0]) if len(control["cycle"]) else 0


def modes(recording: Recording, rate_hz: float) -> list[dict]:
    """Every change of mode or of the active law; t = 0 is where the arm became active (negative before)."""
    control = recording.tables["REED_CONTROL"]
    if not recording.has("REED_CONTROL"):
        return []
    zero = zero_cycle(recording)
    state = np.stack([control["mode"], control["force_source"]], axis=1)
    changed = np.flatnonzero(np.any(np.diff(state, axis=0, prepend=-1) != 0, axis=1))
    return [{"t_s": round(float((control["cycle"][k] - zero) / rate_hz), 6), "mode": MODES[state[k, 0]],
             "force_source": SOURCES[state[k, 1]]} for k in changed]


def parameters(recording: Recording, declared: list[dict]) -> dict:
    """`declared`: the arm's structural parameters as the configuration gives them."""
    p_hat = recording.tables["REED_ADAPTATION"]["p_hat"]
    some = len(p_hat) > 0
    return {
        "names": [entry["name"] for entry in declared],
        "true": [entry["truth"] for entry in declared],
        "initial": p_hat[0].tolist() if some else None,
        "final": p_hat[-1].tolist() if some else None,
        "max_abs": np.abs(p_hat).max(axis=0).tolist() if some else None,
    }


def longest_miss(recording: Recording) -> int:
    """Most grid points missed in a row: the largest step of the counter from one recorded cycle to the next."""
    missed = recording.tables["REED_TIMING"]["missed"]
    return int(np.max(np.diff(missed, prepend=0))) if len(missed) else 0
