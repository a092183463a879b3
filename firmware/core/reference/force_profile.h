// The desired normal force over time: ramps up from the later of its start and the first contact, and down at
// its end. RT: safe.
#pragma once

#include <algorithm>

#include "reed/config/controller/controller_config.h"
#include "reed/core/reference/minimum_jerk.h"

namespace reed::reference {

struct ForceProfile {
  double desired_N = 0.0, start_s = 0.0, ramp_s = 0.3, end_s = 1e9;

  explicit ForceProfile(const ForceConfig& config) noexcept
      : desired_N(config.desired_N), start_s(config.start_s), ramp_s(config.ramp_s), end_s(config.end_s) {}

  bool Wanted(double t_s) const noexcept { return desired_N > 0.0 && t_s >= start_s && t_s < end_s + ramp_s; }

  /// N. Without contact nothing is pressed, so the ramp waits for it.
  double At(double t_s, double contact_s) const noexcept {
    const double up = MinimumJerk(t_s - std::max(start_s, contact_s), ramp_s).s;
    const double down = MinimumJerk(t_s - end_s, ramp_s).s;
    return desired_N * up * (1.0 - down);
  }
};

}  // namespace reed::reference
