// The static deflection (22) as part of the reference. It reaches θ_d, θ̇_d and θ̈_d through a critically damped
// filter: neither the start, nor a new estimate p̂, nor a force that rises makes a step. RT: safe.
//
//   ẍ = ω² (u − x) − 2 ω ẋ        u: offset wanted now, x: offset applied
#pragma once

#include "reed/core/law/surface.h"

namespace reed::strategy {

template <int N>
class SmoothOffset {
 public:
  using Vec = control::Vec<N>;
  explicit SmoothOffset(double T) noexcept : T_(T) {}

  void Reset() noexcept {
    x_.setZero();
    x_dot_.setZero();
    x_ddot_.setZero();
  }

  /// plan + filtered offset; wanted: offset at this instant, rad.
  control::Reference<N> Step(const control::Reference<N>& plan, const Vec& wanted) noexcept {
    x_ddot_ = kOmega * kOmega * (wanted - x_) - 2.0 * kOmega * x_dot_;
    x_dot_ += T_ * x_ddot_;  // semi-implicit: stable for kOmega T < 1
    x_ += T_ * x_dot_;
    return {plan.theta_d + x_, plan.theta_d_dot + x_dot_, plan.theta_d_ddot + x_ddot_};
  }

 private:
  static constexpr double kOmega = 20.0;  // 1/s
  double T_;
  Vec x_ = Vec::Zero(), x_dot_ = Vec::Zero(), x_ddot_ = Vec::Zero();
};

}  // namespace reed::strategy
