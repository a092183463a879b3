// The paper's separated strategy, made robust: (30)-(34) where the force is known, (36), (40), (41) where it is not,
// Coulomb friction (48). RT: safe.
#pragma once

#include "reed/core/law/law.h"

namespace reed::strategy::laws {

template <int N, int P>
struct Separated : LawBase<N, P> {
  using typename LawBase<N, P>::In, typename LawBase<N, P>::State, typename LawBase<N, P>::V;
  static constexpr LawTraits kTraits{
      .force_loop = true, .deflection_allowed = true, .follows = true, .smooth = true};

  static V Known(const In& in, const State& x) noexcept {
    return KnownForceOf(in, x.p_hat) + SlidingOf(in, x) + Friction(in, x);
  }
  static V Unknown(const In& in, const State& x) noexcept {
    return UnknownForceOf(in, x.p_hat, SlidingOf(in, x)) + Friction(in, x) - in.r;
  }
  static void AdaptKnown(const In& in, State& x) noexcept {
    Update(in, in.gains.Gamma_known, in.gains.Gamma_c_known, x);
  }
  static void AdaptUnknown(const In& in, State& x) noexcept {
    Update(in, in.gains.Gamma_unknown, in.gains.Gamma_c_unknown, x);
  }

 private:
  static V Friction(const In& in, const State& x) noexcept {
    return control::CoulombTorque<N>(x.kappa_hat, in.aux.v, in.gains.friction_speed);  // (48)
  }
  static void Update(const In& in, const model::Vec<P>& Gamma, const V& Gamma_c, State& x) noexcept {
    const V s_dz = control::DeadZone(in.s, in.gains.dead_zone);
    x.UpdateParameters(in.gains, Gamma, in.arm, in.regressor.Y, s_dz, in.T);
    x.UpdateFriction(in.gains, Gamma_c, in.aux.v, s_dz, in.T);
    x.UpdateSliding(in.gains, s_dz, in.T);
  }
};

}  // namespace reed::strategy::laws
