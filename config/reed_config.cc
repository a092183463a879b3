// reed_config: checks a scenario and writes what the programs will run with, after defaults and overrides.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "reed/config/schema/halves.h"
#include "reed/config/schema/plausibility.h"
#include "reed/config/schema/scenario_file.h"
#include "reed/plant/dynamics/arm_plant.h"
#include "reed/plant/faults/fault_checks.h"
#include "reed/rt/program.h"

namespace {

void Write(const std::string& path, const std::string& text) {
  if (path.empty()) return;
  std::ofstream out(path);
  if (!(out << text << std::flush)) throw reed::ConfigError(path + ": cannot be written");
}

void PrintMargins(const std::vector<reed::JointLoop>& loops) {
  const char* comma = "[";
  for (const reed::JointLoop& loop : loops) {
    const reed::LoopMargin margin = reed::MarginOf(loop);
    std::printf("%s{\"K_d\": %.9g, \"M_ii\": %.9g, \"gain_margin\": %.9g, \"phase_margin_deg\": %.9g}", comma,
                loop.K_d, loop.inertia_kgm2, margin.gain, margin.phase_deg);
    comma = ", ";
  }
  std::printf("%s]\n", loops.empty() ? "[" : "");
}

/// What the simulated arm would refuse when it starts.
std::optional<reed::KeyProblem> NoEquilibrium(const reed::Scenario& scenario) {
  try {
    const reed::plant::ArmPlant at_rest(reed::PlantHalf(scenario));
  } catch (const reed::plant::NoEquilibrium& none) {
    return reed::KeyProblem{"reference.start_rad", none.kProblem};
  }
  return std::nullopt;
}

/// A fault that nothing would apply.
std::optional<reed::KeyProblem> IdleFault(const reed::Scenario& scenario) {
  const auto found = reed::plant::FindProblem(reed::PlantHalf(scenario), scenario.duration_s);
  if (!found) return std::nullopt;
  return reed::KeyProblem{"fault[" + std::to_string(found->fault) + "]." + found->key, found->text};
}

int Run(int argc, char** argv) {
  CLI::App app{"Checks a Reed scenario with its arm. Exit 0: sound, 2: not, with one line that says where."};
  std::string scenario = "press_known", write_path, controller_path, plant_path;
  reed::LoadOptions options;
  bool keys = false, arm_keys = false, fault_kinds = false, margins = false;
  app.set_version_flag("--version", REED_VERSION);
  app.add_option("--config", scenario, "scenario: name in config/scenarios, or path");
  app.add_option("--arm", options.arm, "arm instead of the scenario's: name in config/arms, or path");
  app.add_option("--set", options.set, "SECTION.KEY=VALUE, repeatable")->take_all();
  app.add_option("--write", write_path, "write the effective configuration here");
  app.add_option("--write-controller", controller_path,
                 "write the controller's half here: nothing of the truth");
  app.add_option("--write-plant", plant_path, "write the plant's half here: nothing of the law");
  app.add_flag("--margins", margins, "print gain and phase margin of every joint's loop, as JSON");
  app.add_flag("--keys", keys, "print the table of a scenario's keys (config/README.md)");
  app.add_flag("--fault-kinds", fault_kinds, "print the table of the kinds of faults (docs/faults.md)");
  app.add_flag("--arm-keys", arm_keys, "print the table of an arm's keys (config/README.md)");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "%s (reed_config --help lists the options)\n", error.what());
    return 2;
  }
  if (fault_kinds) {
    std::cout << reed::plant::FaultKindTable();
    return 0;
  }
  if (keys || arm_keys) {
    std::cout << (keys ? reed::KeyReference() : reed::ArmKeyReference());
    return 0;
  }
  try {
    const reed::Scenario checked =
        reed::LoadScenario(scenario, options, reed::Wanted::kWhole, {IdleFault, NoEquilibrium});
    if (margins) PrintMargins(reed::LoopsOf(checked, reed::Load::kStart));
    Write(write_path, reed::EffectiveToml(checked));
    Write(controller_path, reed::ToToml(reed::ControllerHalf(checked)));
    Write(plant_path, reed::ToToml(reed::PlantHalf(checked)));
  } catch (const std::exception& error) {  // ConfigError, or what the libraries below it refuse
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return reed::rt::RunProgram("reed_config", [&] { return Run(argc, argv); });
}
