"""Signals of a run that never was: a still arm a5 in a fixed pose, everything zero but what the test gives."""

import tomllib

import numpy as np

from reed_tools.paths import ARMS
from reed_tools.record import configuration
from reed_tools.record.signals import SOURCES, Signals

ARM = configuration.with_truth_beside({"arm": tomllib.loads((ARMS / "a5.toml").read_text())})["arm"]
POSE = [0.1, 0.6, -1.0, -0.7, 0.2]


def constant(value, n):
    return np.tile(np.asarray(value, dtype=float), (n, 1))


def run(source, law, n=50, **changed):
    """(signals, effective) of n cycles at 1 kHz."""
    dof, count = 5, 6
    fields = {name: np.zeros(n) for name in ("force_desired", "force_measured", "force_true", "force_integral", "stiffness")}
    fields |= {name: np.zeros((n, dof)) for name in ("joint_error", "tangential_joint", "error", "s", "observer", "torque", "reference_speed")}
    fields |= {name: np.zeros((n, 3)) for name in ("tip_error", "tangential_tip", "contact_force")}
    fields |= {"t": np.arange(n) * 1e-3, "cycle": np.arange(n), "position": constant(POSE, n), "has_wall": True,
               "p_hat": constant(ARM["p_true"], n), "eta_hat": np.zeros((n, count)), "sigma": np.zeros((n, 2)),
               "source": np.full(n, SOURCES.index(source))}
    control = {"law": law, "Gamma_known": 5.0, "k_p": 4e-3, "k_i": 30e-3, "K_d": [45.0, 41.0, 24.0, 7.5, 4.2], "Lambda": [20.0] * 5,
               "estimate_wall_stiffness": False, "force_bandwidth_radps": 30.0, "observer": False, "sigma0_gain": 1.0, "sigma1_gain": 5.0}
    effective = {"control": control, "arm": ARM, "wall": {"stiffness_Npm": 1e4, "normal": [0.0, 0.0, 1.0]},
                 "timing": {"rate_hz": 1000.0}}
    return Signals(**(fields | changed)), effective
