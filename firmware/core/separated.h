// The separated strategy (Fig. 7): which law is in charge, and everything it needs, once per cycle.
//
//   force known    → adaptive force tracking, (30)-(34)
//   force unknown  → adaptive sliding mode, (36)-(41)
//
// RT: safe. Constructor: set-up.
#pragma once

#include <cmath>
#include <numbers>

#include "reed/core/contact/force_loop.h"
#include "reed/core/contact/force_mode.h"
#include "reed/core/contact/normal_force.h"
#include "reed/core/estimate/collision.h"
#include "reed/core/estimate/force_estimate.h"
#include "reed/core/estimate/observer.h"
#include "reed/core/law/law_bank.h"
#include "reed/core/measurement.h"
#include "reed/core/model/dynamics.h"
#include "reed/core/model/nodal_compensation.h"
#include "reed/core/model/regressor.h"
#include "reed/core/reference/joint_path.h"
#include "reed/core/reference/nodal_reference.h"

namespace reed::strategy {

/// kReduced leaves out what can wait a cycle: learning and a new nodal displacement.
enum class Effort : std::uint8_t { kFull, kReduced };

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
  double f = 0.0;       // normal force as known, N: tared sensor or observer
  Collision collision;  // joint -1: none in this cycle
};

template <int N, int P>
class Separated {
 public:
  Separated(const ControllerConfig& scenario, const model::ArmModel<N, P>& arm, reference::JointPath<N> path)
      : arm_(arm),
        gains_(scenario, arm),
        law_(LawBank<N, P>::Find(scenario.control.law)),
        path_(std::move(path)),
        normal_(scenario.wall.normal),
        wall_present_(scenario.wall.present),
        compensate_(scenario.control.nodal_compensation && law_.nodal_allowed),
        T_(1.0 / scenario.timing.rate_hz),
        source_(scenario.force.source),
        force_({{scenario.control.k_p, scenario.control.k_i, scenario.control.a_force},
                scenario.force.contact_threshold_N,
                scenario.force.approach_speed_mps,
                scenario.control.normal_speed_limit_mps,
                scenario.control.estimate_wall_stiffness,
                scenario.control.force_bandwidth_radps},
               reference::ForceProfile(scenario.force), T_),
        normal_force_(normal_, T_),
        nodal_(T_),
        adaptive_(gains_),
        observer_(scenario.control.observer_gain, T_),
        collision_(kCollisionShare * arm.torque_limit, T_),
        nominal_(model::BodiesFor<N, P>(arm, gains_.p_0)),
        nominal_viscous_(model::ViscousFriction<N, P>(arm, gains_.p_0)),
        rate_share_(-std::expm1(-2.0 * std::numbers::pi * scenario.sensors.velocity_filter_hz * T_)),
        kappa_rate_(RateOf(path_)) {}

  /// One cycle. t_s since the arm became active; learn: false while the brakes hold the arm (nothing to learn
  /// from).
  const Decision<N>& Step(const Measurement<N>& measured, double t_s, bool learn,
                          Effort effort = Effort::kFull) noexcept {
    Decision<N>& d = decision_;
    model::ForwardKinematics<N, P>(arm_, measured.theta, measured.theta_dot, kin_);

    Observe(measured);
    d.plan = path_.At(t_s);
    d.tip_plan = PlannedTip(d.plan);
    d.source = Source(measured, t_s, learn);
    d.f = normal_force_.Step(d.source, measured.force, control::EstimateTipForce<N>(kin_.J, observer_.r()),
                             force_.in_contact());
    const double pace = d.source == ForceSource::kObserver ? kObserverPace : 1.0;
    pace_ += T_ / kPaceTime_s * (pace - pace_);  // a change of source is no step of the gain
    d.force = learn && d.source != ForceSource::kNone
                  ? force_.Step(t_s, d.f, normal_.dot(kin_.tip), pace_, d.source == ForceSource::kKnown)
                  : ForceDemand{};
    d.desired = learn ? nodal_.Step(d.plan, NodalOffset(d.force.f_d, effort)) : d.plan;  // (22)
    Aim(d, measured);

    model::ComputeRegressor<N, P>(arm_, kin_, d.aux.v, d.aux.v_dot, regressor_);
    const model::Vec<N> JtF_d = d.normal.J_n.transpose() * d.force.f_d;
    const LawInput<N, P> in{gains_, arm_, d.aux, d.s, regressor_, JtF_d, Subtracted(d), T_};
    const bool known = d.source == ForceSource::kKnown || d.source == ForceSource::kObserver;
    d.tau_law = known ? law_.known(in, adaptive_) : law_.unknown(in, adaptive_);
    if (learn && effort == Effort::kFull)
      known ? law_.learn_known(in, adaptive_) : law_.learn_unknown(in, adaptive_);
    d.collision = learn && !d.force.active ? collision_.Step(observer_.r()) : Collision{};
    return d;
  }

