// The table of kinds. A new one is a file in kinds/ and a line in kinds.def. RT: reading is safe.
#pragma once

#include <span>
#include <string>

#include "reed/plant/faults/fault.h"

namespace reed::plant {

#define REED_FAULT_KIND(kind) extern const Kind kind;
#include "reed/plant/faults/kinds.def"
#undef REED_FAULT_KIND

std::span<const Kind* const> AllKinds() noexcept;
/// nullptr: no such kind.
const Kind* FindKind(const std::string& name) noexcept;

}  // namespace reed::plant
