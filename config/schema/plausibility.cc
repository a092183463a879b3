#include "reed/config/schema/plausibility.h"

#include <algorithm>
#include <cmath>

#include "reed/config/controller/fourier_leg.h"
#include "reed/config/schema/bound.h"
#include "reed/config/schema/known_mass.h"
#include "reed/config/schema/rigid_pose.h"
#include "reed/config/schema/rule_context.h"
#include "reed/config/schema/true_parameters.h"
#include "reed_layout.h"

namespace reed {
namespace {

using Eigen::Vector3d;

class PlantRules : public RuleContext {
 public:
  using RuleContext::RuleContext;

  void LossEndsAfterItsStart() const {
    const SensorConfig& c = s_.sensors;
    if (c.wrench_lost_to_s < 0.0) return;
    if (c.wrench_lost_from_s < 0.0)
      Fail("sensors.wrench_lost_to_s", "does nothing without sensors.wrench_lost_from_s");
    if (c.wrench_lost_to_s <= c.wrench_lost_from_s)
      Fail("sensors.wrench_lost_to_s", ToText(c.wrench_lost_to_s) + " s is not after wrench_lost_from_s = " +
                                           ToText(c.wrench_lost_from_s) +
                                           " s; allowed: later, or -1 for never");
  }

  void DisturbanceDoesSomething() const {
    const DisturbanceConfig& c = s_.disturbance;
    if (!c.amplitude_N.isZero(0.0) && c.frequencies_hz.empty())
      Fail("disturbance.amplitude_N", "does nothing without disturbance.frequencies_hz");
    if (c.amplitude_N.isZero(0.0) && !c.frequencies_hz.empty())
      Fail("disturbance.frequencies_hz", "do nothing without disturbance.amplitude_N");
    if (!c.step_N.isZero(0.0) && c.step_s < 0.0)
      Fail("disturbance.step_N", "does nothing without disturbance.step_s");
  }

  void LinkDoesSomething() const {
    const LinkConfig& c = s_.link;
    if (c.wire_time) return;
    if (c.foreign_load > 0.0) Fail("link.foreign_load", "does nothing without link.wire_time");
    if (c.foreign_id >= 0) Fail("link.foreign_id", "does nothing without link.wire_time");
  }

  void ExcitationDoesSomething() const {
    const DriveConfig& c = s_.drives;
    const bool joint = c.excitation_joint > 0, torque = c.excitation_Nm > 0.0,
               lines = !c.excitation_hz.empty();
    if (joint != torque || joint != lines)
      Fail("drives.excitation_joint",
           "excitation_joint, excitation_Nm and excitation_hz do nothing without each other");
    if (c.excitation_joint > s_.arm.dof())
      Fail("drives.excitation_joint",
           ToText(c.excitation_joint) + ": the arm has " + ToText(s_.arm.dof()) + " joints");
    for (const double f : c.excitation_hz)
      if (f >= 0.5 * s_.timing.rate_hz)
        Fail("drives.excitation_hz", ToShortText(f) + " Hz is not below half of timing.rate_hz");
  }

  /// With the true bodies: what the motors have to hold.
  void ArmHoldsItself() const {
    const RigidPose pose = PoseOf(s_.arm, s_.reference.start_rad);
    const std::vector<double> torque = HoldingTorque(s_.arm, s_.arm.bodies, pose);
    for (std::size_t i = 0; i < torque.size(); ++i) {
      const double limit = s_.limits.torque_scale * s_.arm.torque_limit_Nm[i];
      if (std::abs(torque[i]) > limit)
        Fail("reference.start_rad", Joint(i) + "to hold the arm there takes " +
                                        ToShortText(std::abs(torque[i])) + " N·m, its limit is " +
                                        ToShortText(limit) + " N·m (masses are in kg)");
    }
  }
};

class LawRules : public RuleContext {
 public:
  using RuleContext::RuleContext;

  /// A frame clamps what it cannot carry: such a torque never comes, such a limit never trips.
  void BusCarriesTheLimits() const {
    for (std::size_t i = 0; i < s_.arm.joints.size(); ++i) {
      NotAbove("arm.torque_limit", i, s_.limits.torque_scale * s_.arm.torque_limit_Nm[i],
               bus::layout::kCommandTorque[i].max, "N·m", "a command carries");
      NotAbove("arm.speed_limit", i, s_.limits.speed_scale * s_.arm.speed_limit_radps[i],
               bus::layout::kJointStateVelocity.max, "rad/s", "a joint's frame carries");
    }
  }

  /// The controller knows the data sheet of an arm and never its true friction.
  void KnownFrictionIsDeclared() const {
    if (s_.control.coulomb_known > 0.0 && s_.arm.coulomb_declared_Nm.empty() &&
        s_.arm.coulomb_nominal_Nm.empty())
      Fail("control.coulomb_known",
           ToText(s_.control.coulomb_known) +
               " of no friction: the arm declares none; give arm.coulomb_declared or arm.coulomb_nominal");
  }

