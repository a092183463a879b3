#include "reed/firmware/program/control.h"

#include <cstdio>
#include <memory>

#include "reed/bus/codec/wire_time.h"
#include "reed/config/description/config_error.h"
#include "reed/firmware/cycle/make_cycle.h"
#include "reed/firmware/law_plugin/law_plugin.h"
#include "reed/firmware/program/real_time_run.h"
#include "reed/firmware/record/recorder.h"
#include "reed/firmware/startup/checks.h"
#include "reed/firmware/startup/loop_options.h"

namespace reed {
namespace {

/// Telemetry of this many cycles fits the ring: on the clock 1 s at 1 kHz if the disk stands still. Lockstep
/// waits for a full ring; there it holds what comes between two looks of the recorder, and no more than the
/// caches like.
constexpr std::size_t kRingCapacity = 1024, kLockstepRingCapacity = 512;

run_t Describe(const ControlOptions& options, const ControllerConfig& scenario,
               const bus::Transport& transport) {
  run_t run{};
  run.scenario = scenario.name;
  run.arm = scenario.arm.name;
  run.law = options.law.empty() ? scenario.control.law : options.law;
  run.clock = options.clock == rt::ClockKind::kRealtime ? "wall" : "lockstep";
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

tape::Header TapeHeader(const ControlOptions& options, const ControllerConfig& scenario,
                        const std::string& config_text) {
  tape::Header header;
  header.reed = REED_NUMBER;
  header.commit = options.commit;
  header.scenario = scenario.name;
  header.arm = scenario.arm.name;
  header.law = options.law.empty() ? scenario.control.law : "external";
  header.law_library = options.law;
  header.clock = options.clock == rt::ClockKind::kRealtime ? "realtime" : "lockstep";
  header.rate_hz = scenario.timing.rate_hz;
  header.joints = scenario.arm.dof();
  header.parameters = scenario.arm.num_parameters();
  header.enable = options.enable;
  header.config = config_text;
  return header;
}

void Complete(run_t& run, const RealTimeRun& done) {
  run.finished = static_cast<std::int8_t>(true);
  run.scheduler = done.report.scheduler;
  run.memory_locked = static_cast<std::int8_t>(done.report.memory.granted);
  run.cpu = done.report.cpu;
  run.heap_allocations = done.heap_allocations;
  run.page_faults = done.usage.page_faults();
  run.telemetry_dropped = done.result.dropped;
  run.wall_s = done.result.wall_s;
}

/// Of the CAN log: what candump would call it.
std::string InterfaceName(const bus::Transport& transport) {
  return transport.kind() == "socketcan" ? transport.interface() : transport.kind();
}

/// " (joint 3: 12.5)", as far as there is something to say.
std::string Place(const TripPlace& place) {
  if (place.joint < 0 && place.value == 0.0) return "";
  char value[32];
  std::snprintf(value, sizeof value, "%g", place.value);
  return place.joint < 0 ? std::string(" (") + value + ")"
                         : " (joint " + std::to_string(place.joint + 1) + ": " + value + ")";
}

void PrintDone(const RealTimeRun& done) {
  std::printf(
      "done: %lld cycles, %lld missed, in the loop: %lld heap allocations, %lld page faults, "
      "%lld involuntary switches\n",
      static_cast<long long>(done.result.cycles), static_cast<long long>(done.result.missed),
      static_cast<long long>(done.heap_allocations), static_cast<long long>(done.usage.page_faults()),
      static_cast<long long>(done.usage.involuntary_switches));
}

int ExitStatus(const RealTimeRun& done, const CycleBase& cycle, const bus::Transport& transport) {
  if (done.result.status == CycleStatus::kBusLost) {
    std::fprintf(
        stderr,
        "reed_firmware: the bus is lost: nothing heard on %s:%s for 2 s, or the interface went away\n",
        transport.kind().c_str(), transport.interface().c_str());
    return 3;
  }
  if (cycle.trip() != protect::Reason::kNone) {
    std::fprintf(stderr, "reed_firmware: the arm stopped: %s%s\n",
                 protect::Text(static_cast<int>(cycle.trip())), Place(cycle.trip_place()).c_str());
    return 1;
  }
  return 0;
}

}  // namespace

LoopOptions PlanLoop(const ControllerConfig& scenario) {
  RefuseWireOverload(scenario);
  return LoopOptionsFrom(WithBudgets(scenario));
}

int ControlArm(const ControlOptions& options, const ControllerConfig& scenario,
               const std::string& config_text, const LoopOptions& loop, bus::Transport& transport) {
  if (!scenario.limits.monitors && options.clock == rt::ClockKind::kRealtime)
    throw ConfigError(
        "limits.monitors: false is for a bench in lockstep; no arm moves without its monitors on the clock");
  const std::unique_ptr<LawPlugin> plugin = OpenLaw(options.law, scenario);
  const std::unique_ptr<CycleBase> cycle =
      MakeCycle(scenario, transport, options.enable, plugin != nullptr ? &plugin->law() : nullptr);
  const bool realtime = options.clock == rt::ClockKind::kRealtime;
  telemetry::SnapshotRing ring(realtime ? kRingCapacity : kLockstepRingCapacity);
  const telemetry::TimeBase time =
      realtime ? telemetry::TimeBase::Wall() : telemetry::TimeBase::Lockstep(scenario.timing.rate_hz);
  telemetry::Recorder recorder({options.log, options.candump, InterfaceName(transport), options.lcm, "",
                                options.tape, TapeHeader(options, scenario, config_text)},
                               time, ring, protect::Text);
  if (!recorder.publish_problem().empty())
    std::fprintf(stderr, "reed_firmware: %s\n", recorder.publish_problem().c_str());
  run_t run = Describe(options, scenario, transport);
  recorder.RecordRun(run);
  if (plugin != nullptr) recorder.RecordLawNames(plugin->value_names());
  recorder.Start();

  const RealTimeRun done = RunInRealTime(options, scenario, loop, transport, *cycle, ring);

  recorder.Stop();
  Complete(run, done);
  recorder.RecordRun(run);
  for (const std::string& line : recorder.Close().Problems())
    std::fprintf(stderr, "reed_firmware: %s\n", line.c_str());
  if (!options.quiet) PrintDone(done);
  return ExitStatus(done, *cycle, transport);
}

}  // namespace reed
