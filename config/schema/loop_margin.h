// How far one joint's control loop is from swinging up: the loop linearised about rest, with everything in it that
// delays. RT: set-up only.
//
//   motor    J_m θ̈ = τ − τ_s        link  M_ii q̈ = τ_s        spring  τ_s = k_q (θ − q) + d (θ̇ − q̇)
//   drive    torque held for a period, one cycle after its measurement
//   sensor   ω = first-order low pass of the difference quotient of θ
//   law      τ = −(K_d + (M_ii + J_m) Λ) ω − K_d Λ θ        (31) with (24), (25) about rest; a PD law lacks the middle term
#pragma once

namespace reed {

struct JointLoop {
  double inertia_kgm2 = 0.0;        // M_ii of the links at the pose
  double rotor_inertia_kgm2 = 0.0;  // J_m
  double stiffness_Nmprad = 0.0;    // k_q
  double K_d = 0.0;                 // N·m·s/rad
  double Lambda = 0.0;              // 1/s
  bool acceleration = true;         // the law feeds v̇ forward: the term (M_ii + J_m) Λ is there
  double period_s = 0.0;
  double velocity_filter_hz = 0.0;
};

struct LoopMargin {
  double gain = 0.0;       // the gains may grow by this factor; below 1: the loop is unstable as it is
  double phase_deg = 0.0;  // may be lost on top
};

inline constexpr LoopMargin kNeededMargin{2.0, 25.0};    // with the parameters at their start
inline constexpr LoopMargin kHeaviestMargin{1.5, 15.0};  // at the upper end of their box

LoopMargin MarginOf(const JointLoop& loop);

bool Enough(const LoopMargin& margin, const LoopMargin& needed);

/// The largest K_d below the loop's own with enough margin; 0: there is none, Lambda or the period are at fault.
double LargestKd(JointLoop loop, const LoopMargin& needed);

}  // namespace reed
