// Scenario files: config/scenarios/*.toml. RT: set-up only.
#pragma once

#include <functional>
#include <string>

#include "reed/config/description/config_error.h"
#include "reed/config/description/load_options.h"
#include "reed/config/schema/scenario.h"

namespace reed {

/// A file with the plant's half alone has no law to be checked.
enum class Wanted { kWhole, kPlantHalf };

/// A check that needs more than the files: what is wrong with the value of `key`, "" if nothing.
struct FurtherCheck {
  const char* key;
  std::function<std::string(const Scenario&)> problem;
};

/// Reads a scenario with its arm, applies the overrides, checks every key and every rule between keys.
/// Throws ConfigError: one line with file, line, key and what is allowed.
Scenario LoadScenario(const std::string& name_or_path, const LoadOptions& options = {},
                      Wanted wanted = Wanted::kWhole, const FurtherCheck* further = nullptr);

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
