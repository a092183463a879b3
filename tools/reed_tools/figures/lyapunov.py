"""The stability bookkeeping (42)-(46) of a recorded run, where the truth is known: V from the plant's true parameters and
true contact force, its derivative as the paper's corrected equations predict it, and as differences of V show it.

    known     V  = ½ sᵀM s + ½ p̃ᵀΓ⁻¹p̃ + e_f²/(2 k_e) + ½ k_i (∫e_f)²                               (42)
              V̇  = −sᵀ(K_d + F_v) s − k_p e_f² + e_f ḟ_d / k_e                                        (44)
    unknown   V  = ½ sᵀM s + ½ Σ(η−η̂)²/Γ + ½ (σ₀−σ̂₀)²/c₀ + ½ (σ₁−σ̂₁)²/c₁ + ½ ρ eᵀe                   (45)
              V̇ ≤ −[‖s‖ ‖e‖] Q [‖s‖ ‖e‖]ᵀ − (σ₁ − d₀) ‖s‖                                            (46)

The equations are those of a rigid arm without Coulomb friction, dead-zone and leak; a run has all of these, so that V settles
where they balance instead of falling to zero. M holds the rotors. A law that learns nothing has no V here."""

from dataclasses import dataclass

import numpy as np

from reed_tools.record.signals import SOURCES, Signals
from reed_tools.robots import rigid_arm
from reed_tools.robots.joint_frames import dof

PAPER_GAMMA = {"known": 0.05, "unknown": 0.015}   # section 4.1 of the paper
PAPER_SIGMA_RATE = 0.015
PAPER_KD = 10.0
MOST_ROWS = 20_000
SMOOTH_S = 0.02          # the differences of V are noise without it
WITH_V = ("separated", "paper_corrected")


@dataclass
class Bookkeeping:
    t: np.ndarray            # s
    V: np.ndarray            # J
    parts: dict[str, np.ndarray]
    predicted: np.ndarray    # W: (44), or the bound (46)
    seen: np.ndarray         # W: differences of V
    force_known: bool


