// Collision: the observed torque jumps although nothing was to be touched. RT: safe.
//
//   |r_i − r̄_i| > share of the joint's torque limit,   r̄: r without what changes faster than kSlow_s
//
// The slow part is model error and payload. One report per collision: armed again after kQuiet cycles below half
// the threshold.
#pragma once

#include <Eigen/Core>

#include "reed/math/exponential.h"

namespace reed::strategy {

struct Collision {
  int joint = -1;      // -1: none in this cycle
  double value = 0.0;  // N·m
};

template <int N>
class CollisionDetector {
 public:
  using Vec = Eigen::Matrix<double, N, 1>;

  CollisionDetector(const Vec& threshold, double T) noexcept
      : threshold_(threshold), share_(-math::ExpM1(-T / kSlow_s)) {}

  void Reset(const Vec& r) noexcept {
    slow_ = r;
    quiet_ = kQuiet;
  }

  Collision Step(const Vec& r) noexcept {
    slow_ += share_ * (r - slow_);
    const Vec jump = (r - slow_).cwiseQuotient(threshold_);
    int worst = 0;
    const double largest = jump.cwiseAbs().maxCoeff(&worst);
    const bool armed = quiet_ >= kQuiet;
    quiet_ = largest < 0.5 ? std::min(quiet_ + 1, kQuiet) : (largest > 1.0 ? 0 : quiet_);
    if (!armed || largest <= 1.0) return {};
    return {worst, r[worst] - slow_[worst]};
  }

 private:
  static constexpr double kSlow_s = 0.1;
  static constexpr int kQuiet = 100;  // cycles
  Vec threshold_;
  double share_;
  Vec slow_ = Vec::Zero();
  int quiet_ = kQuiet;
};

}  // namespace reed::strategy
