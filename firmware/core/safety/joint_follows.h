// A joint that shall move and whose angle does not change: its brake is closed, its encoder is stuck, or it is blocked. RT: safe.
//
//   w_k = (1 − T/τ) w_k−1 + T v      v: the law's speed (24), rad/s
//   |w| > stuck_rad    with τ = kForget_s, while θ stays within kStill_rad of where w began
//   |w| > frozen_rad   with τ = kForgetFrozen_s, while θ does not change at all: a joint at rest, too, gives way by some
//                      steps of its encoder, but not within every 0.1 s
//
// w forgets, so that a standing error (friction at rest) is no motion: it takes |v| > stuck_rad / τ.
#pragma once

#include <cmath>

#include "reed/core/measurement.h"
#include "reed/core/safety/limits.h"

namespace reed::protect {

template <int N>
class JointFollows {
 public:
  static constexpr double kStill_rad = 1e-3;  // a closed brake gives way by less
  static constexpr double kForget_s = 0.1, kForgetFrozen_s = 0.2;

  /// T: s
  JointFollows(double stuck_rad, double frozen_rad, double T) noexcept
      : stuck_rad_(stuck_rad), frozen_rad_(frozen_rad), T_(T) {}

  void Reset(const Vec<N>& theta) noexcept {
    anchor_ = last_ = theta;
    wanted_.setZero();
    idle_.setZero();
  }

  LimitCheck Step(const Measurement<N>& measured, const Vec<N>& v) noexcept {
    LimitCheck check;
    for (int i = 0; i < N; ++i) {
      if (measured.age[static_cast<std::size_t>(i)] != 0) continue;
      const double theta = measured.theta[i];
      if (std::abs(theta - anchor_[i]) > kStill_rad) {
        anchor_[i] = theta;
        wanted_[i] = 0.0;
      }
      if (theta != last_[i]) idle_[i] = 0.0;
      last_[i] = theta;
      wanted_[i] += T_ * (v[i] - wanted_[i] / kForget_s);
      idle_[i] += T_ * (v[i] - idle_[i] / kForgetFrozen_s);
      const bool stands = std::abs(wanted_[i]) > stuck_rad_ || std::abs(idle_[i]) > frozen_rad_;
      if (stands && check.trip == Reason::kNone) check = {Reason::kJointDoesNotFollow, i, wanted_[i], 0};
    }
    return check;
  }

 private:
  double stuck_rad_, frozen_rad_, T_;
  Vec<N> anchor_ = Vec<N>::Zero(), last_ = Vec<N>::Zero();
  Vec<N> wanted_ = Vec<N>::Zero(), idle_ = Vec<N>::Zero();
};

}  // namespace reed::protect
