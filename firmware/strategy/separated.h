// The separated strategy (Fig. 7): which law is in charge, and everything it needs, once per cycle.
//
//   force known    → adaptive force tracking, (30)-(34)
//   force unknown  → adaptive sliding mode, (36)-(41)
//
// RT: safe. Constructor: set-up.
#pragma once

#include "firmware/arm_bus/measurement.h"
#include "firmware/control/force_loop.h"
#include "firmware/control/observer.h"
#include "firmware/model/dynamics.h"
#include "firmware/model/nodal_compensation.h"
#include "firmware/model/regressor.h"
#include "firmware/reference/joint_path.h"
#include "firmware/strategy/adaptive_state.h"
#include "firmware/strategy/force_mode.h"
#include "firmware/strategy/force_tare.h"

namespace reed::strategy {

enum class ForceSource : std::int8_t { kNone = 0, kKnown = 1, kUnknown = 2, kObserver = 3 };

/// Everything one cycle decided, for the limits and for telemetry.
template <int N>
struct Decision {
  control::Reference<N> plan;     // before force loop and nodal compensation
  control::Reference<N> desired;  // after nodal displacement (22)
  control::Auxiliary<N> aux;
  control::NormalDirection<N> normal;
  ForceDemand force;
  ForceSource source = ForceSource::kNone;
  model::Vec<N> s = model::Vec<N>::Zero();
  model::Vec<N> tau_law = model::Vec<N>::Zero();
  Eigen::Vector3d tip_plan = Eigen::Vector3d::Zero();
  double f = 0.0;  // measured normal force, tared
};

template <int N, int P>
class Separated {
 public:
  Separated(const Scenario& scenario, const model::ArmModel<N, P>& arm, reference::JointPath<N> path)
      : arm_(arm),
        gains_(scenario.control, arm),
        path_(std::move(path)),
        normal_(scenario.wall.normal),
        wall_present_(scenario.wall.present),
        source_config_(scenario.force.source),
        compensate_(scenario.control.nodal_compensation),
        T_(1.0 / scenario.timing.rate_hz),
        force_({{scenario.control.k_p, scenario.control.k_i, scenario.control.a_force},
                scenario.force.contact_threshold_N,
                scenario.force.approach_speed_mps,
                scenario.control.normal_speed_limit_mps},
               reference::ForceProfile(scenario.force)),
        adaptive_(gains_.p_0),
        observer_(scenario.control.observer_gain, T_),
        subtract_observer_(scenario.control.observer),
        nominal_(model::BodiesFor<N, P>(arm, gains_.p_0)),
        nominal_viscous_(model::ViscousFriction<N, P>(arm, gains_.p_0)) {}

  /// One cycle. t_s since the arm became active; learn: false while the brakes hold the arm (nothing to learn
  /// from). tau_before: torque that acted since the last cycle.
  const Decision<N>& Step(const Measurement<N>& measured, double t_s, bool learn,
                          const model::Vec<N>& tau_before) noexcept {
    Decision<N>& d = decision_;
    model::ForwardKinematics<N, P>(arm_, measured.theta, measured.theta_dot, kin_);

    d.plan = path_.At(t_s);
    d.tip_plan = PlannedTip(d.plan);
    d.source = Source(measured);
    d.f = normal_.dot(tare_.Apply(measured.force));

    d.force = learn && d.source != ForceSource::kNone ? force_.Step(t_s, d.f, T_) : ForceDemand{};
    d.desired = Compensate(d.plan, d.force.f_d);
    d.aux = control::Surface<N>(d.desired, gains_.Lambda, measured.theta, measured.theta_dot);
    if (wall_present_) d.normal = control::PureNormalTranslation<N>(kin_.J, normal_);
    if (d.force.active) control::ReplaceNormal<N>(d.normal, d.force.z, d.force.z_dot, d.aux);
    d.s = control::SlidingError<N>(d.aux.v, measured.theta_dot);

    model::ComputeRegressor<N, P>(arm_, kin_, d.aux.v, d.aux.v_dot, regressor_);
    Observe(measured, tau_before);
    d.tau_law = Torque(d);
    if (learn) Learn(d);
    return d;
  }

  /// While the arm stands still and free: the force sensor's zero, the observer's start, nothing learnt.
  void Settle(const Measurement<N>& measured) noexcept {
    if (measured.wrench_age == 0) tare_.Take(measured.force);
    force_.Reset();
    observer_.Reset(Momentum(measured).momentum);
  }
  bool settled() const noexcept { return tare_.complete(); }

