// The loop's clock: a reading, and a sleep up to an absolute time. CLOCK_MONOTONIC in ns.
// RT: safe.
#pragma once

#include <time.h>

#include <algorithm>
#include <cerrno>
#include <concepts>
#include <cstdint>
#include <limits>

#include "reed/rt/monotonic.h"

namespace reed::rt {

template <typename T>
concept Clock = requires(T clock, std::int64_t deadline_ns) {
  { clock.NowNs() }
  noexcept->std::same_as<std::int64_t>;
  { clock.SleepUntil(deadline_ns) }
  noexcept->std::same_as<void>;  // returns at once when the deadline has passed
};

/// A duration as telemetry has it. What is longer than its 2.147 s reads as that, and never as less.
constexpr std::int32_t ShortNs(std::int64_t duration_ns) noexcept {
  using Limits = std::numeric_limits<std::int32_t>;
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(duration_ns, Limits::min(), Limits::max()));
}

class MonotonicClock {
 public:
  std::int64_t NowNs() const noexcept { return rt::NowNs(); }

  /// Absolute, so that being interrupted or preempted on the way in does not lengthen the sleep. A signal
  /// does not end it: to stop the loop, set a flag, and the loop sees it one period later at most.
  void SleepUntil(std::int64_t deadline_ns) const noexcept {
    const timespec deadline{deadline_ns / kNsPerSecond, deadline_ns % kNsPerSecond};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
    }
  }
};
static_assert(Clock<MonotonicClock>);

}  // namespace reed::rt
