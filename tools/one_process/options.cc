#include "options.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>

namespace reed {

OneProcessOptions ParseOneProcessOptions(int argc, char** argv) {
  OneProcessOptions options;
  options.control.clock = rt::ClockKind::kLockstep;
  CLI::App app{"Controller and simulated arm in one process, in lockstep, on a bus in memory."};
  app.add_option("--config", options.config, "scenario: a name in config/scenarios or a TOML file")
      ->required();
  app.add_option("--arm", options.load.arm, "arm: a name in config/arms or a file; default: the scenario's");
  app.add_option("--set", options.load.set, "SECTION.KEY=VALUE, may be repeated")->allow_extra_args(false);
  app.add_option("--law", options.control.law,
                 "a law from outside: a shared library with the functions of reed/law.h, LIB.so[:ARGUMENT]");
  app.add_flag("--enable", options.control.enable,
               "open the brakes once every joint is measured; without it the arm is only watched");
  app.add_option("--log", options.control.log, "LCM event log of the controller");
  app.add_option("--plant-log", options.plant_log, "LCM event log of the arm");
  app.add_option("--candump", options.control.candump, "CAN log in candump -L format");
  app.add_option("--tape", options.control.tape, "all that a replay of the controller needs, cycle by cycle");
  app.add_option("--tape-commit", options.control.commit, "the programs' commit, as the tape names it");
  app.add_flag("!--leave-memory-unlocked", options.control.lock_memory,
               "for many runs whose page faults nobody counts: a fifth of a start");
  app.add_flag("--quiet", options.control.quiet, "print errors only");
  app.add_flag("!--no-lcm", options.control.lcm, "do not publish on the LCM network");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    std::exit(app.exit(help));  // NOLINT(concurrency-mt-unsafe): one thread so far
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "reed_one_process: %s (reed_one_process --help lists the options)\n", error.what());
    std::exit(2);  // NOLINT(concurrency-mt-unsafe): one thread so far
  }
  return options;
}

}  // namespace reed
