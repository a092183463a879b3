// Two measurements of one joint that contradict each other: its angle and its speed. RT: safe.
//
//   ω̂_k = ω̂_k−1 + (1 − e^(−2π f T)) ((θ_k − θ_k−1)/T − ω̂_k−1)      f: of the drives' velocity filter
//   |ω̂ − ω| > allowed, for kRow cycles
//
// The drive makes its speed in the same way from the same angle. After a frame that did not come, ω̂ starts again from ω.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "reed/core/measurement.h"
#include "reed/core/safety/in_row.h"
#include "reed/core/safety/limits.h"
#include "reed/math/exponential.h"

namespace reed::protect {

template <int N>
class SpeedAgrees {
 public:
  static constexpr int kRow = 5;

  /// allowed: rad/s. filter_hz: of the drives. T: s.
  SpeedAgrees(const Vec<N>& allowed, double filter_hz, double T) noexcept
      : allowed_(allowed), share_(-math::ExpM1(-2.0 * std::numbers::pi * filter_hz * T)), T_(T) {}

  void Reset(const Measurement<N>& measured) noexcept {
    in_row_.Reset();
    theta_ = measured.theta;
    omega_ = measured.theta_dot;
  }

  /// gap: more than a period has passed since the last cycle.
  LimitCheck Step(const Measurement<N>& measured, bool gap) noexcept {
    LimitCheck check;
    for (int i = 0; i < N; ++i) {
      const auto joint = static_cast<std::size_t>(i);
      const bool follows = measured.age[joint] == 0 && was_fresh_[joint] && !gap;
      was_fresh_[joint] = measured.age[joint] == 0;
      omega_[i] = follows ? omega_[i] + share_ * ((measured.theta[i] - theta_[i]) / T_ - omega_[i])
                          : measured.theta_dot[i];
      theta_[i] = measured.theta[i];
      const double differs = measured.theta_dot[i] - omega_[i];
      if (in_row_.Add(i, std::abs(differs) > allowed_[i]) && check.trip == Reason::kNone)
        check = {Reason::kSpeedContradicts, i, differs, 0};
    }
    return check;
  }

 private:
  Vec<N> allowed_;
  double share_, T_;
  Vec<N> theta_ = Vec<N>::Zero(), omega_ = Vec<N>::Zero();
  std::array<bool, static_cast<std::size_t>(N)> was_fresh_{};
  InRow<N> in_row_{kRow};
};

}  // namespace reed::protect
