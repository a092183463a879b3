#include "reed/firmware/program/real_time_run.h"

#include <cstdio>
#include <stdexcept>
#include <thread>

#include "reed/bus/transport/open_transport.h"
#include "reed/config/description/cores.h"
#include "reed/rt/heap_guard.h"
#include "reed/rt/signals.h"
#include "reed/rt/syscall_guard.h"

namespace reed {
namespace {

/// The loop and nothing else, counted.
void RunCounted(const ControlOptions& options, const LoopOptions& loop, CycleBase& cycle,
                telemetry::SnapshotRing& ring, const std::atomic<bool>& stop, RealTimeRun& run) noexcept {
  const bool wall = options.clock == rt::ClockKind::kWall;
  const rt::Usage before = rt::ThreadUsage();
  const rt::HeapCount heap;
  // ---- real time: from here to the next line nothing allocates, locks, throws or prints ----
  run.result = wall ? RunWall(loop, cycle, ring, stop) : RunLockstep(cycle, ring, stop);
  // ---- real time ends ----
  run.heap_allocations = heap.calls();
  run.usage = rt::ThreadUsage() - before;
  if (options.for_others != nullptr) run.usage = run.usage - *options.for_others;
}

}  // namespace

RealTimeRun RunInRealTime(const ControlOptions& options, const Scenario& scenario, const LoopOptions& loop,
                          bus::Transport& transport, CycleBase& cycle, telemetry::SnapshotRing& ring) {
  const std::atomic<bool>& stop = rt::StopFlag();
  const bool wall = options.clock == rt::ClockKind::kWall;
  rt::RealtimeOptions wanted{wall ? scenario.timing.priority : 0,
                             wall ? LoopCore(scenario.timing) : scenario.timing.cpu, true};
  if (wall && !options.seccomp) bus::ReceiveOnThisThread(transport);  // before memory is locked
  if (!wall) bus::SendWithNextReceive(transport);
  rt::RealtimeScope scope(wanted);
  for (const std::string& line : scope.report().Complaints())
    std::fprintf(stderr, "reed_firmware: %s\n", line.c_str());

  RealTimeRun run;
  run.report = scope.report();
  if (!options.seccomp) {
    RunCounted(options, loop, cycle, ring, stop, run);
    bus::SendHeld(transport);  // the last command
    return run;
  }
  std::atomic<bool> guarded{true};
  std::thread thread([&] {  // inside the scope: it inherits priority and core
    rt::PrefaultStack();
    if (wall) bus::ReceiveOnThisThread(transport);
    guarded = rt::ArmSyscallGuard();
    if (guarded) RunCounted(options, loop, cycle, ring, stop, run);
    rt::EndGuardedThread();
  });
  thread.join();
  bus::SendHeld(transport);
  if (!guarded) throw std::runtime_error("--seccomp: this kernel refuses seccomp filters; run without it");
  return run;
}

}  // namespace reed
