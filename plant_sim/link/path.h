// One direction between controller and arm: later, by how much varies, or lost. What is sent first arrives first. RT: safe.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "reed/config/plant/plant_config.h"
#include "reed/plant/sensor/random_stream.h"

namespace reed::plant {

class Path {
 public:
  Path(const PathConfig& config, std::int64_t seed, std::uint32_t stream)
      : delay_ns_(std::llround(1e9 * config.delay_s)),
        jitter_ns_(1e9 * config.jitter_s),
        loss_(config.loss),
        random_(seed, stream) {}

  /// When what leaves at `sent_ns` arrives.
  std::int64_t Arrival(std::int64_t sent_ns) noexcept {
    const std::int64_t jitter_ns = jitter_ns_ > 0.0 ? std::llround(jitter_ns_ * random_.Uniform()) : 0;
    last_ns_ = std::max(last_ns_, sent_ns + delay_ns_ + jitter_ns);
    return last_ns_;
  }

  bool Loses() noexcept { return loss_ > 0.0 && random_.Uniform() <= loss_; }

 private:
  std::int64_t delay_ns_;
  double jitter_ns_, loss_;
  RandomStream random_;
  std::int64_t last_ns_ = 0;
};

}  // namespace reed::plant
