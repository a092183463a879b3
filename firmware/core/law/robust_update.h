// Robust versions of the laws' updates: dead-zone, leak, projection, apart from the laws.
//
//   s_dz = s − dz sat(s/dz)                        no adaptation to noise
//   x⁺   = Proj[ x + T (ẋ_law(s_dz) − ℓ (x − x₀)) ]   leak toward a start, then the box
//
// Without them the plain gradient drifts in 30 s, and η̂ of (39) explodes because chatter keeps |Yᵀs| > 0.
// Projection and leak keep V̇ of (44), (46) from growing as long as the truth lies in the box.  RT: safe.
#pragma once

#include "reed/core/law/surface.h"

namespace reed::control {

template <int N>
Vec<N> DeadZone(const Vec<N>& s, double dead_zone) noexcept {
  if (dead_zone <= 0.0) return s;
  return s - dead_zone * Saturate(s, dead_zone);
}

/// One step of x under `rate`, leaking toward x_0, projected on [lo, hi]. T in s.
template <int P>
Vec<P> RobustStep(const Vec<P>& x, const Vec<P>& rate, const Vec<P>& x_0, double leak, const Vec<P>& lo,
                  const Vec<P>& hi, double T) noexcept {
  return (x + T * (rate - leak * (x - x_0))).cwiseMax(lo).cwiseMin(hi);
}

/// The same for a scalar that leaks toward 0 and lives in [0, hi].
inline double RobustStep(double x, double rate, double leak, double hi, double T) noexcept {
  const double next = x + T * (rate - leak * x);
  return next < 0.0 ? 0.0 : (next > hi ? hi : next);
}

}  // namespace reed::control
