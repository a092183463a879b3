// Time that moves only by Advance or a sleep: tests of timing without waiting. RT: safe.
#pragma once

#include <algorithm>
#include <cstdint>

#include "reed/rt/clock.h"

namespace reed::rt {

class VirtualClock {
 public:
  explicit VirtualClock(std::int64_t start_ns = 0) noexcept : now_ns_(start_ns) {}

  std::int64_t NowNs() const noexcept { return now_ns_; }
  void SleepUntil(std::int64_t deadline_ns) noexcept {
    now_ns_ = std::max(now_ns_, deadline_ns) + wake_delay_ns_;
  }

  /// Work, or a machine that was taken away.
  void Advance(std::int64_t ns) noexcept { now_ns_ += ns; }
  /// Every later sleep ends this much after its deadline.
  void set_wake_delay_ns(std::int64_t ns) noexcept { wake_delay_ns_ = ns; }

 private:
  std::int64_t now_ns_;
  std::int64_t wake_delay_ns_ = 0;
};
static_assert(Clock<VirtualClock>);

}  // namespace reed::rt
