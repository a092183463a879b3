#include "reed/firmware/program/real_time_run.h"

#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "reed/bus/transport/open_transport.h"
#include "reed/config/description/cores.h"
#include "reed/rt/heap_guard.h"
#include "reed/rt/host_pause_watch.h"
#include "reed/rt/signals.h"
#include "reed/rt/syscall_guard.h"

namespace reed {
namespace {

/// The loop and nothing else, counted.
void RunCounted(const ControlOptions& options, const LoopOptions& loop, const rt::HostPauseWatch* watch,
                CycleBase& cycle, telemetry::SnapshotRing& ring, const std::atomic<bool>& stop,
                RealTimeRun& run) noexcept {
  const bool realtime = options.clock == rt::ClockKind::kRealtime;
  const rt::Usage before = rt::ThreadUsage();
  const rt::HeapCount heap;
  // ---- real time: from here to the next line nothing allocates, locks, throws or prints ----
  run.result = !realtime          ? RunLockstep(loop.first_cycle, cycle, ring, stop)
               : watch == nullptr ? RunRealtime(loop, cycle, ring, stop)
                                  : RunOnPausingHost(loop, cycle, ring, stop, *watch);
  // ---- real time ends ----
  run.heap_allocations = heap.calls();
  run.usage = rt::ThreadUsage() - before;
  if (options.for_others != nullptr) run.usage = run.usage - *options.for_others;
}

}  // namespace

RealTimeRun RunInRealTime(const ControlOptions& options, const ControllerConfig& scenario,
                          const LoopOptions& loop, bus::Transport& transport, CycleBase& cycle,
                          telemetry::SnapshotRing& ring) {
  const std::atomic<bool>& stop = rt::StopFlag();
  const bool realtime = options.clock == rt::ClockKind::kRealtime;
  rt::RealtimeOptions wanted{realtime ? scenario.timing.priority : 0,
                             realtime ? LoopCore(scenario.timing) : scenario.timing.cpu, options.lock_memory};
  std::optional<rt::HostPauseWatch> pauses;  // a thread: before memory is locked
  const std::string unwatched =
      options.host_pause ? pauses.emplace().Start(wanted.cpu, wanted.priority + 1) : "";
  const rt::HostPauseWatch* const watch = pauses ? &*pauses : nullptr;
  if (realtime && !options.seccomp) bus::ReceiveOnThisThread(transport);  // before memory is locked
  if (!realtime) bus::SendWithNextReceive(transport);
  rt::RealtimeScope scope(wanted);
  std::vector<std::string> refused = scope.report().Complaints();
  if (!unwatched.empty()) refused.push_back(unwatched);
  for (const std::string& line : refused) std::fprintf(stderr, "reed_firmware: %s\n", line.c_str());

  RealTimeRun run;
  run.report = scope.report();
  if (!options.seccomp) {
    RunCounted(options, loop, watch, cycle, ring, stop, run);
    bus::SendHeld(transport);  // the last command
    return run;
  }
  std::atomic<bool> guarded{true};
  std::thread thread([&] {  // inside the scope: it inherits priority and core
    rt::PrefaultStack();
    if (realtime) bus::ReceiveOnThisThread(transport);
    guarded = rt::ArmSyscallGuard();
    if (guarded) RunCounted(options, loop, watch, cycle, ring, stop, run);
    rt::EndGuardedThread();
  });
  thread.join();
  bus::SendHeld(transport);
  if (!guarded) throw std::runtime_error("--seccomp: this kernel refuses seccomp filters; run without it");
  return run;
}

}  // namespace reed
