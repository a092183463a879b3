// The loop: one cycle per period, by the clock or as fast as the plant answers. Nothing of an arm in here.
#pragma once

#include <atomic>
#include <cstdint>

#include "reed/firmware/cycle/cycle_base.h"
#include "reed/firmware/snapshot/snapshot_ring.h"
#include "reed/rt/host_pause_watch.h"
#include "reed/rt/overrun.h"
#include "reed/rt/phase_budget.h"

namespace reed {

struct LoopOptions {
  double rate_hz = 1000.0;
  rt::PhaseLimits phases{{400'000, 300'000, 300'000}};
  rt::OverrunPolicy overrun = rt::OverrunPolicy::kKeepGrid;
  int max_missed_in_row = 19;
  std::int64_t first_cycle = 0;  // number of the first SYNC, of which a frame carries the lower 32 bits
};

struct LoopResult {
  CycleStatus status = CycleStatus::kRunning;
  std::int64_t cycles = 0, missed = 0, missed_host_paused = 0, overruns = 0, dropped = 0;
  double wall_s = 0.0;
};

/// Clock `realtime`: absolute-time grid that keeps its phase, missed points counted. RT: safe.
LoopResult RunRealtime(const LoopOptions& options, CycleBase& cycle, telemetry::SnapshotRing& ring,
                       const std::atomic<bool>& stop) noexcept;

/// The same on a bench: what is missed in a pause of the host is counted and does not stop the arm. `watch`
/// watches the core of this thread. RT: safe.
LoopResult RunOnPausingHost(const LoopOptions& options, CycleBase& cycle, telemetry::SnapshotRing& ring,
                            const std::atomic<bool>& stop, const rt::HostPauseWatch& watch) noexcept;

/// Clock `lockstep`: the next cycle starts when this one is done. No deadlines, no budgets, nothing missed,
/// and no snapshot lost: a full ring is waited for, but not for ever once the run shall stop. RT: safe.
LoopResult RunLockstep(std::int64_t first_cycle, CycleBase& cycle, telemetry::SnapshotRing& ring,
                       const std::atomic<bool>& stop) noexcept;

}  // namespace reed
