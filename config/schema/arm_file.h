// Arm files: config/arms/*.toml, or JSON with the same keys. RT: set-up only.
#pragma once

#include <string>

#include "reed/config/description/config_error.h"
#include "reed/config/schema/arm_description.h"
#include "reed/config/schema/document.h"

namespace reed {

/// Reads and checks an arm. `name_or_path`: a name in config/arms, or a path to a .toml or .json file.
/// Throws ConfigError naming file, line, key and what is allowed.
ArmDescription LoadArm(const std::string& name_or_path);

/// The same from a tree that is already there (a scenario's [arm] section). `section` prefixes the keys in
/// errors.
ArmDescription ReadArm(const Document& doc, toml::table& table, const std::string& section);

/// config/arms/NAME.toml for a name, the path itself otherwise. Throws ConfigError that lists the names there
/// are.
std::string FindConfig(const std::string& kind, const std::string& name_or_path);

/// The arm as a TOML table that ReadArm reads back to the same description.
toml::table WriteArm(const ArmDescription& arm);

}  // namespace reed
