// PD with the paper's gains. RT: safe.
#pragma once

#include "reed/core/law/law.h"
#include "reed/core/law/pd.h"

namespace reed::strategy::laws {

template <int N, int P>
struct Pd : LawBase<N, P> {
  using typename LawBase<N, P>::In, typename LawBase<N, P>::State, typename LawBase<N, P>::V;
  static constexpr LawTraits kTraits{.smooth = true, .gains = GainSet::kPaperFeedback};

  static V Known(const In& in, const State&) noexcept { return control::PdTorque<N>(in.gains.K_d, in.s); }
  static constexpr auto Unknown = Known;
};

}  // namespace reed::strategy::laws
