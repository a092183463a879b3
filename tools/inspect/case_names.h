// Which names a case may hold: a misspelt input would otherwise be answered by silence. RT: set-up only.
#pragma once

#include <string>
#include <vector>

#include "reed/inspect/named_values.h"

namespace reed::inspect {

/// Throws CaseError naming the first of `names` that is neither an input nor a number of the reference files. A
/// case that brings results of its own to compare with, names that `result` has, may bring any others too.
void RequireKnownNames(const std::vector<std::string>& names, const NamedValues& result);

}  // namespace reed::inspect
