// reed_config: checks a scenario and writes what the programs will run with, after defaults and overrides.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "reed/config/schema/scenario_file.h"
#include "reed/rt/program.h"

namespace {

int Run(int argc, char** argv) {
  CLI::App app{"Checks a Reed scenario with its arm. Exit 0: sound, 2: not, with one line that says where."};
  std::string scenario = "press_known", write_path;
  reed::LoadOptions options;
  bool keys = false;
  app.set_version_flag("--version", REED_VERSION);
  app.add_option("--config", scenario, "scenario: name in config/scenarios, or path");
  app.add_option("--arm", options.arm, "arm instead of the scenario's: name in config/arms, or path");
  app.add_option("--set", options.set, "SECTION.KEY=VALUE, repeatable")->take_all();
  app.add_option("--write", write_path, "write the effective configuration here");
  app.add_flag("--keys", keys, "print the table of all keys (config/README.md)");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "%s (reed_config --help lists the options)\n", error.what());
    return 2;
  }
  if (keys) {
    std::cout << reed::KeyReference();
    return 0;
  }
  try {
    const std::string effective = reed::EffectiveToml(reed::LoadScenario(scenario, options));
    if (write_path.empty()) return 0;
    std::ofstream out(write_path);
    if (!(out << effective)) throw reed::ConfigError(write_path + ": cannot be written");
  } catch (const reed::ConfigError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return reed::rt::RunProgram("reed_config", [&] { return Run(argc, argv); });
}
