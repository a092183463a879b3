// Which faults a run has, and whether each of them would do anything. RT: set-up only.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reed/config/description/config_error.h"
#include "reed/config/plant/plant_config.h"

namespace reed::plant {

/// The scenario's, then those that older keys mean (sensors.wrench_lost_from_s).
std::vector<FaultConfig> FaultsOf(const PlantConfig& config);

/// Why the configuration's fault number `fault` would not be applied as it says.
struct FaultProblem {
  std::size_t fault = 0;
  std::string key, text;
};

/// The first one. duration_s: of the run, where it is known.
std::optional<FaultProblem> FindProblem(const PlantConfig& config, double duration_s = 0.0);

/// Markdown table of all kinds (docs/faults.md holds it; a test compares).
std::string FaultKindTable();

}  // namespace reed::plant
