// Torque at a joint that neither the model nor the force at the tool explains: a drive that delivers another torque than it reports,
// an encoder that is stuck or drifts, a force sensor with a bias, or something that touches the arm elsewhere. RT: safe.
//
//   u = r − L(Jᵀ F)              r: observer (47). F: of the tared sensor, at the tool point. L: the observer's lag, 1/K_o
//   |u − ū| > allowed, for kRow cycles
//
// ū is u without what changes faster than kSlow_s: weight and friction that the model has wrong. It is found in the first
// kStart_s, in which twice the torque is allowed. A torque that jumps by d is found after −ln(1 − allowed/d)/K_o + kRow T.
#pragma once

#include <cmath>

#include "reed/core/measurement.h"
#include "reed/core/safety/in_row.h"
#include "reed/core/safety/limits.h"
#include "reed/math/exponential.h"

namespace reed::protect {

template <int N>
class TorqueExplained {
 public:
  static constexpr int kRow = 3;
  static constexpr double kStart_s = 0.3;

  /// allowed: N·m. K_o: of the observer, 1/s. T: s.
  TorqueExplained(const Vec<N>& allowed, double K_o, double T) noexcept
      : allowed_(allowed),
        lag_share_(-math::ExpM1(-K_o * T)),
        quick_share_(-math::ExpM1(-T / kQuick_s)),
        slow_share_(-math::ExpM1(-T / kSlow_s)),
        T_(T) {}

  void Reset() noexcept {
    in_row_.Reset();
    felt_.setZero();
    slow_.setZero();
    since_s_ = 0.0;
  }

  /// r: observed, felt: Jᵀ F, N·m. explainable: there is a force sensor with a reading of now, and no ripple of the law.
  LimitCheck Step(const Vec<N>& r, const Vec<N>& felt, bool explainable) noexcept {
    if (!explainable) {
      Reset();
      return {};
    }
    const bool starts = since_s_ < kStart_s;
    since_s_ += starts ? T_ : 0.0;
    felt_ += lag_share_ * (felt - felt_);
    const Vec<N> u = r - felt_;
    slow_ += (starts ? quick_share_ : slow_share_) * (u - slow_);
    LimitCheck check;
    for (int i = 0; i < N; ++i) {
      const double unexplained = u[i] - slow_[i];
      const bool off = !(std::abs(unexplained) <= (starts ? 2.0 : 1.0) * allowed_[i]);
      if (in_row_.Add(i, off) && check.trip == Reason::kNone)
        check = {Reason::kTorqueUnexplained, i, unexplained, 0};
    }
    return check;
  }

 private:
  static constexpr double kQuick_s = 0.05;
  static constexpr double kSlow_s = 10.0;
  Vec<N> allowed_;
  double lag_share_, quick_share_, slow_share_, T_;
  Vec<N> felt_ = Vec<N>::Zero(), slow_ = Vec<N>::Zero();
  InRow<N> in_row_{kRow};
  double since_s_ = 0.0;
};

}  // namespace reed::protect
