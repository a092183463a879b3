// Holding brake of a motor: dry friction, with a stiff, short elastic range where the disc sticks.
//   τ_b = -k (θ - θ_0) - d θ',  |k (θ - θ_0)| <= τ_max;  beyond, the disc slides and takes θ_0 with it
// Sticking does not creep, which speed-dependent friction would. RT: safe.
#pragma once

#include <algorithm>

namespace reed::plant {

class Brake {
 public:
  Brake() = default;
  /// `damping` in N·m·s/rad makes the grip aperiodic.
  Brake(double stiffness, double damping, double max_torque)
      : stiffness_(stiffness), damping_(damping), slip_angle_(max_torque / stiffness) {}

  void Close(double angle) { anchor_ = angle; }

  /// Lets the disc slide as far as the grip gives way.
  void Follow(double angle) { anchor_ = std::clamp(anchor_, angle - slip_angle_, angle + slip_angle_); }

  double Torque(double angle, double speed) const {
    return -stiffness_ * std::clamp(angle - anchor_, -slip_angle_, slip_angle_) - damping_ * speed;
  }
  double stiffness() const { return stiffness_; }
  double damping() const { return damping_; }

 private:
  double stiffness_ = 0.0, damping_ = 0.0, slip_angle_ = 0.0, anchor_ = 0.0;
};

}  // namespace reed::plant
