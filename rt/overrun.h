// What the loop does after a cycle that ran past its own period. Pure functions of time. Units: ns. RT: safe.
#pragma once

#include <algorithm>
#include <cstdint>

#include "reed/rt/grid.h"

namespace reed::rt {

/// After an overrun every policy stays on the grid; they differ in what the next cycle does.
enum class OverrunPolicy : std::uint8_t {
  kKeepGrid,  // next grid point, a normal cycle
  kSkip,      // one more grid point stays free, then a normal cycle
  kHold,      // next grid point, but that cycle repeats the last safe command
  kStop,      // the arm stops
};

enum class CycleAction : std::uint8_t { kRun, kHold, kStop };

/// One cycle on one clock. ns.
struct CycleTimes {
  std::int64_t point_ns;  // its grid point
  std::int64_t start_ns;
  std::int64_t end_ns;
};

struct OverrunDecision {
  Tick next;
  std::int64_t missed_host_paused;  // of next.missed, those that a host pause took
  CycleAction action;
  int missed_in_row;  // to be handed back at the next call
};

/// Rows are counted up to here: a delay of eleven days at 1 kHz.
inline constexpr int kLongestRow = 1'000'000'000;

/// The grid follows the clock, host pauses included. What is missed in a row, and what follows, is judged on the
/// controller's own time, which leaves host pauses out (host_clock.h). On real drives both are the same.
/// @param missed_in_row      what the last decision returned, 0 at the start
/// @param max_missed_in_row  more points missed in a row: stop, whatever the policy
constexpr OverrunDecision AfterCycle(OverrunPolicy policy, std::int64_t period_ns, const CycleTimes& clock,
                                     const CycleTimes& own, int missed_in_row,
                                     int max_missed_in_row) noexcept {
  Tick next = NextTick(clock.point_ns, period_ns, clock.end_ns);
  const std::int64_t missed = NextTick(own.point_ns, period_ns, own.end_ns).missed;
  const std::int64_t missed_host_paused = next.missed - missed;
  if (missed == 0) return {next, missed_host_paused, CycleAction::kRun, 0};

  const std::int64_t row = missed_in_row + missed;
  if (policy == OverrunPolicy::kStop || row > max_missed_in_row)
    return {next, missed_host_paused, CycleAction::kStop,
            static_cast<int>(std::min(row, std::int64_t{kLongestRow}))};
  if (policy == OverrunPolicy::kSkip) next = {next.deadline_ns + period_ns, next.missed + 1};
  const CycleAction action = policy == OverrunPolicy::kHold ? CycleAction::kHold : CycleAction::kRun;
  // A cycle that began late but took no longer than a period has served the arm: it ends the row. So delays of
  // 5 to 8 ms each do not add up to a stop; one of twenty periods stops, and so does a slow loop.
  const bool served = own.end_ns - own.start_ns <= period_ns;
  return {next, missed_host_paused, action, served ? 0 : static_cast<int>(row)};
}

/// On a host that does not pause.
constexpr OverrunDecision AfterCycle(OverrunPolicy policy, std::int64_t period_ns, const CycleTimes& clock,
                                     int missed_in_row, int max_missed_in_row) noexcept {
  return AfterCycle(policy, period_ns, clock, clock, missed_in_row, max_missed_in_row);
}
static_assert(AfterCycle(OverrunPolicy::kSkip, 10, {0, 0, 12}, 0, 20).next.deadline_ns == 30);
static_assert(AfterCycle(OverrunPolicy::kHold, 10, {0, 0, 12}, 0, 20).action == CycleAction::kHold);
static_assert(AfterCycle(OverrunPolicy::kKeepGrid, 10, {0, 0, 105}, 0, 20).action == CycleAction::kRun);
static_assert(AfterCycle(OverrunPolicy::kKeepGrid, 10, {0, 0, 215}, 0, 20).action == CycleAction::kStop);
static_assert(AfterCycle(OverrunPolicy::kKeepGrid, 10, {0, 0, 105}, 5, 20).missed_in_row == 15);
static_assert(AfterCycle(OverrunPolicy::kKeepGrid, 10, {0, 98, 105}, 5, 20).missed_in_row == 0);
static_assert(AfterCycle(OverrunPolicy::kStop, 10, {0, 0, 215}, {0, 0, 5}, 0, 20).action ==
              CycleAction::kRun);
static_assert(AfterCycle(OverrunPolicy::kStop, 10, {0, 0, 215}, {0, 0, 5}, 0, 20).missed_host_paused == 21);
static_assert(AfterCycle(OverrunPolicy::kKeepGrid, 10, {0, 0, 415}, {0, 0, 215}, 0, 20).action ==
              CycleAction::kStop);

}  // namespace reed::rt
