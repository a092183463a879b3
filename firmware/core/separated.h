// The separated strategy (Fig. 7): which law acts, and everything it needs, once per cycle.
//
//   force known    → adaptive force tracking, (30)-(34)
//   force unknown  → adaptive sliding mode, (36)-(41)
//
// RT: safe. Constructor: set-up.
#pragma once

#include "reed/core/contact/normal_force.h"
#include "reed/core/decision.h"
#include "reed/core/estimate/disturbance.h"
#include "reed/core/estimate/force_estimate.h"
#include "reed/core/law/law_bank.h"
#include "reed/core/reference/deflection_compensation.h"
#include "reed/core/reference/joint_path.h"
#include "reed/core/settings.h"

namespace reed::strategy {

/// kReduced leaves out adaptation and a new static deflection for a cycle.
enum class Workload : std::uint8_t { kFull, kReduced };

template <int N, int P>
class Separated {
 public:
  /// settings outlives this object. external: the law from outside where settings.law is kExternal.
  Separated(const Settings<N, P>& settings, reference::JointPath<N> path,
            const ExternalLaw* external) noexcept
      : arm_(settings.arm),
        gains_(settings.gains),
        law_(LawBank<N, P>::Get(settings.law, external)),
        external_(external),
        path_(path),
        normal_(settings.normal),
        wall_present_(settings.wall_present),
        T_(settings.period_s()),
        source_(settings.source),
        force_(settings.force_mode, settings.force, T_),
        stretch_(settings.limits.speed, settings.reach_m),
        normal_force_(normal_, wall_present_ ? settings.force_mode.threshold_N : kNoWall_N, T_),
        deflection_(arm_, normal_, settings.compensate_deflection && law_.deflection_allowed, T_),
        adaptive_(gains_),
        disturbance_(arm_, gains_.p_0, gains_.K_o, settings.velocity_filter_hz, T_),
        collision_(kCollisionShare * arm_.torque_limit, T_),
        kappa_rate_(RateOf(path_)) {}

  /// One cycle. t_s since the arm became active; active: false while the brakes hold the arm (nothing to adapt to, no
  /// force to seek).
  const Decision<N>& Step(const Measurement<N>& measured, double t_s, bool active,
                          Workload workload = Workload::kFull) noexcept {
    const bool full = workload == Workload::kFull;
    Decision<N>& d = decision_;
    d.plan = path_.At(t_s);
    model::ForwardKinematics<N, P>(arm_, measured.theta, measured.theta_dot, kin_, d.plan.theta_d, planned_);
    d.tip_plan = planned_.tip;
    sensor_.Turn(arm_, kin_);

    disturbance_.Update(measured, kin_, adaptive_.kappa_hat, gains_.friction_speed);
    if (wall_present_) d.normal = control::PureNormalTranslation<N>(kin_.J, normal_);
    d.source = Source(measured, t_s, active);
    d.f = normal_force_.Step(d.source, sensor_.Read(measured.force, normal_),
                             control::EstimateTipForce<N>(kin_.J, disturbance_.r()), force_.in_contact(),
                             kin_.J.template topRows<3>() * measured.theta_dot);
    d.felt = measured.wrench_age < Measurement<N>::kNever
                 ? sensor_.AtTool(normal_force_.Felt(Sensed(measured)))
                 : model::Wrench{};
    ScaleBandwidth(d.source);
    d.force = active && d.source != ForceSource::kNone ? SeekForce(d, t_s) : ForceDemand{};
    d.desired = active ? deflection_.Step(d.plan, planned_, adaptive_.p_hat, d.force.f_d, force_.in_contact(),
                                          full)  // (22)
                       : d.plan;
    Aim(d, measured);

    model::ComputeRegressor<N, P>(arm_, kin_, d.aux.v, d.aux.v_dot, regressor_);
    const model::Vec<N> JtF_d = d.normal.J_n.transpose() * d.force.f_d;
    const model::Vec<N> r = Subtracted(d);
    const LawInput<N, P> in{gains_, arm_,      d.aux, d.s,      regressor_, JtF_d,          r,        T_,
                            t_s,    d.desired, d.f,   measured, d.source,   active && full, external_};
    const bool known = d.source == ForceSource::kKnown || d.source == ForceSource::kObserver;
    d.tau_law = known ? law_.known(in, adaptive_) : law_.unknown(in, adaptive_);
    if (in.adapts) known ? law_.adapt_known(in, adaptive_) : law_.adapt_unknown(in, adaptive_);
    d.collision = active && !d.force.active ? collision_.Step(disturbance_.r()) : Collision{};
    return d;
  }

  /// Instead of Step(), after a cycle that came too late: what the last one decided.
  const Decision<N>& Repeat() noexcept {
    decision_.force.latched_now = decision_.force.held_now = false;
    decision_.collision = {};
    disturbance_.NoteGap();
    return decision_;
  }

  /// To be called before Step() when the last one is more than a period ago.
  void NoteGap() noexcept { disturbance_.NoteGap(); }

  /// While the arm is still and free: the force sensor's zero, the observer's start, no adaptation.
  void Tare(const Measurement<N>& measured) noexcept {
    model::ForwardKinematics<N, P>(arm_, measured.theta, measured.theta_dot, kin_);
    sensor_.Turn(arm_, kin_);
    normal_force_.Tare(Sensed(measured),
                       measured.wrench_age <= kUsableWrenchAge && !measured.wrench_saturated);
    force_.Reset();
    deflection_.Reset();
    disturbance_.Reset(kin_, measured.theta_dot);
    collision_.Reset(disturbance_.r());
  }
  double ForceZeroOffset() const noexcept { return normal_force_.ZeroOffset(); }  // N
  bool tared() const noexcept { return normal_force_.tared(); }

