// The realtime loop over a clock and a cycle that the test moves.
#pragma once

#include <vector>

#include "reed/firmware/loop/realtime_loop.h"
#include "reed/tests/timing/fake_cycle.h"

namespace reed {

inline constexpr std::int64_t kPeriod = 1'000'000;
inline constexpr std::int64_t kMs = 1'000'000;

/// The same clock, which does not say what of its time was a host pause.
struct WithoutPauses {
  test::PausingVirtualClock& clock;
  std::int64_t NowNs() const noexcept { return clock.NowNs(); }
  void SleepUntil(std::int64_t deadline_ns) noexcept { clock.SleepUntil(deadline_ns); }
};
static_assert(!rt::HostClock<WithoutPauses>);

struct Rig {
  explicit Rig(int cycles) : cycle(clock, cycles), ring(256) {}

  LoopResult Run() { return RealtimeLoop(clock, options, cycle, ring).Run(stop); }
  /// As on real drives, where nobody measures host pauses.
  LoopResult RunOnRealDrives() {
    WithoutPauses plain{clock};
    return RealtimeLoop(plain, options, cycle, ring).Run(stop);
  }

  std::vector<telemetry::Snapshot> Recorded() {
    std::vector<telemetry::Snapshot> all;
    telemetry::Snapshot one;
    while (ring.Pop(one)) all.push_back(one);
    return all;
  }

  /// Cycle 5 loses this much time behind its last border.
  void DelayAt5(std::int64_t ns) {
    cycle.cost = [ns](std::uint32_t k) {
      test::CycleCost cost;
      cost.after = k == 5 ? ns : 0;
      return cost;
    };
  }

  test::PausingVirtualClock clock{7'000};
  test::FakeCycle cycle;
  telemetry::SnapshotRing ring;
  LoopOptions options;
  std::atomic<bool> stop{false};
};

inline int Events(const std::vector<telemetry::Snapshot>& all, protect::Reason reason) {
  int count = 0;
  for (const telemetry::Snapshot& one : all)
    for (int i = 0; i < one.num_events; ++i)
      count += one.events[static_cast<std::size_t>(i)].code == static_cast<int>(reason) ? 1 : 0;
  return count;
}

}  // namespace reed
