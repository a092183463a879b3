// The laws by number: those of core/laws, one per file, and the one from outside. Chosen once at set-up. RT: safe.
#pragma once

#include <array>

#include "reed/core/law/external_row.h"
#include "reed/laws/laws.h"

namespace reed::strategy {

template <int N, int P>
class LawBank {
 public:
  /// external: not nullptr for kExternal.
  static const Law<N, P>& Get(LawId id, const ExternalLaw* external = nullptr) noexcept {
    if (id != LawId::kExternal || external == nullptr)
      return kBuiltInLaws<N, P>[static_cast<std::size_t>(id == LawId::kExternal ? LawId::kSeparated : id)];
    return kExternalLaws[external->traits & (REED_LAW_FORCE_LOOP | REED_LAW_DEFLECTION)];
  }

 private:
  static constexpr Law<N, P> External(bool force_loop, bool deflection) {
    return LawOf<ExternalRow<N, P>, N, P>(
        {.force_loop = force_loop, .deflection_allowed = deflection, .smooth = true});
  }
  // By the traits of reed/law.h.
  static constexpr std::array<Law<N, P>, 4> kExternalLaws{External(false, false), External(true, false),
                                                          External(false, true), External(true, true)};
};

}  // namespace reed::strategy
