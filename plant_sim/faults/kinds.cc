#include "reed/plant/faults/kinds.h"

namespace reed::plant {
namespace {

constexpr const Kind* kAll[] = {
#define REED_FAULT_KIND(kind) &kind,
#include "reed/plant/faults/kinds.def"
#undef REED_FAULT_KIND
};

}  // namespace

std::span<const Kind* const> AllKinds() noexcept { return kAll; }

const Kind* FindKind(const std::string& name) noexcept {
  for (const Kind* kind : kAll)
    if (name == kind->name) return kind;
  return nullptr;
}

}  // namespace reed::plant
