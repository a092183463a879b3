// Motor-side encoder: an angle, with noise, becomes the nearest of 2^bits marks per turn. RT: safe.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "reed/plant/sensor/random_stream.h"

namespace reed::plant {

class JointEncoder {
 public:
  /// noise_rad: standard deviation, 0: none. joint: 0-based.
  explicit JointEncoder(int bits_per_turn, double noise_rad = 0.0, std::int64_t seed = 0, int joint = 0)
      : lsb_rad_(2.0 * std::numbers::pi / std::ldexp(1.0, bits_per_turn)),
        noise_rad_(noise_rad),
        seed_(seed),
        stream_(stream::kEncoder + static_cast<std::uint32_t>(joint)),
        random_(seed_, stream_) {}

  void Reset() { random_ = RandomStream(seed_, stream_); }
  double lsb_rad() const noexcept { return lsb_rad_; }
  double Read(double angle_rad) noexcept {
    const double noise_rad = noise_rad_ > 0.0 ? noise_rad_ * random_.Normal() : 0.0;
    return std::nearbyint((angle_rad + noise_rad) / lsb_rad_) * lsb_rad_;
  }

 private:
  double lsb_rad_, noise_rad_;
  std::int64_t seed_;
  std::uint32_t stream_;
  RandomStream random_;
};

}  // namespace reed::plant
