// Scenario files: config/scenarios/*.toml. RT: set-up only.
#pragma once

#include <string>
#include <vector>

#include "reed/config/description/scenario.h"
#include "reed/config/schema/config_error.h"

namespace reed {

struct LoadOptions {
  std::string arm;               // replaces the scenario's arm: name or path; "" keeps it
  std::vector<std::string> set;  // "SECTION.KEY=VALUE"
};

/// Reads a scenario with its arm, applies the overrides, checks every key and every rule between keys.
/// Throws ConfigError: one line with file, line, key and what is allowed.
Scenario LoadScenario(const std::string& name_or_path, const LoadOptions& options = {});

/// The whole configuration after defaults and overrides, as a scenario file that LoadScenario reads back
/// unchanged.
std::string EffectiveToml(const Scenario& scenario);

/// Markdown table of every key with unit, range, default and meaning (config/README.md holds it; a test
/// compares).
std::string KeyReference();

}  // namespace reed
