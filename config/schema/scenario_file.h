// Scenario files: config/scenarios/*.toml. RT: set-up only.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reed/config/description/config_error.h"
#include "reed/config/description/load_options.h"
#include "reed/config/schema/scenario.h"

namespace reed {

/// A file with the plant's half alone has no law to be checked.
enum class Wanted { kWhole, kPlantHalf };

/// What is wrong with the value of a key.
struct KeyProblem {
  std::string key, text;
};

/// A check that needs more than the files.
using FurtherCheck = std::function<std::optional<KeyProblem>(const Scenario&)>;

/// Reads a scenario with its arm, applies the overrides, checks every key and every rule between keys.
/// Throws ConfigError: one line with file, line, key and what is allowed.
Scenario LoadScenario(const std::string& name_or_path, const LoadOptions& options = {},
                      Wanted wanted = Wanted::kWhole, const std::vector<FurtherCheck>& further = {});

/// The whole configuration after defaults and overrides, as a scenario file that LoadScenario reads back
/// unchanged.
std::string EffectiveToml(const Scenario& scenario);

/// One half, as a file that its loader reads back unchanged.
std::string ToToml(const ControllerConfig& half);
std::string ToToml(const PlantConfig& half);

/// Markdown tables of every key with unit, range, default and meaning (config/README.md holds them; a test
/// compares).
std::string KeyReference();
std::string ArmKeyReference();

}  // namespace reed
