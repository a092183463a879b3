// The loop inside the real-time scope, and nothing else: what it did, what was granted, what it cost.
#pragma once

#include "reed/bus/transport/transport.h"
#include "reed/firmware/loop/loop.h"
#include "reed/firmware/program/control.h"
#include "reed/rt/realtime_scope.h"

namespace reed {

struct RealTimeRun {
  LoopResult result;
  rt::RealtimeReport report;
  std::int64_t heap_allocations = 0;
  rt::Usage usage;
};

/// Returns when the scenario is over or SIGINT, SIGTERM or SIGHUP ask for its end.
RealTimeRun RunInRealTime(const ControlOptions& options, const ControllerConfig& scenario,
                          const LoopOptions& loop, bus::Transport& transport, CycleBase& cycle,
                          telemetry::SnapshotRing& ring);

}  // namespace reed
