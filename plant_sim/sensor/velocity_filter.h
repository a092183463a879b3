// Speed from successive encoder readings: difference quotient, then a first-order low pass. RT: safe.
#pragma once

#include <numbers>

#include "reed/math/exponential.h"

namespace reed::plant {

class VelocityFilter {
 public:
  explicit VelocityFilter(double cutoff_hz) : cutoff_radps_(2.0 * std::numbers::pi * cutoff_hz) {}

  /// At rest at this reading.
  void Reset(double angle_rad) noexcept {
    angle_rad_ = angle_rad;
    speed_radps_ = 0.0;
  }

  /// The next reading, dt_s after the last one. The difference quotient is the exact mean speed of the
  /// interval, and the low pass is solved exactly for it, so uneven sampling instants (realtime) bias
  /// nothing.
  void Update(double angle_rad, double dt_s) noexcept {
    if (dt_s <= 0.0) return;
    const double mean_radps = (angle_rad - angle_rad_) / dt_s;
    speed_radps_ += -math::ExpM1(-cutoff_radps_ * dt_s) * (mean_radps - speed_radps_);
    angle_rad_ = angle_rad;
  }

  double speed_radps() const noexcept { return speed_radps_; }

 private:
  double cutoff_radps_;
  double angle_rad_ = 0.0;
  double speed_radps_ = 0.0;
};

}  // namespace reed::plant