  /// The force on the wall, N, for the limit: the tared sensor; without it the observer, while the arm presses.
  double ContactForce(const Measurement<N>& measured, bool sensed) const noexcept {
    if (sensed) return normal_force_.Felt(Sensed(measured)).F.norm();
    return decision_.source == ForceSource::kObserver ? std::abs(decision_.f) : 0.0;
  }

  const AdaptiveState<N, P>& adaptive() const noexcept { return adaptive_; }
  const LawTraits& law() const noexcept { return law_; }
  /// J at the measured angles; rows 0 to 2: of the tool point.
  const model::Mat<6, N>& jacobian() const noexcept { return kin_.J; }
  const model::Vec<N>& observed() const noexcept { return disturbance_.r(); }
  double kinetic_energy() const noexcept { return disturbance_.kinetic_energy(); }  // J
  const control::ForceState& force_state() const noexcept { return force_.state(); }
  double wall_stiffness() const noexcept { return force_.wall_stiffness(); }  // k̂_e (51), N/m
  const Eigen::Vector3d& normal() const noexcept { return normal_; }

 private:
  /// A wrench that always comes a cycle late is usable here: the reading of an arm at rest is the same a cycle later.
  static constexpr int kUsableWrenchAge = 2;

  /// The last reading without the tool's weight in the last pose.
  model::Wrench Sensed(const Measurement<N>& measured) const noexcept {
    return sensor_.WithoutWeight({measured.force, measured.moment});
  }

  ForceSource Source(const Measurement<N>& measured, double t_s, bool active) noexcept {
    const ForceSource source = source_.Step(measured.wrench_age, active && force_.Wanted(t_s));
    if (source_.returning() && measured.wrench_age == 0)
      normal_force_.Retare(Sensed(measured), source_.fresh_in_row(), !force_.in_contact());
    return source;
  }

  /// bandwidth_scale changes smoothly: a change of source makes no step of the gain.
  void ScaleBandwidth(ForceSource source) noexcept {
    const double scale = source == ForceSource::kObserver ? kObserverScale : 1.0;
    bandwidth_scale_ += T_ / kScaleTime_s * (scale - bandwidth_scale_);
  }

  ForceDemand SeekForce(const Decision<N>& d, double t_s) noexcept {
    NormalMotion motion{normal_.dot(kin_.tip), d.normal.J_n.dot(d.aux.e), {}};  // e: of the last cycle
    if (wall_present_ && law_.force_loop) motion.allowed = stretch_.Step(d.normal.D, force_.state().z);
    const bool sensed = d.source == ForceSource::kKnown || normal_force_.met_wall();
    return force_.Step(t_s, d.f, motion, bandwidth_scale_, sensed);
  }

  /// v, v̇, s: the reference of the law (22)-(25), (30).
  void Aim(Decision<N>& d, const Measurement<N>& measured) noexcept {
    d.aux = control::Surface<N>(d.desired, gains_.Lambda, measured.theta, measured.theta_dot);
    if (d.force.active && law_.force_loop)
      control::ReplaceNormal<N>(d.normal, d.force.z, d.force.z_dot, d.aux);
    d.s = control::SlidingError<N>(d.aux.v, measured.theta_dot);
    if (!law_.acceleration) return;
    d.aux.v = measured.theta_dot;
    d.aux.v_dot =
        control::ComputedAcceleration<N>(d.desired, kappa_rate_, gains_.Lambda, d.aux.e, measured.theta_dot);
  }

  /// r where it may be subtracted: free motion. While the arm presses this would cancel the desired force.
  model::Vec<N> Subtracted(const Decision<N>& d) const noexcept {
    const bool free = gains_.subtract_observer && d.source == ForceSource::kUnknown;
    return free ? disturbance_.r() : model::Vec<N>(model::Vec<N>::Zero());
  }

  /// κ = K_d / (M̂ + J_m)_ii at the start of the path; set-up only.
  model::Vec<N> RateOf(const reference::JointPath<N>& path) {
    model::ForwardKinematics<N, P>(arm_, path.At(0.0).theta_d, model::Vec<N>::Zero(), kin_);
    const model::Mat<N, N> M = model::MassMatrix<N>(disturbance_.nominal(), kin_);
    return gains_.K_d.cwiseQuotient(M.diagonal() + arm_.rotor_inertia);
  }

  static constexpr double kObserverScale = 0.3;  // of the force loop while it uses r, which is 1/K_o late
  static constexpr double kScaleTime_s = 0.1;
  static constexpr double kNoWall_N = 1e12;
  static constexpr double kCollisionShare = 0.15;  // of the torque limit

  const model::ArmModel<N, P>& arm_;
  const Gains<N, P>& gains_;
  const Law<N, P>& law_;
  const ExternalLaw* external_;
  reference::JointPath<N> path_;
  Eigen::Vector3d normal_;
  bool wall_present_;
  double T_;
  SourceSelector source_;
  ForceMode force_;
  StretchGuard<N> stretch_;
  MountedSensor sensor_;
  NormalForce normal_force_;
  DeflectionCompensation<N, P> deflection_;
  AdaptiveState<N, P> adaptive_;
  DisturbanceEstimate<N, P> disturbance_;
  CollisionDetector<N> collision_;
  double bandwidth_scale_ = 1.0;

  model::Kinematics<N> kin_;
  model::LinkPoses<N> planned_;
  model::Regressor<N, P> regressor_;
  Decision<N> decision_;
  model::Vec<N> kappa_rate_;  // κ of computed torque, 1/s
};

}  // namespace reed::strategy
