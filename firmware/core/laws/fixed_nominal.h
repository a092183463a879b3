// separated without adaptation: p_hat = p_0, same gains, same force loop. RT: safe.
#pragma once

#include "reed/core/law/law.h"

namespace reed::strategy::laws {

template <int N, int P>
struct FixedNominal : LawBase<N, P> {
  using typename LawBase<N, P>::In, typename LawBase<N, P>::State, typename LawBase<N, P>::V;
  static constexpr LawTraits kTraits{
      .force_loop = true, .deflection_allowed = true, .follows = true, .smooth = true};

  static V Known(const In& in, const State& x) noexcept { return KnownForceOf(in, x.p_hat); }
  static V Unknown(const In& in, const State& x) noexcept {
    return UnknownForceOf(in, x.p_hat, V::Zero().eval());
  }
};

}  // namespace reed::strategy::laws
