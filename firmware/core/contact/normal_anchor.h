// Where the tip should be along the normal while it touches nothing: the integral of the commanded speed. The
// force loop commands a speed only, so a torque error Δτ lets the tip drift by Δτ / K_d. A coarse encoder or an
// unknown weight moved it away from the wall that it sought. Beyond an allowed drift the speed is corrected.
// RT: safe.
//
//   x_a' = −z_d
//   Δz   = Λ_a (x − x_a), less what is within ± kMayDrift_m
#pragma once

#include <algorithm>

namespace reed::strategy {

class NormalAnchor {
 public:
  static constexpr double kMayDrift_m = 1e-3;

  explicit NormalAnchor(double T) noexcept : T_(T) {}

  /// The tip is where it should be.
  void Reset() noexcept { set_ = false; }

  /// x: normal position of the tip, m; z_d: commanded speed into the wall, m/s. Returns what to add.
  double Step(double x, double z_d) noexcept {
    if (!set_) x_a_ = x;
    set_ = true;
    x_a_ -= T_ * z_d;
    const double off = x - x_a_;
    return kLambda * (off - std::clamp(off, -kMayDrift_m, kMayDrift_m));
  }

 private:
  static constexpr double kLambda = 15.0;  // 1/s
  double T_;
  double x_a_ = 0.0;
  bool set_ = false;
};

}  // namespace reed::strategy
