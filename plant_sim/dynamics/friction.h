// Friction at the motor side of a joint, F(θ') of (21): viscous plus Coulomb, smoothed around zero speed.
//   F = b θ' + τ_c tanh(θ'/ω_s)
// It takes power F θ' >= 0 at every speed and stores no energy. RT: safe.
#pragma once

#include <cmath>

#include "reed/math/exponential.h"

namespace reed::plant {

struct JointFriction {
  static constexpr double kBreakawaySpeed =
      2e-3;  // rad/s, ω_s: a third of what a 20-bit encoder resolves in 1 ms

  double viscous = 0.0;  // N·m·s/rad
  double coulomb = 0.0;  // N·m

  /// Torque F, and F/θ', the slope of the chord. The integrator uses it instead of the tangent: it never underestimates how
  /// fast friction stops a motor, so a motor that runs out of speed within a step does not overshoot.
  struct Value {
    double torque, chord;
  };
  Value At(double speed) const {
    const double s = speed / kBreakawaySpeed, share = math::Tanh(s);
    return {viscous * speed + coulomb * share,
            viscous + coulomb / kBreakawaySpeed * (std::abs(s) < 1e-4 ? 1.0 : share / s)};
  }
};

}  // namespace reed::plant
