// Motor-side encoder: an angle becomes the nearest of 2^bits marks per turn. RT: safe.
#pragma once

#include <cmath>
#include <numbers>

namespace reed::plant {

class JointEncoder {
 public:
  explicit JointEncoder(int bits_per_turn)
      : lsb_rad_(2.0 * std::numbers::pi / std::ldexp(1.0, bits_per_turn)) {}

  double lsb_rad() const noexcept { return lsb_rad_; }
  double Read(double angle_rad) const noexcept { return std::nearbyint(angle_rad / lsb_rad_) * lsb_rad_; }

 private:
  double lsb_rad_;
};

}  // namespace reed::plant
