// reed_inspect: the model and the law as numbers, computed by the code that the firmware runs.
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>

#include "reed/config/schema/arm_file.h"
#include "reed/inspect/arm_inspector.h"
#include "reed/inspect/case_file.h"
#include "reed/inspect/case_names.h"
#include "reed/inspect/modes_query.h"
#include "reed/rt/program.h"

namespace {

constexpr int kWrongInput = 2;

std::vector<reed::inspect::Case> Read(const std::string& states) {
  if (states == "-") return reed::inspect::ReadCases(std::cin);
  std::ifstream file(states);
  if (!file) throw reed::inspect::CaseError("cannot be read");
  return reed::inspect::ReadCases(file);
}

int InspectStates(const std::string& arm_name, const std::string& states) {
  const reed::ArmDescription arm = reed::LoadArm(arm_name);
  const auto inspector = reed::inspect::MakeInspector(arm);
  std::vector<reed::inspect::NamedValues> results;
  std::string where = states == "-" ? "standard input" : states;
  try {
    const auto cases = Read(states);
    where += ": cases[";
    for (const auto& inputs : cases) {
      reed::inspect::NamedValues answer = inspector->Inspect(inputs.values);
      reed::inspect::RequireKnownNames(inputs.names, answer);
      results.push_back(std::move(answer));
    }
  } catch (const reed::inspect::CaseError& error) {
    const bool in_a_case = where.back() == '[';
    std::cerr << where << (in_a_case ? std::to_string(results.size()) + "]." : ": ") << error.what() << '\n';
    return kWrongInput;
  }
  reed::inspect::WriteCases(std::cout, arm.name, results);
  return 0;
}

int Run(int argc, char** argv) {
  CLI::App app{"The model and the law as numbers, computed by the code that the firmware runs",
               "reed_inspect"};
  std::string arm, states = "-", beam;
  std::vector<double> pose;
  int modes = 0;
  app.set_version_flag("--version", REED_VERSION);
  app.add_option("--arm", arm, "name in config/arms, or a path");
  app.add_option("--states", states, "JSON file with {\"cases\": [...]}, or - for standard input");
  app.add_option("--modes", modes, "instead of states: this many modes, with locked motors")
      ->check(CLI::Range(1, 1000));
  app.add_option("--at", pose,
                 "motor angles for --modes or --plot, apart by blanks or commas (default: all zero)")
      ->type_name("RAD ...")
      ->delimiter(',');
  app.add_option("--beam", beam,
                 "modes of a clamped beam: length=m,EI=N·m²,rhoA=kg/m[,tip_mass=kg][,elements=N]");
  try {
    app.parse(argc, argv);
    if (arm.empty() == beam.empty()) throw reed::inspect::CaseError("one of --arm and --beam is needed");
    if (beam.empty() && modes == 0 && !pose.empty()) throw reed::inspect::CaseError("--at needs --modes N");
    if (beam.empty() && modes == 0) return InspectStates(arm, states);
    if (modes == 0) throw reed::inspect::CaseError("--beam needs --modes N");
    if (beam.empty()) {
      reed::inspect::WriteArmModes(std::cout, reed::LoadArm(arm), pose, modes);
    } else {
      reed::inspect::WriteBeamModes(std::cout, reed::inspect::ParseBeam(beam), modes);
    }
    return 0;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::cerr << "reed_inspect: " << error.what() << " (tools/reed inspect --help lists the options)\n";
    return kWrongInput;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return kWrongInput;
  }
}

}  // namespace

int main(int argc, char** argv) {
  return reed::rt::RunProgram("reed_inspect", [&] { return Run(argc, argv); });
}
