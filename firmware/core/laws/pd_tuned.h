// PD with the scenario's gains. RT: safe.
#pragma once

#include "reed/core/laws/pd.h"

namespace reed::strategy::laws {

template <int N, int P>
struct PdTuned : Pd<N, P> {
  static constexpr LawTraits kTraits{.smooth = true};
};

}  // namespace reed::strategy::laws
