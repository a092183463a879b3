// How fast the tip may move along the wall's normal where the arm can hardly move that way. RT: safe.
//
//   κ = |D| L                                   1, L: reach of the arm
//   |z| ≤ kShare min_i (θ̇_max,i / |D_i|)        no joint faster than a share of its limit
//   z → 0 for κ_slow … κ_hold                   in the direction in which κ has grown
//
// Near a stretched (or folded) arm D grows without bound: the same tip speed needs ever faster joints, until the
// arm passes through the singular pose. So the tip slows down before and is held. It may always move back. Beyond
// κ_lost, or where D does not exist, the force along the normal cannot be controlled.
#pragma once

#include <algorithm>
#include <limits>

#include "reed/core/law/surface.h"

namespace reed::strategy {

/// Largest normal speeds, m/s.
struct NormalSpeedRange {
  double into = std::numeric_limits<double>::infinity();  // the wall
  double off = std::numeric_limits<double>::infinity();   // the wall
  bool held = false;                                      // one of them is 0
  bool lost = false;                                      // D is too large to press with
};

template <int N>
class StretchGuard {
 public:
  static constexpr double kSlow = 20.0, kHold = 50.0, kLost = 100.0;  // κ

  /// speed_limit of the joints, rad/s; reach in m.
  StretchGuard(const control::Vec<N>& speed_limit, double reach) noexcept
      : speed_limit_(speed_limit), reach_(reach) {}

  /// D, rad/m; z: normal speed into the wall, m/s.
  NormalSpeedRange Step(const control::Vec<N>& D, double z) noexcept {
    NormalSpeedRange range;
    const double kappa = D.norm() * reach_;
    range.lost = !(kappa > 0.0 && kappa < kLost);
    if (kappa < kSlow) grown_by_ = 0;
    if (kappa >= kSlow && grown_by_ == 0) grown_by_ = z < 0.0 ? -1 : 1;
    range.into = range.off = kShare / D.cwiseAbs().cwiseQuotient(speed_limit_).maxCoeff();
    if (grown_by_ == 0) return range;
    const double left = std::clamp((kHold - kappa) / (kHold - kSlow), 0.0, 1.0);
    (grown_by_ > 0 ? range.into : range.off) *= left;
    range.held = left == 0.0;
    return range;
  }

 private:
  static constexpr double kShare = 0.25;
  control::Vec<N> speed_limit_;
  double reach_;
  int grown_by_ = 0;  // sign of z that κ grew by beyond κ_slow, 0: below
};

}  // namespace reed::strategy
