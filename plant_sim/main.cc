// reed_plant_sim: an arm on a bus. Set-up (may allocate, may throw), then one endpoint polled until it ends.
//
//   frames -> BusPort -> Robot (DriveChain -> ArmPlant -> sensors) -> BusPort -> frames
//                          `-> Journal -> Publisher (own thread) -> event log, LCM, terminal
#include <sched.h>

#include <atomic>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "options.h"
#include "reed/bus/codec/reed_codec.h"
#include "reed/bus/transport/open_transport.h"
#include "reed/config/description/config_error.h"
#include "reed/config/description/cores.h"
#include "reed/config/plant/load_plant_config.h"
#include "reed/plant/endpoint/flexible_arm_body.h"
#include "reed/plant/endpoint/realtime_endpoint.h"
#include "reed/plant/link/timed_endpoint.h"
#include "reed/plant/process/realtime_wish.h"
#include "reed/plant/process/second_arm.h"
#include "reed/plant/program/conclusion.h"
#include "reed/plant/record/publisher.h"
#include "reed/rt/host_pause_watch.h"
#include "reed/rt/monotonic.h"
#include "reed/rt/program.h"
#include "reed/rt/realtime_scope.h"
#include "reed/rt/signals.h"
#include "reed/rt/thread_stack.h"

namespace reed::plant {
namespace {

/// A plant that waits for frames looks so often whether it shall stop.
constexpr std::int64_t kStopCheck_ns = 60'000'000;

std::unique_ptr<Endpoint> MakeEndpoint(const Options& options, const PlantConfig& config,
                                       bus::Transport& transport, ArmBody& body, RecordSink& recorder,
                                       const rt::HostPauseWatch& watch) {
  if (options.clock == rt::ClockKind::kLockstep) {
    return MakeLockstepEndpoint(config, transport, body, recorder);
  }
  if (config.link.active())
    throw ConfigError("link: a bus by the clock has its own times; allowed: --clock lockstep, or no link");
  EndpointClock clock = EndpointClock::System();
  clock.paused_ns = [&watch] { return watch.paused_ns(); };
  return std::make_unique<RealtimeEndpoint>(config, transport, body, recorder, clock);
}

/// Until the endpoint ends by itself, its time is over, or a signal asks; then what already lies on the bus
/// is still answered, so that the record of a finished run is complete.
void Serve(Endpoint& endpoint, double duration_s, const std::atomic<bool>& stop_wanted) {
  const auto time_over = [&] { return duration_s > 0.0 && endpoint.robot().time_s() >= duration_s; };
  while (endpoint.outcome() == Outcome::kRunning && !time_over()) {
    const bool stop = stop_wanted.load(std::memory_order_relaxed);
    const bool busy = endpoint.Poll(stop ? 0 : rt::NowNs() + kStopCheck_ns);
    if (stop && !busy) return;
    if (!busy)
      sched_yield();  // a flood of others' frames must not keep the controller from the core they share
  }
}

int Run(const Options& options) {
  rt::UseSmallThreadStacks();
  const PlantConfig config = LoadPlantConfig(options.config, options.load);
  const bool realtime = options.clock == rt::ClockKind::kRealtime;
  const std::atomic<bool>& stop_wanted = rt::StopFlag();
  FlexibleArmBody body(config);
  const std::unique_ptr<bus::Transport> transport = bus::OpenTransport(options.bus);
  bus::ReedControllerCodec listener;
  RefuseSecondArm(*transport, listener);
  Publisher publisher(
      {options.log, options.lcm, !options.quiet, realtime ? WhenFull::kDrop : WhenFull::kWait, &stop_wanted});
  rt::HostPauseWatch watch;
  const std::unique_ptr<Endpoint> endpoint =
      MakeEndpoint(options, config, *transport, body, publisher, watch);
  std::optional<rt::RealtimeScope> scope;
  if (realtime) {
    const TimingConfig& timing = config.timing;
    std::vector<std::string> refused{watch.Start(PlantCore(timing), timing.priority + 1)};
    scope.emplace(RealtimeWish(timing));
    for (const std::string& line : scope->report().Complaints()) refused.push_back(line);
    for (const std::string& line : refused) {
      if (!line.empty()) std::fprintf(stderr, "reed_plant_sim: %s\n", line.c_str());
    }
  }

  Say(options.quiet, "arm " + config.arm.name + ", clock " + (realtime ? "realtime" : "lockstep") +
                         ": waiting for SYNC on " + transport->interface());
  Serve(*endpoint, options.duration_s, stop_wanted);
  return Conclude(*endpoint, publisher, options.quiet);
}

}  // namespace
}  // namespace reed::plant

int main(int argc, char** argv) {
  return reed::rt::RunProgram("reed_plant_sim",
                              [&] { return reed::plant::Run(reed::plant::ParseOptions(argc, argv)); });
}
