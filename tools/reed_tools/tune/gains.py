"""The gains that are tuned, as overrides of a scenario, and the steps in which each may change."""

from dataclasses import dataclass

STEPS = {  # gain: factors that are tried; both ways, as one law or the other may want less
    "control.K_d": (1.4, 1 / 1.4),
    "control.Lambda": (1.35, 1 / 1.35),
    "control.force_bandwidth_radps": (1.5, 1 / 1.5),
    "control.Gamma_known": (2.0, 0.5),
    "control.observer_gain": (1.4, 1 / 1.4),
    "control.sigma1_max": (1.5, 1 / 1.5),
}
SIGNIFICANT_DIGITS = 4  # a gain is what its text says


@dataclass(frozen=True)
class Gains:
    values: tuple[tuple[str, float | tuple[float, ...]], ...]  # by key; K_d and Lambda per joint

    def scaled(self, key: str, factor: float) -> "Gains":
        return Gains(tuple((name, times(value, factor) if name == key else value) for name, value in self.values))

    def entries(self) -> list[str]:
        return [f"{key}={text(value)}" for key, value in self.values]


def of_effective(effective: dict) -> Gains:
    """Those that act in this scenario: what a force loop, an observer or a law does not use stays as it is."""
    control, force = effective["control"], effective["force"]
    presses = force["source"] != "none" and force["desired_N"] > 0
    acting = ["K_d", "Lambda"]
    if presses and control["estimate_wall_stiffness"]:
        acting.append("force_bandwidth_radps")
    acting += ["Gamma_known"] if force["source"] in ("none", "known", "auto") else []
    acting += ["observer_gain", "sigma1_max"] if force["source"] in ("unknown", "auto") else []
    one = {**control, "Lambda": control["Lambda"][0]} if len(set(control["Lambda"])) == 1 else control
    return Gains(tuple((f"control.{key}", rounded(one[key])) for key in acting if numbers(one[key])))


def numbers(value) -> bool:
    return any(value) if isinstance(value, list) else value > 0


def rounded(value):
    if isinstance(value, (list, tuple)):
        return tuple(rounded(entry) for entry in value)
    return float(f"{value:.{SIGNIFICANT_DIGITS}g}")


def times(value, factor: float):
    return rounded([entry * factor for entry in value] if isinstance(value, tuple) else value * factor)


def text(value) -> str:
    return f"[{', '.join(text(entry) for entry in value)}]" if isinstance(value, tuple) else f"{value:g}"
