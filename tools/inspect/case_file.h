// Case files: {"cases": [{name: numbers, ...}, ...], name: numbers, ...} in, the same shape out. RT: set-up
// only.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "reed/inspect/named_values.h"

namespace reed::inspect {

struct Case {
  NamedValues values;
  std::vector<std::string> names;  // of its own numbers, without those beside "cases"
};

/// The cases in order. Numbers beside "cases" belong to every case that does not say otherwise; texts are
/// left out. Throws CaseError.
std::vector<Case> ReadCases(std::istream& in);

/// {"arm": ..., "cases": [...]}; doubles round-trip.
void WriteCases(std::ostream& out, const std::string& arm, const std::vector<NamedValues>& cases);

}  // namespace reed::inspect
