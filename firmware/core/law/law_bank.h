// The laws by name. Each is two torques and two updates, for known and unknown force; chosen once at set-up
// as plain function pointers, so that a cycle does not branch and a law takes the same time every cycle.
//
//   separated        robust: (30)-(34) and (36), (40), (41), Coulomb friction (48)
//   pd, pd_tuned     PD with the paper's gains, with the scenario's gains
//   computed_torque  model inverse with p₀
//   fixed_nominal    separated without adaptation: p̂ = p₀, same gains, same force loop
//   paper_printed    (31)-(34), (36)-(41) as printed, the paper's gains
//   paper_corrected  the same corrected, the paper's gains, no dead-zone, no leak
//
// RT: safe; LawBank::Find is set-up.
#pragma once

#include <array>

#include "reed/core/contact/force_source.h"
#include "reed/core/law/adaptive_state.h"
#include "reed/core/law/computed_torque.h"
#include "reed/core/law/external_law.h"
#include "reed/core/law/law_names.h"
#include "reed/core/law/paper_printed.h"
#include "reed/core/law/pd.h"
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

template <int N, int P>
struct Law {
  using Torque = model::Vec<N> (*)(const LawInput<N, P>&, const AdaptiveState<N, P>&) noexcept;
  using Adapt = void (*)(const LawInput<N, P>&, AdaptiveState<N, P>&) noexcept;
  Torque known, unknown;
  Adapt adapt_known, adapt_unknown;
  bool force_loop;          // the force error enters v (30)
  bool acceleration;        // v, v̇ are θ̇ and ComputedAcceleration: computed torque
  bool deflection_allowed;  // θ_d may be corrected by the static deflection
};

template <int N, int P>
class LawBank {
 public:
  using In = LawInput<N, P>;
  using State = AdaptiveState<N, P>;
  using V = model::Vec<N>;

  /// external: not nullptr for kExternal.
  static const Law<N, P>& Get(LawId id, const ExternalLaw* external = nullptr) noexcept {
    if (id != LawId::kExternal || external == nullptr)
      return kLaws[id == LawId::kExternal ? 0 : static_cast<std::size_t>(id)];
    return kExternalLaws[external->traits & (REED_LAW_FORCE_LOOP | REED_LAW_DEFLECTION)];
  }

 private:
  static V Friction(const In& in, const State& x) noexcept {
    return control::CoulombTorque<N>(x.kappa_hat, in.aux.v, in.gains.friction_speed);  // (48)
  }
  static V Sliding(const In& in, const State& x) noexcept {
    return control::SlidingTerm<N>(x.sigma_0, x.sigma_1, in.gains.sliding.scale, in.s,
                                   control::Saturate(in.s, in.gains.sliding.phi));  // (36)
  }
  static V RobustKnown(const In& in, const State& x) noexcept {
    return control::KnownForceTorque<N>(in.arm.rotor_inertia, in.aux.v_dot, in.regressor.f(x.p_hat), in.JtF_d,
                                        in.gains.K_d, in.s) +
           Sliding(in, x) + Friction(in, x);
  }
  static V RobustUnknown(const In& in, const State& x) noexcept {
    const V sliding = Sliding(in, x);
    return control::UnknownForceTorque<N>(in.arm.rotor_inertia, in.aux.v_dot, in.regressor.f(x.p_hat),
                                          in.gains.K_d, in.s, sliding) +
           Friction(in, x) - in.r;
  }
  static V Pd(const In& in, const State&) noexcept { return control::PdTorque<N>(in.gains.K_d, in.s); }
  static V Computed(const In& in, const State& x) noexcept {
    return control::ComputedTorque<N>(in.arm.rotor_inertia, in.aux.v_dot, in.regressor.f(x.p_hat));
  }
  static V FixedKnown(const In& in, const State& x) noexcept {
    return control::KnownForceTorque<N>(in.arm.rotor_inertia, in.aux.v_dot, in.regressor.f(x.p_hat), in.JtF_d,
                                        in.gains.K_d, in.s);
  }
  static V FixedUnknown(const In& in, const State& x) noexcept {
    return control::UnknownForceTorque<N>(in.arm.rotor_inertia, in.aux.v_dot, in.regressor.f(x.p_hat),
                                          in.gains.K_d, in.s, V::Zero().eval());
  }
  static V PrintedKnown(const In& in, const State& x) noexcept {
    const model::Vec<P> Yts = in.regressor.Y.transpose() * in.s;
    const model::Vec<P> p_hat = control::PrintedParameters<P>(x.eta_hat, Yts);
    return control::KnownForceTorque<N>(in.arm.rotor_inertia, in.aux.v_dot, in.regressor.f(p_hat), in.JtF_d,
                                        in.gains.K_d, in.s);
  }
  static V PrintedUnknown(const In& in, const State& x) noexcept {
    const model::Vec<P> Yts = in.regressor.Y.transpose() * in.s;
    const model::Vec<P> p_hat = control::PrintedParameters<P>(x.eta_hat, Yts);
    return control::PrintedUnknownForceTorque<N>(in.arm.rotor_inertia, in.aux.v_dot, in.regressor.f(p_hat),
                                                 x.sigma_0, x.sigma_1, in.s);
  }
  static V CorrectedUnknown(const In& in, const State& x) noexcept {
    const model::Vec<P> Yts = in.regressor.Y.transpose() * in.s;
    const model::Vec<P> sign_Yts = control::Saturate(Yts, in.gains.sliding.phi);
    const model::Vec<P> p_hat = control::WorstCaseParameters<P>(in.gains.p_0, x.eta_hat, sign_Yts);
    const V sliding = Sliding(in, x);
    return control::UnknownForceTorque<N>(in.arm.rotor_inertia, in.aux.v_dot, in.regressor.f(p_hat),
                                          in.gains.K_d, in.s, sliding);
  }