  void ForceIsBelowItsLimit() const {
    if (Pressing() && s_.force.desired_N >= s_.limits.contact_force_N)
      Fail("force.desired_N", ToText(s_.force.desired_N) + " N is not below limits.contact_force_N = " +
                                  ToText(s_.limits.contact_force_N) + " N, where the arm stops");
    if (Pressing() && s_.force.end_s <= s_.force.start_s)
      Fail("force.end_s",
           ToText(s_.force.end_s) + " s is not after force.start_s = " + ToText(s_.force.start_s) + " s");
  }

  void SwingsHaveAFrequency() const {
    using Kind = ReferenceLeg::Kind;
    for (std::size_t i = 0; i < s_.reference.legs.size(); ++i) {
      const ReferenceLeg& leg = s_.reference.legs[i];
      const bool swings = leg.kind == Kind::kSlide || leg.kind == Kind::kSine || leg.kind == Kind::kFourier;
      if (swings && leg.frequency_hz == 0.0)
        Fail("reference.legs[" + std::to_string(i) + "].frequency_hz",
             "missing; a slide, sine or fourier without it stands still");
    }
  }

  /// A series has no fade: its periods begin at rest, and it ends where one begins.
  void FourierLegsRestAtTheirEnds() const {
    constexpr double kRest_radps = 1e-3, kRest_radps2 = 0.05, kPeriods = 1e-6;
    for (std::size_t i = 0; i < s_.reference.legs.size(); ++i) {
      const ReferenceLeg& leg = s_.reference.legs[i];
      if (leg.kind != ReferenceLeg::Kind::kFourier) continue;
      const std::string key = "reference.legs[" + std::to_string(i) + "].";
      if (leg.sine_rad.empty() && leg.cosine_rad.empty())
        Fail(key + "kind", "a fourier leg needs sine_rad or cosine_rad");
      for (std::size_t j = 0; j < s_.arm.joints.size(); ++j) {
        const FourierStart start = StartOf(leg, j);
        if (std::abs(start.speed_radps) > kRest_radps)
          Fail(key + "sine_rad", Joint(j) + "the series starts at " + ToShortText(start.speed_radps) +
                                     " rad/s; allowed: 0, so the sum of k times its k-th row is 0");
        if (std::abs(start.acceleration_radps2) > kRest_radps2)
          Fail(key + "cosine_rad", Joint(j) + "the series starts with " +
                                       ToShortText(start.acceleration_radps2) +
                                       " rad/s²; allowed: 0, so the sum of k² times its k-th row is 0");
      }
      const double periods = leg.duration_s * leg.frequency_hz;
      if (std::abs(periods - std::round(periods)) > kPeriods)
        Fail(key + "duration_s", ToText(leg.duration_s) + " s are " + ToShortText(periods) +
                                     " periods of a fourier leg; allowed: whole ones, of " +
                                     ToShortText(1.0 / leg.frequency_hz) + " s");
    }
  }

  /// In no pose does a motor move the tool point along it: a planar arm and a wall beside its plane.
  void NormalCanBeFelt() const {
    constexpr double kNothing_m = 1e-9;
    if (!Pressing()) return;
    double most = 0.0;
    for (int k = 0; k < 3; ++k) {
      std::vector<double> q = s_.reference.start_rad;
      for (std::size_t i = 0; i < q.size(); ++i) q[i] += 0.37 * k * static_cast<double>(i + 1);
      most =
          std::max(most, (s_.wall.normal.transpose() * TipJacobian(PoseOf(s_.arm, q))).cwiseAbs().maxCoeff());
    }
    if (most < kNothing_m) Fail("wall.normal", "no joint of this arm moves the tool point along it");
  }

  /// The believed wall is met in the time there is: by the reference, or by seeking from where it comes nearest.
  void WallIsMet() const {
    if (!Pressing()) return;
    const double seeking_s = std::min(s_.duration_s, s_.force.end_s) - s_.force.start_s;
    if (seeking_s <= s_.force.ramp_s) return;  // too short a run to press in, whatever the wall
    const double sought_m = s_.force.approach_speed_mps * std::max(0.0, seeking_s);
    const double nearest_m = NearestToWall();
    if (nearest_m > sought_m)
      Fail("wall.point_m", "the wall is never met: the reference ends " + ToShortText(nearest_m) +
                               " m before it, seeking from force.start_s at force.approach_speed_mps makes " +
                               ToShortText(sought_m) + " m");
  }

  /// Wherever in their box the parameters are.
  void LoopsHaveMargin() const {
    LoopsHave(kNeededMargin, LoopsOf(s_, Load::kStart), "");
    LoopsHave(kHeaviestMargin, LoopsOf(s_, Load::kHeaviest), " with the parameters at p_hi");
  }