  /// Instead of Step(), after a cycle that came too late: what the last one decided.
  const Decision<N>& Repeat() noexcept {
    decision_.force.latched_now = false;
    decision_.collision = {};
    gap_ = true;
    return decision_;
  }

  /// To be told before Step() that the last one is more than a period ago.
  void NoteGap() noexcept { gap_ = true; }

  /// While the arm stands still and free: the force sensor's zero, the observer's start, nothing learnt.
  void Settle(const Measurement<N>& measured) noexcept {
    normal_force_.Settle(measured.force, measured.wrench_age <= kUsableWrenchAge);
    force_.Reset();
    nodal_.Reset();
    const model::MomentumModel<N> m = Momentum(measured);
    observer_.Reset(m.momentum);
    rate_.setZero();
    collision_.Reset(observer_.r());
  }
  bool settled() const noexcept { return normal_force_.settled(); }

  const AdaptiveState<N, P>& adaptive() const noexcept { return adaptive_; }
  const model::Vec<N>& observed() const noexcept { return observer_.r(); }
  const control::ForceState& force_state() const noexcept { return force_.state(); }
  double wall_stiffness() const noexcept { return force_.wall_stiffness(); }  // k̂_e (51), N/m
  const Eigen::Vector3d& normal() const noexcept { return normal_; }

 private:
  /// A machine that always answers a cycle late still has a sensor: a standing arm's reading does not age in
  /// that time.
  static constexpr int kUsableWrenchAge = 2;

  ForceSource Source(const Measurement<N>& measured, double t_s, bool learn) noexcept {
    const ForceSource source = source_.Step(measured.wrench_age, learn && force_.Wanted(t_s));
    if (source_.returning() && measured.wrench_age == 0)
      normal_force_.Retare(measured.force, source_.fresh_in_row(), !force_.in_contact());
    return source;
  }

  Eigen::Vector3d PlannedTip(const control::Reference<N>& plan) noexcept {
    model::ForwardKinematics<N, P>(arm_, plan.theta_d, plan.theta_d_dot, plan_kin_);
    return plan_kin_.tip;
  }

  /// θ_d − θ_plan: nodal displacement (22), from current estimates. In contact p̂ also explains what the wall
  /// does, so the weight is that of the last free estimate.
  const model::Vec<N>& NodalOffset(double f_d, Effort effort) noexcept {
    if (!compensate_ || effort == Effort::kReduced) return offset_;
    if (!force_.in_contact()) p_free_ = adaptive_.p_hat;
    const model::Bodies<N> bodies = model::BodiesFor<N, P>(arm_, p_free_);
    model::Wrench press;
    press.F = f_d * normal_;
    offset_ = model::CompensateNodes<N, P>(arm_, plan_kin_, bodies, press).offset;
    return offset_;
  }

  /// v, v̇, s: where the law shall take the arm from here (22)-(25), (30).
  void Aim(Decision<N>& d, const Measurement<N>& measured) noexcept {
    d.aux = control::Surface<N>(d.desired, gains_.Lambda, measured.theta, measured.theta_dot);
    if (wall_present_) d.normal = control::PureNormalTranslation<N>(kin_.J, normal_);
    if (d.force.active && law_.force_loop)
      control::ReplaceNormal<N>(d.normal, d.force.z, d.force.z_dot, d.aux);
    d.s = control::SlidingError<N>(d.aux.v, measured.theta_dot);
    if (!law_.acceleration) return;
    d.aux.v = measured.theta_dot;
    d.aux.v_dot =
        control::ComputedAcceleration<N>(d.desired, kappa_rate_, gains_.Lambda, d.aux.e, measured.theta_dot);
  }

