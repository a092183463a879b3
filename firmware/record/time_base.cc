#include "reed/firmware/record/time_base.h"

#include <time.h>

#include <cmath>
#include <limits>

namespace reed::telemetry {
namespace {

std::int64_t ReadNs(clockid_t clock) noexcept {
  timespec now{};
  clock_gettime(clock, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

TimeBase TimeBase::Lockstep(double rate_hz) noexcept { return {rate_hz, 0}; }
TimeBase TimeBase::WallWithOffset(std::int64_t offset_ns) noexcept { return {0.0, offset_ns}; }

TimeBase TimeBase::Wall() noexcept {
  // The reading with the tightest bracket: a preemption between two readings would become an offset of the
  // whole log.
  std::int64_t best_width = std::numeric_limits<std::int64_t>::max(), offset_ns = 0;
  for (int i = 0; i < 10; ++i) {
    const std::int64_t before = ReadNs(CLOCK_MONOTONIC);
    const std::int64_t real = ReadNs(CLOCK_REALTIME);
    const std::int64_t width = ReadNs(CLOCK_MONOTONIC) - before;
    if (width < best_width) {
      best_width = width;
      offset_ns = real - (before + width / 2);
    }
  }
  return WallWithOffset(offset_ns);
}

std::int64_t TimeBase::Utime(std::int64_t cycle, std::int64_t time_ns) const noexcept {
  if (lockstep()) return std::llround(static_cast<double>(cycle) * 1e6 / rate_hz_);
  return (time_ns + offset_ns_) / 1000;
}

}  // namespace reed::telemetry
