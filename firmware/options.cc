#include "options.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace reed {

Options ParseOptions(int argc, char** argv) {
  Options options;
  CLI::App app{
      "Real-time controller for robot arms that bend: SYNC out, states in, torques out, telemetry on LCM."};
  app.set_version_flag("--version", REED_VERSION);
  app.add_option("--config", options.config, "scenario: a name in config/scenarios or a TOML file")
      ->required();
  app.add_option("--arm", options.load.arm, "arm: a name in config/arms or a file; default: the scenario's");
  app.add_option("--set", options.load.set, "SECTION.KEY=VALUE, may be repeated")->allow_extra_args(false);
  app.add_option("--bus", options.bus, "socketcan:IFACE or udp[:GROUP:PORT]")->capture_default_str();
  std::string clock = "realtime";
  app.add_option("--clock", clock,
                 "realtime (old name: wall): paced by the clock; lockstep: the next cycle starts when this "
                 "one is done")
      ->check(CLI::IsMember({"realtime", "wall", "lockstep"}))
      ->capture_default_str();
  app.add_flag("--enable", options.control.enable,
               "open the brakes once every joint is measured; without it the arm is only measured");
  app.add_option("--log", options.control.log, "LCM event log that gets every message");
  app.add_option("--candump", options.control.candump, "CAN log in candump -L format");
  app.add_option("--tape", options.control.tape, "all that a replay of the controller needs, cycle by cycle");
  app.add_option("--tape-commit", options.control.commit, "the programs' commit, as the tape names it");
  app.add_option("--law", options.control.law,
                 "a law from outside: a shared library with the functions of reed/law.h, LIB.so[:ARGUMENT]");
  app.add_flag("--seccomp", options.control.seccomp,
               "any system call of the loop beyond the named few ends the program");
  app.add_flag("--host-pause", options.control.host_pause,
               "bench only: cycles missed while the host paused do not stop the arm; refused where real "
               "drives may be");
  app.add_flag("--quiet", options.control.quiet, "print errors only");
  app.add_flag("!--no-lcm", options.control.lcm, "do not publish on the LCM network");
  try {
    app.parse(argc, argv);
    if (options.control.host_pause && clock == "lockstep")
      throw CLI::ValidationError("--host-pause", "lockstep follows no clock; only with --clock realtime");
  } catch (const CLI::Success& help) {
    std::exit(app.exit(help));  // NOLINT(concurrency-mt-unsafe): one thread so far
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "reed_firmware: %s (reed_firmware --help lists the options)\n", error.what());
    std::exit(2);  // NOLINT(concurrency-mt-unsafe): one thread so far
  }
  options.control.clock = clock == "lockstep" ? rt::ClockKind::kLockstep : rt::ClockKind::kRealtime;
  return options;
}

}  // namespace reed
