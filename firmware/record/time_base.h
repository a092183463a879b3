// From a snapshot's own stamps to the `utime` of a message: simulated time in lockstep, so that equal runs
// give equal bytes, and the time of day otherwise. RT: safe, except Wall() which is set-up only.
#pragma once

#include <cstdint>

namespace reed::telemetry {

class TimeBase {
 public:
  /// utime = cycle · 10⁶ / rate, to the nearest µs.
  static TimeBase Lockstep(double rate_hz) noexcept;
  /// utime = CLOCK_MONOTONIC stamp + today's offset to CLOCK_REALTIME; later steps of the clock do not tear
  /// the log.
  static TimeBase Wall() noexcept;
  /// The same with a given offset, CLOCK_REALTIME - CLOCK_MONOTONIC.
  static TimeBase WallWithOffset(std::int64_t offset_ns) noexcept;

  bool lockstep() const noexcept { return rate_hz_ > 0.0; }

  /// µs. `time_ns` is CLOCK_MONOTONIC and does not matter in lockstep.
  std::int64_t Utime(std::int64_t cycle, std::int64_t time_ns) const noexcept;

 private:
  TimeBase(double rate_hz, std::int64_t offset_ns) noexcept : rate_hz_(rate_hz), offset_ns_(offset_ns) {}
  double rate_hz_;  // 0: wall
  std::int64_t offset_ns_;
};

}  // namespace reed::telemetry
