#include "options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace reed::plant {

Options ParseOptions(int argc, char** argv) {
  Options options;
  CLI::App app{
      "Simulated robot arm that bends: drives, joints, links, wall and sensors behind a CAN FD bus."};
  app.set_version_flag("--version", REED_VERSION);
  app.add_option("--config", options.config, "scenario: a name in config/scenarios or a TOML file")
      ->required();
  app.add_option("--arm", options.load.arm,
                 "arm: a name in config/arms or a TOML file; default: the scenario's");
  app.add_option("--set", options.load.set, "SECTION.KEY=VALUE, may be repeated")->allow_extra_args(false);
  app.add_option("--bus", options.bus, "socketcan:IFACE or udp[:GROUP:PORT]")->capture_default_str();
  std::string clock = "realtime";
  app.add_option("--clock", clock,
                 "realtime (old name: wall): the arm moves on its own; lockstep: one period per SYNC")
      ->check(CLI::IsMember({"realtime", "wall", "lockstep"}))
      ->capture_default_str();
  app.add_option("--log", options.log, "LCM event log that gets every message");
  app.add_option("--duration", options.duration_s, "stop after so many seconds of plant time")
      ->check(CLI::PositiveNumber);
  app.add_flag("--quiet", options.quiet, "print errors only");
  app.add_flag("!--no-lcm", options.lcm, "do not publish on the LCM network");
  try {
    app.parse(argc, argv);
    if (!std::isfinite(options.duration_s))
      throw CLI::ValidationError("--duration", "is not a finite number");
  } catch (const CLI::Success& help) {
    std::exit(app.exit(help));  // NOLINT(concurrency-mt-unsafe): one thread so far
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "reed_plant_sim: %s (reed_plant_sim --help lists the options)\n", error.what());
    std::exit(2);  // NOLINT(concurrency-mt-unsafe): one thread so far
  }
  options.clock = clock == "lockstep" ? rt::ClockKind::kLockstep : rt::ClockKind::kRealtime;
  return options;
}

}  // namespace reed::plant
