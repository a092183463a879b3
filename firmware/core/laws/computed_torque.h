// Computed torque: the inverse of the model with p_0. RT: safe.
#pragma once

#include "reed/core/law/computed_torque.h"
#include "reed/core/law/law.h"

namespace reed::strategy::laws {

template <int N, int P>
struct ComputedTorque : LawBase<N, P> {
  using typename LawBase<N, P>::In, typename LawBase<N, P>::State, typename LawBase<N, P>::V;
  static constexpr LawTraits kTraits{.acceleration = true, .follows = true, .smooth = true};

  static V Known(const In& in, const State& x) noexcept {
    return control::ComputedTorque<N>(in.arm.rotor_inertia, in.aux.v_dot, in.regressor.f(x.p_hat));
  }
  static constexpr auto Unknown = Known;
};

}  // namespace reed::strategy::laws
