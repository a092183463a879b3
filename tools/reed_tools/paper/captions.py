"""What the paper says each of its figures shows, in its own terms, and how the panel beside it is to be read."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Panel:
    figure: str      # number in the paper
    title: str
    paper: str       # what the paper shows
    read: str        # how Reed's panel is drawn


PANELS = {
    "9": Panel("9", "Interaction force and tracking, known force",
               "The force rises abruptly at the start of the motion, then drops slowly and ends stable: a rising, a decreasing and a "
               "stabilising phase. The joint angles follow the planned ones while the force stays nearly constant. The axes carry no "
               "numbers that the text names.",
               "Top: true and desired normal force, rising and decreasing phase shaded. Bottom: motor angles against the plan."),
    "10": Panel("10", "Control signals, known force",
                "Compensation sets in at about 0.1 s (region 1); the signal becomes smooth as adaptation and sliding mode act (region 2); "
                "at first the proportional part dominates, later the adaptation takes over (region 3).",
                "Commanded torque per joint; dashed: the paper's 0.1 s. Gravity is held from the first instant on here, so the level at "
                "t = 0 is that of the arm's weight as far as the law knows it. Lines: mean over 10 ms; shade: range within them."),
    "11": Panel("11", "Parameter adaptation, known force",
                "Six parameters, first compensated by the proportional part, then fluctuating about fixed values.",
                "Estimates p̂ of the structural parameters. They are not expected to reach the truth: on this path nothing excites them "
                "enough, and s → 0 is all that (44) promises."),
    "12": Panel("12", "Control input, unknown force, Cartesian space",
                "Smooth input by the adaptive sliding mode; the lag of the sliding mode leaves nonlinear fluctuations that it cannot remove.",
                "The paper does not say how torques become a Cartesian input: here the tip force (J Jᵀ)⁻¹ J U, Cartesian reference. "
                "Lines: mean over 10 ms; shade: range within them."),
    "13": Panel("13", "Control input, unknown force, configuration space",
                "σ̂₀ s + σ̂₁ sgn(s) keeps the system robust; the error function converges onto the sliding surface.",
                "Joint reference. Top: torques, as in Fig. 12. Bottom: ‖s‖, the distance from the sliding surface."),
    "14": Panel("14", "Parameter adaptation, unknown force, Cartesian space",
                "A worst case with large fluctuations; all estimates bounded and finally constant.",
                "Cartesian reference. Left the paper's bounds η̂ from η(0) on, right p̂ of `separated`; below σ̂₀ and σ̂₁. The quantities "
                "differ, so each side has its own scale."),
    "15": Panel("15", "Parameter adaptation, unknown force, configuration space",
                "As Fig. 14: bounded and finally constant.", "The same with a joint reference."),
    "16": Panel("16", "Joint and force error, known force",
                "Both errors peak at the start, where adaptation has not acted yet; the joint error then falls steeply, the force error "
                "fluctuates and declines.",
                "Logarithmic. Top: rms over the joints of plan − motor angle, with and without the part along the pressing direction, "
               "which belongs to the force. "
                "Bottom: desired − true force, from contact on."),
    "17": Panel("17", "Tracking and parameter error, unknown force",
                "Both errors converge to a bound. (The caption says “known”; the text shows that unknown is meant.)",
                "Top logarithmic. Below, the distance of p̂ from the truth, or of η̂ from the bound it estimates, relative to its start."),
}

SCOPE = ("The paper prints no lengths, masses, stiffnesses or trajectories and its figures carry curves of an unnamed arm: what can be "
         "compared is the course of the curves, not their values. Reed's arm a5 bends, has Coulomb friction that no law knows, "
         "encoder, torque and force quantisation, sensor noise and one cycle of delay; the controller starts from wrong masses. Both "
         "columns of a figure share their axes unless said otherwise.")
PAPER_GAINS = ("K_d = 10, Λ = 5, Γ = 0.05 known and 0.015 unknown, ς = 0.015, η(0) = [.8 .2 .2 .8 .8 .8], equations corrected so "
               "that they can run (docs/control_law.md); as printed, the law appears in the comparison of laws.")
FAIR = ("“Fixed nominal parameters” has the gains and the force loop of `separated` and does not adapt; its normal speed limit is 200 instead of "
        "30 mm/s in the known-force case, without which it would not reach the wall in time.")
BOOKKEEPING = {
    "known": "From the plant's truth. The equations are those of a rigid arm without Coulomb friction; the run has a bending arm with "
             "it, so V converges to where they balance. Each side has its own scale.",
    "unknown": "d₀ is the largest push of the run in joint space, σ₁ = d₀. The paper's law needs σ̂₁ to reach it and would take minutes; "
               "`separated` bounds σ̂₁ far below it and relies on K_d and adaptation: where σ̂₁ stays at its bound, (46) "
               "promises nothing and V rises and falls with the push. Each side has its own scale.",
}
