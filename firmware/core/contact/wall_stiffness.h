// Stiffness of the wall and the arm in series, seen from the motors, and the force gain that fits. RT: safe.
//
//   k̂_e = √(Σ f'² / Σ x'²)             (51)   N/m
//   k_p  = ω_f / k̂_e, within bounds     (52)   m/(s·N): the loop k_p k̂_e is as fast on every wall
//
// x', f': normal tip position by motor angles and normal force, less what changes slower than kWashout_s.
//
// Magnitudes and no correlation: an arm that begins to bounce moves against its force. A correlation would then
// give no stiffness and raise the gain that makes it bounce.
// The arm's own 7-12 kN/m are in series with the wall and part of k̂_e: the loop closes over both. Sums decay with
// kMemory_s of motion. Readings that moved less than kLeastMotion_m do not count.
#pragma once

#include <algorithm>
#include <cmath>

#include "reed/math/exponential.h"

namespace reed::strategy {

class WallStiffness {
 public:
  /// start: k̂_e until there is evidence, N/m. T in s.
  WallStiffness(double start, double T) noexcept
      : start_(start), washout_(-math::ExpM1(-T / kWashout_s)), memory_(math::Exp(-T / kMemory_s)) {
    Reset();
  }

  void Reset() noexcept {
    xx_ = kPrior_m * kPrior_m;
    ff_ = start_ * start_ * xx_;
    touched_ = false;
  }

  /// f: normal force, N. x: normal position of the tip by motor angles, m; falls as the arm presses. An arm
  /// that bounces moves without force: only pairs from within contact count.
  double Step(double f, double x) noexcept {
    if (f < kTouching_N) {
      touched_ = false;
      return value();
    }
    if (!touched_) {
      f_slow_ = f;
      x_slow_ = x;
      touched_ = true;
    }
    f_slow_ += washout_ * (f - f_slow_);
    x_slow_ += washout_ * (x - x_slow_);
    const double df = f - f_slow_, dx = x - x_slow_;
    if (std::abs(dx) > kLeastMotion_m) {
      xx_ = memory_ * xx_ + dx * dx;
      ff_ = memory_ * ff_ + df * df;
    }
    return value();
  }

  double value() const noexcept { return std::clamp(std::sqrt(ff_ / xx_), kSoftest, kStiffest); }

 private:
  static constexpr double kWashout_s = 0.15, kMemory_s = 0.5;
  static constexpr double kLeastMotion_m = 50e-6;  // twenty encoder steps
  static constexpr double kTouching_N = 0.5;
  static constexpr double kPrior_m = 1e-4;  // the start counts as one reading of this motion
  static constexpr double kSoftest = 300.0, kStiffest = 100e3;  // N/m
  double start_, washout_, memory_;
  double xx_ = 0.0, ff_ = 0.0, f_slow_ = 0.0, x_slow_ = 0.0;
  bool touched_ = false;
};

}  // namespace reed::strategy
