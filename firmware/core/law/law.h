// What every law is: what it may look at, what it adapts, and its row in the bank. The laws themselves are in core/laws,
// one per file. RT: safe.
#pragma once

#include <cstdint>

#include "reed/core/contact/force_source.h"
#include "reed/core/law/adaptive_state.h"
#include "reed/core/law/external_law.h"
#include "reed/core/measurement.h"
#include "reed/core/model/regressor.h"

namespace reed::strategy {

/// What a law may look at this cycle.
template <int N, int P>
struct LawInput {
  const Gains<N, P>& gains;
  const model::ArmModel<N, P>& arm;
  const control::Auxiliary<N>& aux;
  const model::Vec<N>& s;
  const model::Regressor<N, P>& regressor;  // at (v, v̇) of aux
  const model::Vec<N>& JtF_d;               // 0 unless the arm presses
  const model::Vec<N>& r;                   // observed disturbance; 0 where it must not be subtracted
  double T;
  double t_s;  // since the arm became active
  const control::Reference<N>& desired;
  double f;  // normal force as known, N
  const Measurement<N>& measured;
  ForceSource source;
  bool adapts;                  // the estimates move this cycle
  const ExternalLaw* external;  // nullptr unless the law is one from outside
};

/// Whose gains a law takes (firmware/setup/gains.h).
enum class GainSet : std::uint8_t {
  kScenario,
  kPaperFeedback,  // the paper's K_d and Lambda
  kPaper,          // and its adaptation
};

struct LawTraits {
  bool force_loop = false;          // the force error enters v (30)
  bool acceleration = false;        // v, v̇ are θ̇ and ComputedAcceleration: computed torque
  bool deflection_allowed = false;  // θ_d may be corrected by the static deflection
  bool follows = false;             // no standing error: a joint has the speed v (monitors 49 and 55)
  bool smooth = false;  // no ripple: the observer sees what the model has wrong, and no more (monitor 54)
  GainSet gains = GainSet::kScenario;
};

template <int N, int P>
model::Vec<P> YtsOf(const LawInput<N, P>& in) noexcept {
  return in.regressor.Y.transpose() * in.s;
}

/// (31) with p_hat.
template <int N, int P>
model::Vec<N> KnownForceOf(const LawInput<N, P>& in, const model::Vec<P>& p_hat) noexcept {
  return control::KnownForceTorque<N>(in.arm.rotor_inertia, in.aux.v_dot, in.regressor.f(p_hat), in.JtF_d,
                                      in.gains.K_d, in.s);
}

/// (36) with p_hat.
template <int N, int P>
model::Vec<N> UnknownForceOf(const LawInput<N, P>& in, const model::Vec<P>& p_hat,
                             const model::Vec<N>& sliding) noexcept {
  return control::UnknownForceTorque<N>(in.arm.rotor_inertia, in.aux.v_dot, in.regressor.f(p_hat),
                                        in.gains.K_d, in.s, sliding);
}

/// The sliding term of (36), with sat for sgn.
template <int N, int P>
model::Vec<N> SlidingOf(const LawInput<N, P>& in, const AdaptiveState<N, P>& x) noexcept {
  return control::SlidingTerm<N>(x.sigma_0, x.sigma_1, in.gains.sliding.scale, in.s,
                                 control::Saturate(in.s, in.gains.sliding.phi));
}

/// What a law's file begins with: no traits, no adaptation.
template <int N, int P>
struct LawBase {
  using In = LawInput<N, P>;
  using State = AdaptiveState<N, P>;
  using V = model::Vec<N>;
  static constexpr LawTraits kTraits{};
  static void AdaptKnown(const In&, State&) noexcept {}
  static void AdaptUnknown(const In&, State&) noexcept {}
};

/// A row of the bank: plain function pointers, so that a cycle does not branch and a law takes the same time every cycle.
template <int N, int P>
struct Law : LawTraits {
  using Torque = model::Vec<N> (*)(const LawInput<N, P>&, const AdaptiveState<N, P>&) noexcept;
  using Adapt = void (*)(const LawInput<N, P>&, AdaptiveState<N, P>&) noexcept;
  Torque known, unknown;
  Adapt adapt_known, adapt_unknown;
};

template <typename L, int N, int P>
constexpr Law<N, P> LawOf(const LawTraits& traits = L::kTraits) noexcept {
  return {traits, L::Known, L::Unknown, L::AdaptKnown, L::AdaptUnknown};
}

}  // namespace reed::strategy
