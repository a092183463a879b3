// (31)-(34), (36)-(41) as the paper prints them, with its gains. RT: safe.
#pragma once

#include "reed/core/law/law.h"
#include "reed/core/law/paper_printed.h"

namespace reed::strategy::laws {

template <int N, int P>
struct PaperPrinted : LawBase<N, P> {
  using typename LawBase<N, P>::In, typename LawBase<N, P>::State, typename LawBase<N, P>::V;
  static constexpr LawTraits kTraits{.gains = GainSet::kPaper};

  static V Known(const In& in, const State& x) noexcept {
    const model::Vec<P> p_hat = control::PrintedParameters<P>(x.eta_hat, YtsOf(in));
    return KnownForceOf(in, p_hat);
  }
  static V Unknown(const In& in, const State& x) noexcept {
    const model::Vec<P> p_hat = control::PrintedParameters<P>(x.eta_hat, YtsOf(in));
    return control::PrintedUnknownForceTorque<N>(in.arm.rotor_inertia, in.aux.v_dot, in.regressor.f(p_hat),
                                                 x.sigma_0, x.sigma_1, in.s);
  }
  static void AdaptKnown(const In& in, State& x) noexcept {
    x.eta_hat = control::PrintedEta<P>(in.gains.Gamma_known, YtsOf(in));
  }
  static void AdaptUnknown(const In& in, State& x) noexcept {
    x.eta_hat += in.T * control::EtaRate<P>(in.gains.Gamma_unknown, YtsOf(in));
    x.sigma_0 = control::PrintedSigma<N>(in.gains.sliding.c_0, in.s);
    x.sigma_1 = control::PrintedSigma<N>(in.gains.sliding.c_1, in.s);
  }
};

}  // namespace reed::strategy::laws
