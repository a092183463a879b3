#include "options.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>

namespace reed {

ReplayOptions ParseReplayOptions(int argc, char** argv) {
  ReplayOptions options;
  CLI::App app{"Plays a tape to the controller and writes what it does now as a tape of the same form."};
  app.set_version_flag("--version", REED_VERSION);
  app.add_option("--tape", options.tape, "the tape.reed of a run folder")->required();
  app.add_option("--out", options.out, "the tape to write")->required();
  app.add_option("--config", options.config, "the controller's configuration, as the tape holds it")
      ->required();
  app.add_option("--arm", options.load.arm, "arm: a name in config/arms or a file; default: the tape's");
  app.add_option("--set", options.load.set, "SECTION.KEY=VALUE, may be repeated")->allow_extra_args(false);
  app.add_option("--law", options.law, "a law from outside: LIB.so[:ARGUMENT]; default: the scenario's");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    std::exit(app.exit(help));  // NOLINT(concurrency-mt-unsafe): one thread
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "reed_replay: %s (reed_replay --help lists the options)\n", error.what());
    std::exit(2);  // NOLINT(concurrency-mt-unsafe): one thread
  }
  return options;
}

}  // namespace reed
