// A cycle that takes as long as the test says, on a clock that only moves when it is told to.
#pragma once

#include <functional>
#include <vector>

#include "reed/firmware/cycle/cycle_base.h"
#include "reed/rt/virtual_clock.h"

namespace reed::test {

/// What one cycle does with time. ns.
struct CycleCost {
  std::int64_t rx = 100'000, compute = 50'000, tx = 10'000;
  std::int64_t after = 0;    // behind the last border: a stall that no phase shows
  bool clock_stood = false;  // an answer said so
};

class FakeCycle final : public CycleBase {
 public:
  FakeCycle(rt::VirtualClock& clock, int cycles) : clock_(clock), cycles_(cycles) {}

  std::function<CycleCost(std::uint32_t)> cost = [](std::uint32_t) { return CycleCost{}; };

  CycleStatus Run(std::uint32_t cycle, std::int64_t rx_deadline_ns, const CycleState& loop,
                  telemetry::Snapshot& snapshot) noexcept override {
    const CycleCost now = cost(cycle);
    started_ns.push_back(clock_.NowNs());
    seen.push_back(loop);
    rx_deadline.push_back(rx_deadline_ns);
    clock_.Advance(now.rx + now.compute + now.tx + now.after);
    snapshot.timing.rx_ns = static_cast<std::int32_t>(now.rx);
    snapshot.timing.compute_ns = static_cast<std::int32_t>(now.compute);
    snapshot.timing.tx_ns = static_cast<std::int32_t>(now.tx);
    snapshot.timing.clock_stood = now.clock_stood;
    snapshot.bus.frames_rx = silent ? 0 : cycle;
    if (active && (loop.missed_in_row_exceeded || loop.phase_budget_exceeded)) {
      stopped_at = static_cast<int>(cycle);
      return CycleStatus::kFinished;
    }
    return static_cast<int>(cycle) + 1 < cycles_ ? CycleStatus::kRunning : CycleStatus::kFinished;
  }
  mode::Mode mode() const noexcept override { return mode::Mode::kActive; }
  protect::Reason trip() const noexcept override { return protect::Reason::kNone; }

  std::vector<std::int64_t> started_ns, rx_deadline;
  std::vector<CycleState> seen;
  bool silent = false;
  bool active = true;  // otherwise nothing stops it
  int stopped_at = -1;

 private:
  rt::VirtualClock& clock_;
  int cycles_;
};

}  // namespace reed::test
