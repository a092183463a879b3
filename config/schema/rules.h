// Rules between keys: what no single bound can say. RT: set-up only.
#pragma once

#include "reed/config/schema/document.h"
#include "reed/config/schema/scenario.h"

namespace reed {

/// Throws ConfigError that names the rule and the numbers that break it. has_law: false for the plant's half alone.
void CheckRules(const Document& doc, const Scenario& scenario, bool has_law);

}  // namespace reed