  static void AdaptRobustKnown(const In& in, State& x) noexcept {
    x.UpdateParameters(in.gains, in.gains.Gamma_known, in.arm, in.regressor.Y, in.s, in.T);
    x.UpdateFriction(in.gains, in.gains.Gamma_c_known, in.aux.v, in.s, in.T);
    x.UpdateSliding(in.gains, in.s, in.T);
  }
  static void AdaptRobustUnknown(const In& in, State& x) noexcept {
    x.UpdateParameters(in.gains, in.gains.Gamma_unknown, in.arm, in.regressor.Y, in.s, in.T);
    x.UpdateFriction(in.gains, in.gains.Gamma_c_unknown, in.aux.v, in.s, in.T);
    x.UpdateSliding(in.gains, in.s, in.T);
  }
  static void AdaptNothing(const In&, State&) noexcept {}
  static void AdaptPrintedKnown(const In& in, State& x) noexcept {
    const model::Vec<P> Yts = in.regressor.Y.transpose() * in.s;
    x.eta_hat = control::PrintedEta<P>(in.gains.Gamma_known, Yts);
  }
  static void AdaptPrintedUnknown(const In& in, State& x) noexcept {
    const model::Vec<P> Yts = in.regressor.Y.transpose() * in.s;
    x.eta_hat += in.T * control::EtaRate<P>(in.gains.Gamma_unknown, Yts);
    x.sigma_0 = control::PrintedSigma<N>(in.gains.sliding.c_0, in.s);
    x.sigma_1 = control::PrintedSigma<N>(in.gains.sliding.c_1, in.s);
  }
  static void AdaptCorrectedKnown(const In& in, State& x) noexcept {
    x.p_hat += in.T * control::KnownForceUpdate<N, P>(in.gains.Gamma_known, in.regressor.Y, in.s);
  }
  static void AdaptCorrectedUnknown(const In& in, State& x) noexcept {
    const model::Vec<P> Yts = in.regressor.Y.transpose() * in.s;
    x.eta_hat += in.T * control::EtaRate<P>(in.gains.Gamma_unknown, Yts);
    x.sigma_0 += in.T * control::Sigma0Rate<N>(in.gains.sliding.c_0, in.s);
    x.sigma_1 += in.T * control::Sigma1Rate<N>(in.gains.sliding.c_1, in.s);
  }

  /// reed/law.h: the same torque whatever is known of the force; what it adapts is its own.
  static V External(const In& in, const State&) noexcept {
    const control::Reference<N>& ref = in.desired;
    const reed_law_input input{
        .joints = N,
        .parameters = in.arm.num_parameters,
        .period_s = in.T,
        .time_s = in.t_s,
        .adapt = in.adapts ? 1 : 0,
        .source = static_cast<std::int32_t>(in.source),
        .theta = in.measured.theta.data(),
        .theta_dot = in.measured.theta_dot.data(),
        .theta_d = ref.theta_d.data(),
        .theta_d_dot = ref.theta_d_dot.data(),
        .theta_d_ddot = ref.theta_d_ddot.data(),
        .v = in.aux.v.data(),
        .v_dot = in.aux.v_dot.data(),
        .s = in.s.data(),
        .Y = in.regressor.Y.data(),
        .f_known = in.regressor.f_known.data(),
        .p_0 = in.gains.p_0.data(),
        .J_m = in.arm.rotor_inertia.data(),
        .Jt_F_d = in.JtF_d.data(),
        .f_n = in.f,
        .r = in.r.data(),
    };
    in.external->step(&input, in.external->state, in.external->output);
    return Eigen::Map<const V>(in.external->output->torque);
  }

  // In the order of LawId: torque known / unknown, update known / unknown, force loop, computed acceleration, static
  // deflection.
  static constexpr std::array<Law<N, P>, 7> kLaws{{
      {RobustKnown, RobustUnknown, AdaptRobustKnown, AdaptRobustUnknown, true, false, true},
      {Pd, Pd, AdaptNothing, AdaptNothing, false, false, false},
      {Pd, Pd, AdaptNothing, AdaptNothing, false, false, false},
      {Computed, Computed, AdaptNothing, AdaptNothing, false, true, false},
      {FixedKnown, FixedUnknown, AdaptNothing, AdaptNothing, true, false, true},
      {PrintedKnown, PrintedUnknown, AdaptPrintedKnown, AdaptPrintedUnknown, false, false, false},
      {FixedKnown, CorrectedUnknown, AdaptCorrectedKnown, AdaptCorrectedUnknown, true, false, false},
  }};
  // By the traits of reed/law.h.
  static constexpr std::array<Law<N, P>, 4> kExternalLaws{{
      {External, External, AdaptNothing, AdaptNothing, false, false, false},
      {External, External, AdaptNothing, AdaptNothing, true, false, false},
      {External, External, AdaptNothing, AdaptNothing, false, false, true},
      {External, External, AdaptNothing, AdaptNothing, true, false, true},
  }};
};

}  // namespace reed::strategy
