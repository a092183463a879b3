// The controller's half of a scenario file. RT: set-up only.
#pragma once

#include <string>

#include "reed/config/controller/controller_config.h"
#include "reed/config/description/load_options.h"

namespace reed {

/// Reads a scenario (or a file with this half alone), applies the overrides, checks every key and every rule
/// between keys. Throws ConfigError: one line with file, line, key and what is allowed.
ControllerConfig LoadControllerConfig(const std::string& name_or_path, const LoadOptions& options = {});

/// As the reader takes it back: every key, after defaults and overrides.
std::string TextOf(const ControllerConfig& config);

}  // namespace reed
