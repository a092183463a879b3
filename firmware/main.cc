// reed_firmware: the controller. On the ground everything is read, checked, allocated; then the loop runs in
// the real-time scope; then the books are closed.
//
//   SYNC -> ArmBus -> Separated strategy -> Limits -> COMMAND
//             `-> Snapshot -> ring -> Recorder (own thread) -> LCM, event log, candump
#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <thread>

#include "options.h"
#include "reed/bus/codec/wire_time.h"
#include "reed/bus/transport/open_transport.h"
#include "reed/config/controller/load_controller_config.h"
#include "reed/config/description/cores.h"
#include "reed/firmware/loop/loop.h"
#include "reed/firmware/record/recorder.h"
#include "reed/firmware/startup/checks.h"
#include "reed/rt/heap_guard.h"
#include "reed/rt/realtime_scope.h"
#include "reed/rt/syscall_guard.h"
#include "reed/rt/usage.h"

namespace reed {
namespace {

/// Telemetry of this many cycles fits the ring: 1 s at 1 kHz if the disk stands still, and no more than the
/// caches like.
constexpr std::size_t kRingCapacity = 1024;

/// What the real-time scope was granted and what it cost.
struct Flight {
  LoopResult result;
  rt::RealtimeReport report;
  std::int64_t heap_allocations = 0;
  rt::Usage usage;
};

/// The loop and nothing else, counted.
void FlyInside(const LoopOptions& loop, bool wall, CycleBase& cycle, telemetry::SnapshotRing& ring,
               const std::atomic<bool>& stop, Flight& flight) noexcept {
  const rt::Usage before = rt::ThreadUsage();
  const rt::HeapCount heap;
  // ---- real time: from here to the next line nothing allocates, locks, throws or prints ----
  flight.result = wall ? RunWall(loop, cycle, ring, stop) : RunLockstep(cycle, ring, stop);
  // ---- real time ends ----
  flight.heap_allocations = heap.calls();
  flight.usage = rt::ThreadUsage() - before;
}

Flight Fly(const Options& options, const ControllerConfig& scenario, const LoopOptions& loop,
           bus::Transport& transport, CycleBase& cycle, telemetry::SnapshotRing& ring) {
  const std::atomic<bool>& stop = StopFlag();
  const bool wall = options.clock == ClockKind::kWall;
  rt::RealtimeOptions wanted{wall ? scenario.timing.priority : 0,
                             wall ? LoopCore(scenario.timing) : scenario.timing.cpu, true};
  if (wall && !options.seccomp) bus::ReceiveOnThisThread(transport);  // before memory is locked
  rt::RealtimeScope scope(wanted);
  for (const std::string& line : scope.report().Complaints())
    std::fprintf(stderr, "reed_firmware: %s\n", line.c_str());

  Flight flight;
  flight.report = scope.report();
  if (!options.seccomp) {
    FlyInside(loop, wall, cycle, ring, stop, flight);
    return flight;
  }
  std::atomic<bool> guarded{true};
  std::thread thread([&] {  // inside the scope: it inherits priority and core
    rt::PrefaultStack();
    if (wall) bus::ReceiveOnThisThread(transport);
    guarded = rt::ArmSyscallGuard();
    if (guarded) FlyInside(loop, wall, cycle, ring, stop, flight);
    rt::EndGuardedThread();
  });
  thread.join();
  if (!guarded) throw std::runtime_error("--seccomp: this kernel refuses seccomp filters; run without it");
  return flight;
}

run_t Describe(const Options& options, const ControllerConfig& scenario, const bus::Transport& transport) {
  run_t run{};
  run.scenario = scenario.name;
  run.arm = scenario.arm.name;
  run.law = scenario.control.law;
  run.clock = options.clock == ClockKind::kWall ? "wall" : "lockstep";
  run.dof = scenario.arm.dof();
  run.num_parameters = scenario.arm.num_parameters();
  run.rate_hz = scenario.timing.rate_hz;
  run.seed = scenario.seed;
  run.bus_kind = transport.kind();
  run.bus_interface = transport.interface();
  run.wire_load_percent = 100.0 * bus::WireLoad(scenario.arm.dof(), scenario.timing.rate_hz);
  run.cpu = -1;
  run.scheduler = "other";
  return run;
}

void Complete(run_t& run, const Flight& flight) {
  run.finished = static_cast<std::int8_t>(true);
  run.scheduler = flight.report.scheduler;
  run.memory_locked = static_cast<std::int8_t>(flight.report.memory.granted);
  run.cpu = flight.report.cpu;
  run.heap_allocations = flight.heap_allocations;
  run.page_faults = flight.usage.page_faults();
  run.telemetry_dropped = flight.result.dropped;
  run.wall_s = flight.result.wall_s;
}

/// " (joint 3: 12.5)", as far as there is something to say.
std::string Place(const TripPlace& place) {
  if (place.joint < 0 && place.value == 0.0) return "";
  char value[32];
  std::snprintf(value, sizeof value, "%g", place.value);
  return place.joint < 0 ? std::string(" (") + value + ")"
                         : " (joint " + std::to_string(place.joint + 1) + ": " + value + ")";
}

int Run(const Options& options) {
  const ControllerConfig scenario = LoadControllerConfig(options.config, options.load);
  RefuseWireOverload(scenario);
  const LoopOptions loop = LoopOptionsFrom(WithBudgets(scenario));
  const std::unique_ptr<bus::Transport> transport = bus::OpenTransport(options.bus);
  if (options.clock == ClockKind::kLockstep) RefuseLockstepOnRealDrives(*transport);
  const std::unique_ptr<CycleBase> cycle = MakeCycle(scenario, *transport, options.enable);
  RefuseSecondController(*transport);

  telemetry::SnapshotRing ring(kRingCapacity);
  const telemetry::TimeBase time = options.clock == ClockKind::kWall
                                       ? telemetry::TimeBase::Wall()
                                       : telemetry::TimeBase::Lockstep(scenario.timing.rate_hz);
  const std::string can_interface = transport->kind() == "socketcan" ? transport->interface() : "udp";
  telemetry::Recorder recorder({options.log, options.candump, can_interface, options.lcm, ""}, time, ring,
                               protect::Text);
  if (!recorder.publish_problem().empty())
    std::fprintf(stderr, "reed_firmware: %s\n", recorder.publish_problem().c_str());
  run_t run = Describe(options, scenario, *transport);
  recorder.RecordRun(run);
  recorder.Start();

  const Flight flight = Fly(options, scenario, loop, *transport, *cycle, ring);

  recorder.Stop();
  Complete(run, flight);
  recorder.RecordRun(run);
  for (const std::string& line : recorder.Close().Problems())
    std::fprintf(stderr, "reed_firmware: %s\n", line.c_str());
  if (!options.quiet)
    std::printf(
        "done: %lld cycles, %lld missed, in the loop: %lld heap allocations, %lld page faults, "
        "%lld involuntary switches\n",
        static_cast<long long>(flight.result.cycles), static_cast<long long>(flight.result.missed),
        static_cast<long long>(flight.heap_allocations), static_cast<long long>(flight.usage.page_faults()),
        static_cast<long long>(flight.usage.involuntary_switches));
  if (flight.result.status == CycleStatus::kBusLost) {
    std::fprintf(
        stderr,
        "reed_firmware: the bus is lost: nothing heard on %s:%s for 2 s, or the interface went away\n",
        transport->kind().c_str(), transport->interface().c_str());
    return 3;
  }
  if (cycle->trip() != protect::Reason::kNone) {
    std::fprintf(stderr, "reed_firmware: the arm stopped: %s%s\n",
                 protect::Text(static_cast<int>(cycle->trip())), Place(cycle->trip_place()).c_str());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace reed

int main(int argc, char** argv) {
  try {
    return reed::Run(reed::ParseOptions(argc, argv));
  } catch (const reed::BusError& error) {
    std::fprintf(stderr, "reed_firmware: %s\n", error.what());
    return 3;
  } catch (
      const std::exception& error) {  // everything that can be thrown is thrown before the loop, by bad input
    std::fprintf(stderr, "reed_firmware: %s\n", error.what());
    return 2;
  }
}
