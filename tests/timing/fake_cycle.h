// A cycle that takes as long as the test says, and a host that pauses when the test says, on a clock that only
// moves when it is told to.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "reed/firmware/cycle/cycle_base.h"
#include "reed/rt/host_clock.h"
#include "reed/rt/virtual_clock.h"

namespace reed::test {

class PausingVirtualClock : public rt::VirtualClock {
 public:
  using VirtualClock::VirtualClock;
  std::int64_t paused_ns() const noexcept { return paused_ns_; }
  void Pause(std::int64_t ns) noexcept {
    Advance(ns);
    paused_ns_ += ns;
  }
  /// In the middle of the next sleep.
  void PauseInSleep(std::int64_t ns) noexcept { in_sleep_ns_ = ns; }
  void SleepUntil(std::int64_t deadline_ns) noexcept {
    if (in_sleep_ns_ > 0) {
      VirtualClock::SleepUntil((NowNs() + deadline_ns) / 2);
      Pause(std::exchange(in_sleep_ns_, 0));
    }
    VirtualClock::SleepUntil(deadline_ns);
  }

 private:
  std::int64_t paused_ns_ = 0, in_sleep_ns_ = 0;
};
static_assert(rt::HostClock<PausingVirtualClock>);

/// What one cycle does with time. ns.
struct CycleCost {
  std::int64_t rx = 100'000, compute = 50'000, tx = 10'000;
  std::int64_t after = 0;           // behind the last border: a delay that no phase shows
  std::int64_t pause = 0;           // of the host, behind the last border
  std::int64_t pause_in_sleep = 0;  // of the host, before the next cycle
};

class FakeCycle final : public CycleBase {
 public:
  FakeCycle(PausingVirtualClock& clock, int cycles) : clock_(clock), cycles_(cycles) {}

  std::function<CycleCost(std::uint32_t)> cost = [](std::uint32_t) { return CycleCost{}; };

  CycleStatus Run(std::uint32_t cycle, std::int64_t rx_deadline_ns, const CycleState& loop,
                  telemetry::Snapshot& snapshot) noexcept override {
    const CycleCost now = cost(cycle);
    started_ns.push_back(clock_.NowNs());
    seen.push_back(loop);
    rx_deadline.push_back(rx_deadline_ns);
    clock_.Advance(now.rx + now.compute + now.tx + now.after);
    clock_.Pause(now.pause);
    clock_.PauseInSleep(now.pause_in_sleep);
    snapshot.timing.rx_ns = static_cast<std::int32_t>(now.rx);
    snapshot.timing.compute_ns = static_cast<std::int32_t>(now.compute);
    snapshot.timing.tx_ns = static_cast<std::int32_t>(now.tx);
    if (!silent && (cycle < silent_from || cycle >= silent_to)) heard_ = cycle;
    snapshot.bus.frames_rx = heard_;
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
  std::uint32_t silent_from = 0, silent_to = 0;
  bool active = true;  // otherwise nothing stops it
  int stopped_at = -1;

 private:
  PausingVirtualClock& clock_;
  int cycles_;
  std::int64_t heard_ = 0;
};

}  // namespace reed::test
