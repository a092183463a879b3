#include "reed/firmware/loop/loop.h"

#include "reed/firmware/loop/lockstep_loop.h"
#include "reed/firmware/loop/realtime_loop.h"

namespace reed {

LoopResult RunRealtime(const LoopOptions& options, CycleBase& cycle, telemetry::SnapshotRing& ring,
                       const std::atomic<bool>& stop) noexcept {
  rt::MonotonicClock clock;
  return RealtimeLoop(clock, options, cycle, ring).Run(stop);
}

LoopResult RunOnPausingHost(const LoopOptions& options, CycleBase& cycle, telemetry::SnapshotRing& ring,
                            const std::atomic<bool>& stop, const rt::HostPauseWatch& watch) noexcept {
  rt::PausingClock clock(watch);
  return RealtimeLoop(clock, options, cycle, ring).Run(stop);
}

LoopResult RunLockstep(std::int64_t first_cycle, CycleBase& cycle, telemetry::SnapshotRing& ring,
                       const std::atomic<bool>& stop) noexcept {
  rt::MonotonicClock clock;
  return LockstepLoop(clock, first_cycle, cycle, ring).Run(stop);
}

}  // namespace reed
