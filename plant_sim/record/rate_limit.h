// At most so many messages per second: a bucket that refills with time and holds a tenth of a second's worth,
// so an even stream at the limit passes whole although it is emptied in small batches.
#pragma once

#include <algorithm>
#include <cstdint>

namespace reed::plant {

class RateLimit {
 public:
  explicit RateLimit(double per_second)
      : per_ns_(per_second * 1e-9), depth_(per_second * 0.1), tokens_(depth_) {}

  /// CLOCK_MONOTONIC; false: over the limit, leave this one out.
  bool Allow(std::int64_t now_ns) noexcept {
    if (last_ns_ != 0) tokens_ = std::min(depth_, tokens_ + static_cast<double>(now_ns - last_ns_) * per_ns_);
    last_ns_ = now_ns;
    if (tokens_ < 1.0) return false;
    tokens_ -= 1.0;
    return true;
  }

 private:
  double per_ns_;
  double depth_;
  double tokens_;
  std::int64_t last_ns_ = 0;
};

}  // namespace reed::plant