  const AdaptiveState<N, P>& adaptive() const noexcept { return adaptive_; }
  const model::Vec<N>& observed() const noexcept { return observer_.r(); }
  const control::ForceState& force_state() const noexcept { return force_.state(); }
  const Eigen::Vector3d& normal() const noexcept { return normal_; }

 private:
  ForceSource Source(const Measurement<N>& measured) const noexcept {
    using Source = ForceConfig::Source;
    switch (source_config_) {
      case Source::kNone:
        return ForceSource::kNone;
      case Source::kKnown:
        return ForceSource::kKnown;
      case Source::kUnknown:
        return ForceSource::kUnknown;
      case Source::kAuto:
        return measured.wrench_age <= kLossCycles ? ForceSource::kKnown : ForceSource::kUnknown;
    }
    return ForceSource::kNone;
  }

  Eigen::Vector3d PlannedTip(const control::Reference<N>& plan) noexcept {
    model::ForwardKinematics<N, P>(arm_, plan.theta_d, plan.theta_d_dot, plan_kin_);
    return plan_kin_.tip;
  }

  /// θ_d after nodal displacement (22), from current estimates.
  control::Reference<N> Compensate(const control::Reference<N>& plan, double f_d) noexcept {
    if (!compensate_) return plan;
    const model::Bodies<N> bodies = model::BodiesFor<N, P>(arm_, adaptive_.p_hat);
    model::Wrench press;
    press.F = f_d * normal_;
    control::Reference<N> desired = plan;
    desired.theta_d += model::CompensateNodes<N, P>(arm_, plan_kin_, bodies, press).offset;  // (22)
    return desired;
  }

  model::Vec<N> Torque(const Decision<N>& d) noexcept {
    const model::Vec<N> f_hat = regressor_.f(adaptive_.p_hat);  // (28)
    const model::Vec<N> sliding =
        control::SlidingTerm<N>(adaptive_.sigma_0, adaptive_.sigma_1, gains_.sliding.scale, d.s,
                                control::Saturate(d.s, gains_.sliding.phi));  // (36)
    if (d.source == ForceSource::kKnown) {
      const model::Vec<N> JtF_d = d.normal.J_n.transpose() * d.force.f_d;
      return control::KnownForceTorque<N>(arm_.rotor_inertia, d.aux.v_dot, f_hat, JtF_d, gains_.K_d, d.s) +
             sliding;  // (31)
    }
    model::Vec<N> tau =
        control::UnknownForceTorque<N>(arm_.rotor_inertia, d.aux.v_dot, f_hat, gains_.K_d, d.s, sliding);
    if (subtract_observer_) tau -= observer_.r();
    return tau;
  }

  void Learn(const Decision<N>& d) noexcept {
    const bool known = d.source == ForceSource::kKnown;
    adaptive_.UpdateParameters(gains_, known ? gains_.Gamma_known : gains_.Gamma_unknown, arm_, regressor_.Y,
                               d.s, T_);
    adaptive_.UpdateSliding(gains_, d.s, T_);
  }

  model::MomentumModel<N> Momentum(const Measurement<N>& measured) noexcept {
    model::ForwardKinematics<N, P>(arm_, measured.theta, measured.theta_dot, kin_);
    model::MomentumModel<N> m = model::GeneralisedMomentum<N>(nominal_, kin_, arm_.gravity);
    m.momentum += arm_.rotor_inertia.cwiseProduct(measured.theta_dot);
    return m;
  }

  void Observe(const Measurement<N>& measured, const model::Vec<N>& tau_before) noexcept {
    model::MomentumModel<N> m = model::GeneralisedMomentum<N>(nominal_, kin_, arm_.gravity);
    m.momentum += arm_.rotor_inertia.cwiseProduct(measured.theta_dot);
    observer_.Update(m.momentum,
                     tau_before + m.free_rate - nominal_viscous_.cwiseProduct(measured.theta_dot));  // (47)
  }

  static constexpr int kLossCycles = 3;

  const model::ArmModel<N, P>& arm_;
  Gains<N, P> gains_;
  reference::JointPath<N> path_;
  Eigen::Vector3d normal_;
  bool wall_present_;
  ForceConfig::Source source_config_;
  bool compensate_;
  double T_;
  ForceMode force_;
  ForceTare tare_;
  AdaptiveState<N, P> adaptive_;
  control::MomentumObserver<N> observer_;
  bool subtract_observer_;
  model::Bodies<N> nominal_;
  model::Vec<N> nominal_viscous_;

  model::Kinematics<N> kin_, plan_kin_;
  model::Regressor<N, P> regressor_;
  Decision<N> decision_;
};

}  // namespace reed::strategy