 private:
  void LoopsHave(const LoopMargin& needed, const std::vector<JointLoop>& loops,
                 const std::string& load) const {
    for (std::size_t i = 0; i < loops.size(); ++i) {
      const LoopMargin margin = MarginOf(loops[i]);
      if (Enough(margin, needed)) continue;
      const double K_d = LargestKd(loops[i], needed);
      Fail("control.K_d",
           Joint(i) + ToText(loops[i].K_d) + load + " leaves a gain margin of " + ToShortText(margin.gain) +
               " and a phase margin of " + ToShortText(margin.phase_deg) + "°; allowed: at least " +
               ToText(needed.gain) + " and " + ToText(needed.phase_deg) + "°, " +
               (K_d > 0.0 ? "so up to " + ToShortText(K_d) + " N·m·s/rad at this rate and Lambda"
                          : "which no K_d has at this rate and Lambda"));
    }
  }

  void NotAbove(const char* key, std::size_t i, double value, double most, const char* unit,
                const char* what) const {
    if (value >= most)
      Fail(key, Joint(i) + ToText(value) + " " + unit + " is not below the " + ToText(most) + " " + unit +
                    " that " + what);
  }

  double Distance(const Vector3d& tip) const {
    return s_.wall.normal.normalized().dot(tip - s_.wall.point_m);
  }

  /// Over every leg's samples; the plan itself is made later, by the controller.
  double NearestToWall() const {
    using Kind = ReferenceLeg::Kind;
    constexpr int kSamples = 20, kFourierSamples = 200;
    std::vector<double> q = s_.reference.start_rad;
    Vector3d tip = PoseOf(s_.arm, q).tip;
    double nearest = Distance(tip);
    const auto pass = [&](const Vector3d& at) { nearest = std::min(nearest, Distance(at)); };
    for (const ReferenceLeg& leg : s_.reference.legs) {
      if (leg.kind == Kind::kCartesian) {
        tip += leg.by_m;
        pass(tip);
        if (std::vector<double> there = AnglesFor(s_.arm, tip, q, 0.0); !there.empty()) q = there;
      } else if (leg.kind == Kind::kSlide) {
        pass(tip + leg.amplitude_m);
        pass(tip - leg.amplitude_m);
      } else if (leg.kind == Kind::kFourier) {
        const std::vector<double> from = q;
        for (int k = 0; k < kFourierSamples; ++k) {
          for (std::size_t i = 0; i < q.size(); ++i)
            q[i] = from[i] + FourierOffset(leg, i, k / (kFourierSamples * leg.frequency_hz));
          pass(PoseOf(s_.arm, q).tip);
        }
        q = from;
      } else if (leg.kind == Kind::kJoint || leg.kind == Kind::kSine) {
        const bool swings = leg.kind == Kind::kSine;
        const std::vector<double> from = q;
        for (int k = swings ? -kSamples : 0; k <= kSamples; ++k) {
          const double share = static_cast<double>(k) / kSamples;
          for (std::size_t i = 0; i < q.size(); ++i)
            q[i] = from[i] + share * (swings ? leg.amplitude_rad[i] : leg.to_rad[i] - from[i]);
          pass(PoseOf(s_.arm, q).tip);
        }
        if (swings) q = from;
        tip = PoseOf(s_.arm, q).tip;
      }
    }
    return nearest;
  }
};

}  // namespace

std::vector<JointLoop> LoopsOf(const Scenario& s, Load load) {
  const std::string& law = s.control.law;
  if (law == "pd" || law.starts_with("paper_")) return {};
  ArmDescription nominal = s.arm;
  std::vector<double> p;
  for (const StructuralParameter& parameter : s.arm.parameters)
    p.push_back(load == Load::kHeaviest ? parameter.hi : parameter.nominal);
  if (load == Load::kStart && !s.control.p_initial.empty()) p = s.control.p_initial;
  SetTrueParameters(nominal, p);
  const std::vector<double> inertia =
      InertiaAboutJoints(nominal.bodies, PoseOf(nominal, s.reference.start_rad));
  std::vector<JointLoop> loops;
  for (std::size_t i = 0; i < inertia.size(); ++i)
    loops.push_back({inertia[i], s.arm.rotor_inertia_kgm2[i], s.arm.joint_stiffness_Nmprad[i],
                     s.control.K_d[i], s.control.Lambda[i], law != "pd_tuned", 1.0 / s.timing.rate_hz,
                     s.sensors.velocity_filter_hz});
  return loops;
}

void CheckPlausiblePlant(const Document& doc, const Scenario& scenario) {
  const PlantRules rules(doc, scenario);
  rules.LossEndsAfterItsStart();
  rules.DisturbanceDoesSomething();
  rules.LinkDoesSomething();
  rules.ExcitationDoesSomething();
}

void CheckPlausibleLaw(const Document& doc, const Scenario& scenario) {
  const LawRules rules(doc, scenario);
  rules.BusCarriesTheLimits();
  PlantRules(doc, scenario).ArmHoldsItself();
  rules.KnownFrictionIsDeclared();
  rules.ForceIsBelowItsLimit();
  rules.SwingsHaveAFrequency();
  rules.FourierLegsRestAtTheirEnds();
  rules.NormalCanBeFelt();
  rules.WallIsMet();
  rules.LoopsHaveMargin();
}

}  // namespace reed