  /// r where it may be subtracted: free motion. An arm that presses would cancel its own force.
  model::Vec<N> Subtracted(const Decision<N>& d) const noexcept {
    const bool free = gains_.subtract_observer && d.source == ForceSource::kUnknown;
    return free ? observer_.r() : model::Vec<N>(model::Vec<N>::Zero());
  }

  /// κ = K_d / (M̂ + J_m)_ii at the start of the path; set-up only.
  model::Vec<N> RateOf(const reference::JointPath<N>& path) {
    model::ForwardKinematics<N, P>(arm_, path.At(0.0).theta_d, model::Vec<N>::Zero(), kin_);
    const model::Mat<N, N> M = model::MassMatrix<N>(nominal_, kin_);
    return gains_.K_d.cwiseQuotient(M.diagonal() + arm_.rotor_inertia);
  }

  model::MomentumModel<N> Momentum(const Measurement<N>& measured) noexcept {
    model::ForwardKinematics<N, P>(arm_, measured.theta, measured.theta_dot, kin_);
    model::MomentumModel<N> m = model::GeneralisedMomentum<N>(nominal_, kin_, arm_.gravity);
    m.momentum += arm_.rotor_inertia.cwiseProduct(measured.theta_dot);
    return m;
  }

  void Observe(const Measurement<N>& measured) noexcept {
    model::MomentumModel<N> m = model::GeneralisedMomentum<N>(nominal_, kin_, arm_.gravity);
    m.momentum += arm_.rotor_inertia.cwiseProduct(measured.theta_dot);
    const model::Vec<N> friction =
        nominal_viscous_.cwiseProduct(measured.theta_dot) +
        control::CoulombTorque<N>(adaptive_.kappa_hat, measured.theta_dot, gains_.friction_speed);
    // The measured speed is filtered in the drive, so the known rate goes through the same filter: else every
    // change of the own torque would look like a force from outside.
    rate_ += rate_share_ * (measured.torque + m.free_rate - friction - rate_);
    if (gap_)
      observer_.Skip(m.momentum);
    else
      observer_.Update(m.momentum, rate_);  // (47)
    gap_ = false;
  }

  static constexpr double kObserverPace = 0.3;  // of the force loop while r, 1/K_o late, is all it has
  static constexpr double kPaceTime_s = 0.1;
  static constexpr double kCollisionShare = 0.15;  // of the torque limit

  const model::ArmModel<N, P>& arm_;
  Gains<N, P> gains_;
  const Law<N, P>& law_;
  reference::JointPath<N> path_;
  Eigen::Vector3d normal_;
  bool wall_present_;
  bool compensate_;
  double T_;
  SourceSelector source_;
  ForceMode force_;
  NormalForce normal_force_;
  NodalReference<N> nodal_;
  AdaptiveState<N, P> adaptive_;
  control::MomentumObserver<N> observer_;
  CollisionDetector<N> collision_;
  double pace_ = 1.0;
  model::Bodies<N> nominal_;
  model::Vec<N> nominal_viscous_;
  double rate_share_;                           // of the drives' velocity filter, per cycle
  model::Vec<N> rate_ = model::Vec<N>::Zero();  // known part of the momentum's rate, filtered, N·m
  bool gap_ = false;                            // between the last observation and the next

  model::Kinematics<N> kin_, plan_kin_;
  model::Regressor<N, P> regressor_;
  Decision<N> decision_;
  model::Vec<N> offset_ = model::Vec<N>::Zero();
  model::Vec<P> p_free_ = model::Vec<P>::Zero();  // p̂ when last free
  model::Vec<N> kappa_rate_;                      // κ of computed torque, 1/s
};

}  // namespace reed::strategy
