// separated without adaptation: p_hat = p_0, same gains, same force loop. RT: safe.
#pragma once

#include "reed/core/law/law.h"

namespace reed::strategy::laws {

template <int N, int P>
struct FixedNominal : LawBase<N, P> {
  using typename LawBase<N, P>::In, typename LawBase<N, P>::State, typename LawBase<N, P>::V;
  static constexpr LawTraits kTraits{.force_loop = true, .deflection_allowed = true};

  static V Known(const In& in, const State& x) noexcept {
    return control::KnownForceTorque<N>(in.arm.rotor_inertia, in.aux.v_dot, in.regressor.f(x.p_hat), in.JtF_d,
                                        in.gains.K_d, in.s);
  }
  static V Unknown(const In& in, const State& x) noexcept {
    return control::UnknownForceTorque<N>(in.arm.rotor_inertia, in.aux.v_dot, in.regressor.f(x.p_hat),
                                          in.gains.K_d, in.s, V::Zero().eval());
  }
};

}  // namespace reed::strategy::laws
