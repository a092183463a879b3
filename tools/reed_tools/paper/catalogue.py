"""The experiments of the paper's section 4 as scenarios and overrides: known force, unknown force with a Cartesian and with
a joint reference, three seconds each, once per law."""

from dataclasses import dataclass

DURATION_S = 3.0  # "each simulation test lasted 3 s"
# fixed_nominal needs a faster approach than the others to reach the wall at all: at 30 mm/s its force loop sits at the limit.
FAIR_LIMIT = ("control.normal_speed_limit_mps=0.2",)
NO_OBSERVER = ("control.observer=false", "control.Gamma_unknown=5")
JOINT_REFERENCE = ("reference.legs.0.kind=hold", "reference.legs.1.kind=sine",
                   "reference.legs.1.amplitude_rad=[0.1, 0.1, 0.15, 0.15, 0.2]")


@dataclass(frozen=True)
class Experiment:
    key: str
    law: str                 # as the tables name it
    scenario: str
    overrides: tuple[str, ...] = ()

    def entries(self) -> list[str]:
        return [f"scenario.duration_s={DURATION_S}", *self.overrides]


def of_law(group: str, scenario: str, law: str, title: str, *extra: str) -> Experiment:
    return Experiment(f"{group}/{law}", title, scenario, (f"control.law={law}", *extra))


def known() -> list[Experiment]:
    """Force measured: press on a floor 1 mm lower than believed, and slide."""
    laws = (("pd", "PD(10,5)"), ("pd_tuned", "tuned PD"), ("computed_torque", "computed torque, wrong parameters"))
    return [*(of_law("known", "press_known", *law) for law in laws),
            of_law("known", "press_known", "fixed_nominal", "fixed nominal parameters, same force loop", *FAIR_LIMIT),
            of_law("known", "press_known", "paper_printed", "paper, as printed"),
            of_law("known", "press_known", "paper_corrected", "paper, corrected"),
            of_law("known", "press_known", "separated", "separated"),
            Experiment("known/observer", "separated, observer instead of the sensor", "press_no_sensor")]


def unknown() -> list[Experiment]:
    """Force not measured: up to 15 N pull at the moving hand."""
    laws = (("pd", "PD(10,5)"), ("pd_tuned", "tuned PD"), ("computed_torque", "computed torque, wrong parameters"),
            ("fixed_nominal", "fixed nominal parameters"), ("paper_printed", "paper, as printed"),
            ("paper_corrected", "paper, corrected"))
    return [*(of_law("unknown", "fluctuating_unknown", *law) for law in laws),
            of_law("unknown", "fluctuating_unknown", "separated", "separated", *NO_OBSERVER),
            Experiment("unknown/observer", "separated + observer", "fluctuating_unknown")]


def joint_space() -> list[Experiment]:
    """The same with a reference in configuration space."""
    return [of_law("joint", "fluctuating_unknown", "paper_corrected", "paper, corrected", *JOINT_REFERENCE),
            of_law("joint", "fluctuating_unknown", "separated", "separated", *NO_OBSERVER, *JOINT_REFERENCE),
            Experiment("joint/observer", "separated + observer", "fluctuating_unknown", JOINT_REFERENCE)]


def everything() -> list[Experiment]:
    return [*known(), *unknown(), *joint_space()]
