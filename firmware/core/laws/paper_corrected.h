// (31)-(34), (36)-(41) corrected, with the paper's gains, no dead zone, no leak. RT: safe.
#pragma once

#include "reed/core/law/law.h"

namespace reed::strategy::laws {

template <int N, int P>
struct PaperCorrected : LawBase<N, P> {
  using typename LawBase<N, P>::In, typename LawBase<N, P>::State, typename LawBase<N, P>::V;
  static constexpr LawTraits kTraits{.force_loop = true, .gains = GainSet::kPaper};

  static V Known(const In& in, const State& x) noexcept { return KnownForceOf(in, x.p_hat); }
  static V Unknown(const In& in, const State& x) noexcept {
    const model::Vec<P> sign_Yts = control::Saturate(YtsOf(in), in.gains.sliding.phi);
    const model::Vec<P> p_hat = control::WorstCaseParameters<P>(in.gains.p_0, x.eta_hat, sign_Yts);
    return UnknownForceOf(in, p_hat, SlidingOf(in, x));
  }
  static void AdaptKnown(const In& in, State& x) noexcept {
    x.p_hat += in.T * control::KnownForceUpdate<N, P>(in.gains.Gamma_known, in.regressor.Y, in.s);
  }
  static void AdaptUnknown(const In& in, State& x) noexcept {
    x.eta_hat += in.T * control::EtaRate<P>(in.gains.Gamma_unknown, YtsOf(in));
    x.sigma_0 += in.T * control::Sigma0Rate<N>(in.gains.sliding.c_0, in.s);
    x.sigma_1 += in.T * control::Sigma1Rate<N>(in.gains.sliding.c_1, in.s);
  }
};

}  // namespace reed::strategy::laws
