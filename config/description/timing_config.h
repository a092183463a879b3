// [timing] the loop on the machine: both programs live on it. RT: plain data.
#pragma once

#include <cstdint>

namespace reed {

struct TimingConfig {
  double rate_hz = 1000.0;
  double rx_budget_us = 0.0;       // 0: 40 % of the period, or what the frames take on a wire
  double compute_budget_us = 0.0;  // 0: half of what the others leave
  double tx_budget_us = 0.0;       // 0: half of what the others leave
  enum class Overrun { kKeepGrid, kSkip, kHold, kStop } overrun = Overrun::kKeepGrid;
  int max_missed_in_row = 19;  // more missed cycles in a row: fault
  enum class PhaseAction { kCount, kHold, kDegrade, kFault } phase_action = PhaseAction::kCount;
  int max_broken_in_row = 20;    // phase_action fault: more cycles in a row with a broken budget
  int priority = 80;             // SCHED_FIFO
  int cpu = -1;                  // core of the loop, -1: the last one it may use
  int plant_cpu = -1;            // core of the plant, -1: that of the loop
  std::int64_t first_cycle = 0;  // number of the first SYNC
};

}  // namespace reed
