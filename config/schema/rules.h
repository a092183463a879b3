// Rules between keys: what no single bound can say. RT: set-up only.
#pragma once

#include "config/schema/document.h"
#include "config/schema/scenario.h"

namespace reed {

/// Throws ConfigError that names the rule and the numbers that break it.
void CheckRules(const Document& doc, const Scenario& scenario);

}  // namespace reed
