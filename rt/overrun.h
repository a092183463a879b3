// What the loop does after a cycle that ran past its own period. Pure functions of time. Units: ns. RT: safe.
#pragma once

#include <algorithm>
#include <cstdint>

#include "reed/rt/grid.h"

namespace reed::rt {

/// After an overrun every policy stays on the grid; they differ in what the next cycle does.
enum class OverrunPolicy : std::uint8_t {
  kKeepGrid,  // next grid point, a normal cycle
  kSkip,      // leave one more grid point free, so that the machine catches its breath; then a normal cycle
  kHold,      // next grid point, but that cycle repeats the last safe command
  kStop,      // the arm stops
};

enum class CycleAction : std::uint8_t { kRun, kHold, kStop };

struct OverrunDecision {
  Tick next;
  CycleAction action;
  int missed_in_row;  // to be handed back at the next call
};

/// Rows are counted up to here: a stall of eleven days at 1 kHz.
inline constexpr int kLongestRow = 1'000'000'000;

/// @param previous_ns        the grid point of the cycle that ended
/// @param start_ns, now_ns   when it began and ended
/// @param missed_in_row      what the last decision returned, 0 at the start
/// @param max_missed_in_row  more points missed in a row: stop, whatever the policy
constexpr OverrunDecision AfterCycle(OverrunPolicy policy, std::int64_t previous_ns, std::int64_t period_ns,
                                     std::int64_t start_ns, std::int64_t now_ns, int missed_in_row,
                                     int max_missed_in_row) noexcept {
  Tick next = NextTick(previous_ns, period_ns, now_ns);
  if (next.missed == 0) return {next, CycleAction::kRun, 0};

  const std::int64_t row = missed_in_row + next.missed;
  if (policy == OverrunPolicy::kStop || row > max_missed_in_row)
    return {next, CycleAction::kStop, static_cast<int>(std::min(row, std::int64_t{kLongestRow}))};
  if (policy == OverrunPolicy::kSkip) next = {next.deadline_ns + period_ns, next.missed + 1};
  const CycleAction action = policy == OverrunPolicy::kHold ? CycleAction::kHold : CycleAction::kRun;
  // A cycle that began late but took no longer than a period has served the arm: it ends the row. So the
  // stalls of a machine, 5 to 8 ms each, do not add up to a stop, one of twenty periods and a slow loop do.
  return {next, action, now_ns - start_ns <= period_ns ? 0 : static_cast<int>(row)};
}
static_assert(AfterCycle(OverrunPolicy::kSkip, 0, 10, 0, 12, 0, 20).next.deadline_ns == 30);
static_assert(AfterCycle(OverrunPolicy::kHold, 0, 10, 0, 12, 0, 20).action == CycleAction::kHold);
static_assert(AfterCycle(OverrunPolicy::kKeepGrid, 0, 10, 0, 105, 0, 20).action == CycleAction::kRun);
static_assert(AfterCycle(OverrunPolicy::kKeepGrid, 0, 10, 0, 215, 0, 20).action == CycleAction::kStop);
static_assert(AfterCycle(OverrunPolicy::kKeepGrid, 0, 10, 0, 105, 5, 20).missed_in_row == 15);
static_assert(AfterCycle(OverrunPolicy::kKeepGrid, 0, 10, 98, 105, 5, 20).missed_in_row == 0);

}  // namespace reed::rt
