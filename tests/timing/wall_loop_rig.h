// The loop on the clock over a clock and a cycle that the test moves.
#pragma once

#include <vector>

#include "reed/firmware/loop/realtime_loop.h"
#include "reed/tests/timing/fake_cycle.h"

namespace reed {

inline constexpr std::int64_t kPeriod = 1'000'000;
inline constexpr std::int64_t kMs = 1'000'000;

struct Rig {
  explicit Rig(int cycles) : cycle(clock, cycles), ring(256) {}

  LoopResult Run() { return WallLoop(clock, options, cycle, ring).Run(stop); }

  std::vector<telemetry::Snapshot> Recorded() {
    std::vector<telemetry::Snapshot> all;
    telemetry::Snapshot one;
    while (ring.Pop(one)) all.push_back(one);
    return all;
  }

  /// Cycle 5 loses this much time behind its last border.
  void StallAt5(std::int64_t ns) {
    cycle.cost = [ns](std::uint32_t k) {
      test::CycleCost cost;
      cost.after = k == 5 ? ns : 0;
      return cost;
    };
  }

  rt::VirtualClock clock{7'000};
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
