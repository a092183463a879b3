// Rules that need the arm in its start pose, and keys that do nothing together. RT: set-up only.
#pragma once

#include <vector>

#include "reed/config/schema/document.h"
#include "reed/config/schema/loop_margin.h"
#include "reed/config/schema/scenario.h"

namespace reed {

/// Throws ConfigError that names the rule and the numbers that break it. Sizes are checked before.
void CheckPlausiblePlant(const Document& doc, const Scenario& scenario);
void CheckPlausibleLaw(const Document& doc, const Scenario& scenario);

enum class Load { kStart, kHeaviest };  // the parameters at their start, at the upper end of their box

/// The loop of every joint about rest in the start pose. Empty: the law has gains of its own.
std::vector<JointLoop> LoopsOf(const Scenario& scenario, Load load);

}  // namespace reed
