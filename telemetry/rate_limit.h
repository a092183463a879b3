// At most so many per second on average, with short bursts for a thread that wakes up in steps. Pure
// arithmetic.
#pragma once

#include <algorithm>
#include <cstdint>

namespace reed::telemetry {

/// A bucket of time: it fills with the clock up to `burst` items' worth and each admitted item takes one
/// period out.
class RateLimit {
 public:
  constexpr RateLimit(std::int64_t per_second, std::int64_t burst) noexcept
      : period_ns_(1'000'000'000 / per_second), full_ns_(burst * period_ns_), credit_ns_(full_ns_) {}

  /// `now_ns` never goes backwards.
  constexpr bool Admit(std::int64_t now_ns) noexcept {
    if (started_) credit_ns_ = std::min(full_ns_, credit_ns_ + (now_ns - last_ns_));
    started_ = true;
    last_ns_ = now_ns;
    if (credit_ns_ < period_ns_) return false;
    credit_ns_ -= period_ns_;
    return true;
  }

 private:
  std::int64_t period_ns_, full_ns_, credit_ns_;
  std::int64_t last_ns_ = 0;
  bool started_ = false;
};

}  // namespace reed::telemetry
