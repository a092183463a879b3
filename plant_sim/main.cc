// reed_plant_sim: an arm on a bus. Set-up (may allocate, may throw), then one endpoint polled until it ends.
//
//   frames -> BusPort -> Robot (DriveChain -> ArmPlant -> sensors) -> BusPort -> frames
//                          `-> Journal -> Publisher (own thread) -> event log, LCM, terminal
#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <vector>

#include "options.h"
#include "reed/bus/transport/open_transport.h"
#include "reed/config/description/cores.h"
#include "reed/config/plant/load_plant_config.h"
#include "reed/plant/endpoint/flexible_arm_body.h"
#include "reed/plant/endpoint/lockstep_endpoint.h"
#include "reed/plant/endpoint/realtime_endpoint.h"
#include "reed/plant/process/realtime.h"
#include "reed/plant/process/stall_watch.h"
#include "reed/plant/process/stop_signal.h"
#include "reed/plant/record/publisher.h"

namespace reed::plant {
namespace {

void Say(const Options& options, const std::string& line) {
  if (options.quiet) return;
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

std::unique_ptr<Endpoint> MakeEndpoint(const Options& options, const PlantConfig& config,
                                       bus::Transport& transport, ArmBody& body, Recorder& recorder,
                                       const StallWatch& watch) {
  if (options.clock == ClockKind::kLockstep) {
    return std::make_unique<LockstepEndpoint>(config, transport, body, recorder);
  }
  WallClock clock = WallClock::System();
  clock.stood_ns = [&watch] { return watch.stood_ns(); };
  return std::make_unique<WallEndpoint>(config, transport, body, recorder, clock);
}

/// Until the endpoint ends by itself, its time is over, or a signal asks; then what already lies on the bus
/// is still answered, so that the record of a finished run is complete.
void Serve(Endpoint& endpoint, double duration_s) {
  const auto now_ns = WallClock::System().monotonic_ns;
  const auto time_over = [&] { return duration_s > 0.0 && endpoint.robot().time_s() >= duration_s; };
  while (endpoint.outcome() == Outcome::kRunning && !time_over()) {
    const bool stop = StopRequested();
    const bool busy = endpoint.Poll(stop ? 0 : now_ns() + kStopCheck_ns);
    if (stop && !busy) return;
  }
}

int Run(const Options& options) {
  const PlantConfig config = LoadPlantConfig(options.config, options.load);
  const bool wall = options.clock == ClockKind::kWall;
  InstallStopSignals();
  FlexibleArmBody body(config);
  const std::unique_ptr<bus::Transport> transport = bus::OpenTransport(options.bus);
  Publisher publisher({options.log, options.lcm, !options.quiet, wall ? WhenFull::kDrop : WhenFull::kWait});
  StallWatch watch;
  const std::unique_ptr<Endpoint> endpoint =
      MakeEndpoint(options, config, *transport, body, publisher, watch);
  if (wall) {
    const TimingConfig& timing = config.timing;
    std::vector<std::string> refused{watch.Start(PlantCore(timing), timing.priority + 1)};
    for (const std::string& line : AskForRealtime(timing)) refused.push_back(line);
    for (const std::string& line : refused) {
      if (!line.empty()) std::fprintf(stderr, "reed_plant_sim: %s\n", line.c_str());
    }
  }

  Say(options, "arm " + config.arm.name + ", clock " + (wall ? "wall" : "lockstep") +
                   ": waiting for SYNC on " + transport->interface());
  Serve(*endpoint, options.duration_s);

  const bool log_complete = publisher.Finish();
  Say(options, "done: " + std::to_string(endpoint->syncs()) + " cycles, " +
                   std::to_string(endpoint->rejected()) + " frames refused, " +
                   std::to_string(publisher.dropped()) + " records dropped");
  if (!endpoint->failure().empty()) std::fprintf(stderr, "reed_plant_sim: %s\n", endpoint->failure().c_str());
  const int status = ExitStatus(endpoint->outcome());
  return status == 0 && !log_complete ? 3 : status;
}

}  // namespace
}  // namespace reed::plant

int main(int argc, char** argv) {
  try {
    return reed::plant::Run(reed::plant::ParseOptions(argc, argv));
  } catch (
      const std::exception& error) {  // everything that can be thrown is thrown before the loop, by bad input
    std::fprintf(stderr, "reed_plant_sim: %s\n", error.what());
    return 2;
  }
}