def of_run(signals: Signals | None, effective: dict) -> Bookkeeping | None:
    """None where the law has no V, nothing was recorded, or the record is of another arm than the configuration. A run that changed its source is evaluated by (42) alone."""
    law = effective["control"]["law"]
    if signals is None or law not in WITH_V or len(signals.t) < 3 or signals.dof != dof(effective["arm"]):
        return None
    effective = {**effective, "arm": rigid_arm.true_arm(effective)}
    rows = slice(None, None, 1 + len(signals.t) // MOST_ROWS)
    unknown = np.all(signals.source == SOURCES.index("unknown"))
    M = rigid_arm.mass_matrix(effective["arm"], signals.position[rows])
    M += np.diag(effective["arm"]["rotor_inertia_reflected"])
    s = signals.s[rows]
    kinetic = 0.5 * np.einsum("ni,nij,nj->n", s, M, s)
    parts, predicted = (unknown_force if unknown else known_force)(signals, rows, effective, law == "paper_corrected")
    parts = {"½ sᵀMs": kinetic, **parts}
    V, t = sum(parts.values()), signals.t[rows]
    width = min(max(1, int(SMOOTH_S / max(t[1] - t[0], 1e-9))), len(t))
    seen = np.convolve(np.gradient(V, t), np.ones(width) / width, mode="same")
    return Bookkeeping(t, V, parts, predicted, seen, force_known=not unknown)


def known_force(signals: Signals, rows, effective: dict, paper: bool) -> tuple[dict, np.ndarray]:
    control, arm = effective["control"], effective["arm"]
    Gamma = PAPER_GAMMA["known"] if paper else control["Gamma_known"]
    p_tilde = np.array(arm["p_true"]) - signals.p_hat[rows]
    pressing = signals.force_desired > 0
    e_f = np.where(pressing, signals.force_desired - signals.force_true, 0.0)[rows]
    k_e = contact_stiffness(signals, effective)
    k_p = force_gain(signals, effective)[rows]
    k_i = control["k_i"] * k_p / control["k_p"]
    parts = {"½ p̃ᵀΓ⁻¹p̃": 0.5 * np.sum(p_tilde**2, axis=1) / Gamma if Gamma > 0 else np.zeros(len(e_f))}
    if np.any(pressing):
        parts["e_f²/(2k_e)"] = e_f**2 / (2 * k_e)
        parts["½ k_i(∫e_f)²"] = 0.5 * k_i * signals.force_integral[rows] ** 2
    K_d = np.full(signals.dof, PAPER_KD) if paper else np.array(control["K_d"])
    s, f_d_dot = signals.s[rows], np.gradient(signals.force_desired, signals.t)[rows]
    predicted = -np.sum((K_d + rigid_arm.viscous_friction(arm)) * s**2, axis=1) - k_p * e_f**2 + e_f * f_d_dot / k_e  # (44)
    return parts, predicted


def unknown_force(signals: Signals, rows, effective: dict, paper: bool) -> tuple[dict, np.ndarray]:
    control, arm = effective["control"], effective["arm"]
    c_0, c_1 = (PAPER_SIGMA_RATE,) * 2 if paper else (control["sigma0_gain"], control["sigma1_gain"])
    Lambda = np.full(signals.dof, 5.0) if paper else np.array(control["Lambda"])
    s, e = signals.s[rows], signals.error[rows]
    push = np.einsum("nij,ni->nj", rigid_arm.tip_jacobian(arm, signals.position), signals.contact_force)
    left = push - signals.observer if control["observer"] and not paper else push
    bounds = Bounds(float(np.max(np.linalg.norm(left, axis=1))), Lambda)
    parts = {"½ (σ₀−σ̂₀)²/c₀": 0.5 * (bounds.sigma_0 - signals.sigma[rows, 0]) ** 2 / c_0,
             "½ (σ₁−σ̂₁)²/c₁": 0.5 * (bounds.sigma_1 - signals.sigma[rows, 1]) ** 2 / c_1,
             "½ ρ eᵀe": 0.5 * bounds.rho * np.sum(e**2, axis=1)}
    if paper:
        eta = np.abs(np.array(arm["p_true"]) - np.array(arm["p_nom"]))
        parts["½ Σ(η−η̂)²/Γ"] = 0.5 * np.sum((eta - signals.eta_hat[rows]) ** 2, axis=1) / PAPER_GAMMA["unknown"]
    return parts, bounds.derivative(s, e)


@dataclass
class Bounds:
    """The force from outside is bounded by d₀ alone, d₁ = d₂ = 0 of (35); σ₀ is the least that makes Q of (46) positive."""

    d_0: float
    Lambda: np.ndarray
    rho: float = 1.0

    @property
    def sigma_0(self) -> float:
        return self.rho / (4 * float(self.Lambda.min()))

    @property
    def sigma_1(self) -> float:
        return self.d_0

    def derivative(self, s: np.ndarray, e: np.ndarray) -> np.ndarray:
        ns, ne = np.linalg.norm(s, axis=1), np.linalg.norm(e, axis=1)
        form = self.sigma_0 * ns**2 - self.rho * ns * ne + self.rho * float(self.Lambda.min()) * ne**2
        return -form - (self.sigma_1 - self.d_0) * ns                                                          # (46)


def force_gain(signals: Signals, effective: dict) -> np.ndarray:
    """k_p in use, m/(s·N): (52) where it follows the estimated stiffness."""
    control = effective["control"]
    if not control["estimate_wall_stiffness"]:
        return np.full(len(signals.t), control["k_p"])
    return np.clip(control["force_bandwidth_radps"] / np.maximum(signals.stiffness, 1.0), 0.5e-3, 30e-3)


def contact_stiffness(signals: Signals, effective: dict) -> float:
    """True k_e as the motors feel it, wall and arm in series, N/m: slope of true force over motor-side normal position."""
    touching = signals.force_true > 0.5
    wall = effective["wall"]["stiffness_Npm"]
    if touching.sum() < 100:
        return wall
    x = rigid_arm.tip(effective["arm"], signals.position[touching]) @ np.array(effective["wall"]["normal"])
    f, spread = signals.force_true[touching], float(np.sum((x - x.mean()) ** 2))
    slope = -float(np.sum((f - f.mean()) * (x - x.mean()))) / spread if spread > 0.0 else 0.0
    return slope if 0.0 < slope < wall else wall
