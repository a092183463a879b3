// The absolute-time grid of the loop as pure arithmetic: deadline = start + k * period, whatever happens in
// between. An overrun never shifts the phase; the points slept through are counted. Units: ns. RT: safe.
#pragma once

#include <cstdint>

namespace reed::rt {

struct Tick {
  std::int64_t deadline_ns;
  std::int64_t missed;  // grid points strictly between `previous` and `deadline`
};

/// First point of the grid previous + k * period that lies after `now`.
/// @pre period_ns > 0
constexpr Tick NextTick(std::int64_t previous_ns, std::int64_t period_ns, std::int64_t now_ns) noexcept {
  const std::int64_t late_ns = now_ns - previous_ns;
  const std::int64_t steps = late_ns < period_ns ? 1 : late_ns / period_ns + 1;
  return {previous_ns + steps * period_ns, steps - 1};
}
static_assert(NextTick(0, 1000, 0).deadline_ns == 1000 && NextTick(0, 1000, 999).missed == 0);
static_assert(NextTick(0, 1000, 1000).deadline_ns == 2000 && NextTick(0, 1000, 1000).missed == 1);
static_assert(NextTick(0, 1000, 2500).deadline_ns == 3000 && NextTick(0, 1000, 2500).missed == 2);
static_assert(NextTick(5000, 1000, 4000).deadline_ns == 6000, "an early wake-up does not repeat a point");

/// Period of a rate, to the nearest ns: 3 kHz is 333333 ns, and the grid drifts by 1 ppm instead of jumping.
constexpr std::int64_t PeriodNs(double rate_hz) noexcept {
  // Of a positive number; std::llround is no constant expression.
  return static_cast<std::int64_t>(1e9 / rate_hz + 0.5);  // NOLINT(bugprone-incorrect-roundings)
}
static_assert(PeriodNs(1000.0) == 1'000'000 && PeriodNs(3000.0) == 333'333);

}  // namespace reed::rt
