// Rules between keys: what no single bound can say. RT: set-up only.
#pragma once

#include "reed/config/description/scenario.h"
#include "reed/config/schema/document.h"

namespace reed {

/// Throws ConfigError that names the rule and the numbers that break it.
void CheckRules(const Document& doc, const Scenario& scenario);

}  // namespace reed
