// The parts of one control step, each on its own, all on the same inputs: what bench/budget.toml budgets.
// Set-up, then any of them.
#pragma once

#include "reed/bench/inputs.h"
#include "reed/core/contact/force_loop.h"
#include "reed/core/estimate/observer.h"
#include "reed/core/law/law_bank.h"
#include "reed/core/model/static_deflection.h"
#include "reed/firmware/setup/settings.h"

namespace reed::bench {

template <int N, int P>
class Stages {
 public:
  explicit Stages(const ControllerConfig& scenario)
      : arm_(model::ArmModelFrom<N, P>(scenario.arm)),
        gains_(strategy::GainsFrom<N, P>(scenario.control, scenario.arm, arm_, strategy::LawId::kSeparated)),
        law_(strategy::LawBank<N, P>::Get(strategy::LawId::kSeparated)),
        adaptive_(gains_),
        observer_(gains_.K_o, kPeriod),
        bodies_(model::BodiesFor<N, P>(arm_, gains_.p_0)) {
    for (int k = 0; k < kInputs; ++k) {
      State state;
      model::ForwardKinematics<N, P>(arm_, in_[k].q, in_[k].qd, state.kin);
      model::ComputeRegressor<N, P>(arm_, state.kin, in_[k].v, in_[k].v_dot, state.regressor);
      states_.push_back(state);
    }
    observer_.Reset(model::Vec<N>::Zero());
  }

  void Kinematics(int k) noexcept {
    model::ForwardKinematics<N, P>(arm_, in_[k].q, in_[k].qd, kin_);
    Keep(kin_);
  }

  /// (22), with the weights of the current estimate.
  void StaticDeflection(int k) noexcept {
    const model::Bodies<N> bodies = model::BodiesFor<N, P>(arm_, adaptive_.p_hat);
    model::Wrench press;
    press.F = {0.0, 0.0, 10.0};
    Keep(model::CompensateDeflection<N, P>(arm_, state(k).kin, bodies, press));
  }

  /// With the kinematics it needs, as the other side's.
  void Regressor(int k) noexcept {
    Kinematics(k);
    model::ComputeRegressor<N, P>(arm_, kin_, in_[k].v, in_[k].v_dot, regressor_);
    Keep(regressor_);
  }

  /// (23)-(41): error surface, normal direction, force loop, torque, adaptation.
  void Law(int k) noexcept {
    const Input<N>& in = in_[k];
    const control::Reference<N> wanted{in.q + 1e-3 * in.v, in.v, in.v_dot};
    control::Auxiliary<N> aux = control::Surface<N>(wanted, gains_.Lambda, in.q, in.qd);
    const control::NormalDirection<N> normal =
        control::PureNormalTranslation<N>(state(k).kin.J, Eigen::Vector3d::UnitZ());
    control::ReplaceNormal<N>(normal, 1e-3, 0.0, aux);
    const model::Vec<N> s = control::SlidingError<N>(aux.v, in.qd), JtF_d = 10.0 * normal.J_n.transpose(),
                        none = model::Vec<N>::Zero();
    const strategy::LawInput<N, P> input{gains_,
                                         arm_,
                                         aux,
                                         s,
                                         state(k).regressor,
                                         JtF_d,
                                         none,
                                         kPeriod,
                                         0.0,
                                         wanted,
                                         10.0,
                                         measured_,
                                         strategy::ForceSource::kKnown,
                                         true,
                                         nullptr};
    Keep(law_.known(input, adaptive_));
    law_.adapt_known(input, adaptive_);
  }

  /// (47), with the momentum it compares.
  void Observer(int k) noexcept {
    const model::MomentumModel<N> m = model::GeneralisedMomentum<N>(bodies_, state(k).kin, arm_.gravity);
    const model::Vec<N> momentum = m.momentum + arm_.rotor_inertia.cwiseProduct(in_[k].qd);
    Keep(observer_.Update(momentum, in_[k].v + m.free_rate));
  }

 private:
  static constexpr double kPeriod = 1e-3;
  struct State {
    model::Kinematics<N> kin;
    model::Regressor<N, P> regressor;
  };
  const State& state(int k) const noexcept { return states_[static_cast<std::size_t>(k % kInputs)]; }

  Inputs<N> in_;
  model::ArmModel<N, P> arm_;
  strategy::Gains<N, P> gains_;
  const strategy::Law<N, P>& law_;
  strategy::AdaptiveState<N, P> adaptive_;
  control::MomentumObserver<N> observer_;
  model::Bodies<N> bodies_;
  std::vector<State> states_;
  model::Kinematics<N> kin_;
  model::Regressor<N, P> regressor_;
  Measurement<N> measured_;
};

}  // namespace reed::bench
