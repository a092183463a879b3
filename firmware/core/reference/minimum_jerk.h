// Minimum-jerk blend from 0 to 1: the quintic that starts and ends at rest. RT: safe.
#pragma once

namespace reed::reference {

struct Blend {
  double s;       // 0 … 1
  double s_dot;   // 1/s
  double s_ddot;  // 1/s²
};

/// t in s since the start, T > 0 its length; held at 0 before and 1 after.
constexpr Blend MinimumJerk(double t, double T) noexcept {
  const double x = t / T;
  if (x <= 0.0) return {0.0, 0.0, 0.0};
  if (x >= 1.0) return {1.0, 0.0, 0.0};
  return {x * x * x * (10.0 + x * (-15.0 + 6.0 * x)), 30.0 * x * x * (1.0 + x * (-2.0 + x)) / T,
          60.0 * x * (1.0 + x * (-3.0 + 2.0 * x)) / (T * T)};
}

}  // namespace reed::reference
