#include "reed/config/schema/rules.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "reed/config/schema/allowed.h"
#include "reed/config/schema/bound.h"
#include "reed/config/schema/plausibility.h"
#include "reed/config/schema/rule_context.h"
#include "reed/config/schema/text_limits.h"
#include "reed/law_names/law_names.h"

namespace reed {
namespace {

class Rules : public RuleContext {
 public:
  using RuleContext::RuleContext;

  void SizesOfPlant() const {
    PerJoint("reference.start_rad", s_.reference.start_rad, true);
    PerParameter("control.p_initial", s_.control.p_initial);
    PerParameter("plant.p_true", s_.plant.p_true);
  }

  void SizesOfLaw() const {
    PerJoint("control.K_d", s_.control.K_d, true);
    PerJoint("control.Lambda", s_.control.Lambda, true);
    for (std::size_t i = 0; i < s_.reference.legs.size(); ++i) {
      const ReferenceLeg& leg = s_.reference.legs[i];
      const std::string key = "reference.legs[" + std::to_string(i) + "].";
      if (leg.duration_s <= 0.0) Fail(key + "duration_s", "missing; s");
      if (leg.kind == ReferenceLeg::Kind::kJoint) PerJoint(key + "to_rad", leg.to_rad, true);
      if (leg.kind == ReferenceLeg::Kind::kSine) PerJoint(key + "amplitude_rad", leg.amplitude_rad, true);
      for (std::size_t k = 0; k < leg.sine_rad.size(); ++k)
        PerJoint(key + "sine_rad[" + std::to_string(k) + "]", leg.sine_rad[k], true);
      for (std::size_t k = 0; k < leg.cosine_rad.size(); ++k)
        PerJoint(key + "cosine_rad[" + std::to_string(k) + "]", leg.cosine_rad[k], true);
    }
  }

  /// A run needs what a drawing of the arm does not: motors, limits, stiffness.
  void ArmIsComplete() const {
    if (s_.arm.dof() < 2)
      Fail(s_.arm.IsOfDhRows() ? "arm.dh" : "arm.joint",
           "a run needs 2 ... " + std::to_string(kMaxJoints) + " joints");
    Present("arm.rotor_inertia_reflected", s_.arm.rotor_inertia_kgm2);
    Present("arm.joint_stiffness", s_.arm.joint_stiffness_Nmprad);
    Present("arm.torque_limit", s_.arm.torque_limit_Nm);
    Present("arm.position_min", s_.arm.position_min_rad);
    Present("arm.speed_limit", s_.arm.speed_limit_radps);
  }

  void StartInsideLimits() const {
    for (std::size_t i = 0; i < s_.reference.start_rad.size(); ++i) {
      const double lo = s_.arm.position_min_rad[i] + s_.limits.position_margin_rad;
      const double hi = s_.arm.position_max_rad[i] - s_.limits.position_margin_rad;
      const double start = s_.reference.start_rad[i];
      if (start < lo || start > hi)
        Fail("reference.start_rad", "joint " + std::to_string(i + 1) + ": " + ToText(start) +
                                        " rad is beyond its limit; allowed: " + ToShortText(lo) + " ... " +
                                        ToShortText(hi) + " rad");
    }
  }

  void BoxHoldsStartAndTruth() const {
    InBox("control.p_initial", "start", s_.control.p_initial);
    InBox("plant.p_true", "truth", s_.plant.p_true);
  }

  void NamesAreShort() const {
    NameIsShort("scenario.name", s_.name);
    NameIsShort("arm.name", s_.arm.name);
  }

  void LawIsKnown() const {
    const std::vector<std::string> laws(strategy::kLawNames.begin(), strategy::kLawNames.end());
    if (std::find(laws.begin(), laws.end(), s_.control.law) != laws.end()) return;
    Fail("control.law", "'" + s_.control.law + "' is unknown; " + Allowed(s_.control.law, laws));
  }

  /// A reading that saturates below the limit would never exceed it.
  void ForceLimitIsMeasured() const {
    const double bias = s_.sensors.force_bias_N.cwiseAbs().maxCoeff();
    const double weight = s_.arm.force_sensor.tool_mass_kg * s_.arm.gravity_mps2.norm();
    const double left = s_.sensors.force_range_N - bias - weight;
    if (s_.limits.contact_force_N >= left)
      Fail("limits.contact_force_N",
           std::string("rule contact_force_N < sensors.force_range_N - largest |sensors.force_bias_N|") +
               (weight > 0.0 ? " - weight of the tool behind the sensor" : "") + ": " +
               ToText(s_.limits.contact_force_N) + " is not below " + ToShortText(left) +
               " N, where the reading saturates");
  }

  /// The contact force acts at the tool point, away from the sensor.
  void ForceLimitsMomentIsMeasured() const {
    if (!s_.sensors.wrench) return;
    const ForceSensor& sensor = s_.arm.force_sensor;
    const double bias = s_.sensors.moment_bias_Nm.cwiseAbs().maxCoeff();
    const double lever_m = (s_.arm.tool.xyz_m - sensor.xyz_m).norm();
    const double weight_Nm = sensor.tool_mass_kg * s_.arm.gravity_mps2.norm() * sensor.tool_com_m.norm();
    const double moment_Nm = lever_m * s_.limits.contact_force_N + weight_Nm + bias;
    if (moment_Nm >= s_.sensors.moment_range_Nm)
      Fail("sensors.moment_range_Nm",
           "rule contact_force_N · distance from the force sensor to the tool point + moment of the tool's "
           "weight + "
           "largest |moment_bias_Nm| < moment_range_Nm: " +
               ToShortText(moment_Nm) + " is not below " + ToText(s_.sensors.moment_range_Nm) +
               " N·m, where the reading saturates");
  }

  void AgesAreGraded() const {
    if (s_.limits.hold_age_cycles >= s_.limits.stop_age_cycles)
      Fail("limits.hold_age_cycles",
           "rule hold_age_cycles < stop_age_cycles: " + std::to_string(s_.limits.hold_age_cycles) +
               " is not below " + std::to_string(s_.limits.stop_age_cycles));
  }

  /// s = 0 of the force loop is stable iff k_i < a k_p (30).
  void ForceLoopIsStable() const {
    if (s_.force.source == ForceConfig::Source::kNone || s_.control.k_i == 0.0) return;
    if (s_.control.k_i >= s_.control.a_force * s_.control.k_p)
      Fail("control.k_i", "rule k_i < a_force k_p: " + ToText(s_.control.k_i) + " is not below " +
                              ToShortText(s_.control.a_force * s_.control.k_p) + " m/(s²·N)");
  }

  /// One sample of delay: the slope of the sliding term, whose bounds belong to a joint with K_d = 10, stays below
  /// 0.6 J_m/T, or it chatters. The loop without it: CheckPlausibleLaw.
  void NoChatter() const {
    constexpr double kLimit = 0.6;
    for (std::size_t i = 0; i < s_.control.K_d.size(); ++i) {
      const double scale = s_.control.K_d[i] / 10.0;
      const double damping =
          s_.control.K_d[i] + scale * (s_.control.sigma0_max + s_.control.sigma1_max / s_.control.phi);
      const double bound = kLimit * s_.arm.rotor_inertia_kgm2[i] * s_.timing.rate_hz;
      if (damping > bound)
        Fail("control.K_d", Joint(i) + "rule K_d (1 + (sigma0_max + sigma1_max/phi) / 10) <= 0.6 J_m rate: " +
                                ToShortText(damping) + " is above " + ToShortText(bound) + " N·m·s/rad");
    }
  }

  /// One mark of the encoder in one period reads as a speed, and K_d makes a torque of it. Beyond a share of
  /// the limit that torque is what moves the arm, and slow motions such as the search for a wall get lost.
  void SpeedIsResolved() const {
    constexpr double kShare = 0.1, kTwoPi = 6.283185307179586;
    const double passed = -std::expm1(-kTwoPi * s_.sensors.velocity_filter_hz / s_.timing.rate_hz);
    const double step = passed * kTwoPi * std::ldexp(s_.timing.rate_hz, -s_.sensors.encoder_bits);
    for (std::size_t i = 0; i < s_.control.K_d.size(); ++i) {
      const double torque = s_.control.K_d[i] * step, bound = kShare * s_.arm.torque_limit_Nm[i];
      if (torque > bound)
        Fail("sensors.encoder_bits",
             "joint " + std::to_string(i + 1) +
                 ": rule K_d times the velocity of one mark <= 0.1 torque_limit: " + ToShortText(step) +
                 " rad/s make " + ToShortText(torque) + " N·m, above " + ToShortText(bound) + " N·m");
    }
  }

  void WallIsMeaningful() const {
    if (Pressing() && !s_.wall.present) Fail("wall.present", "a desired force needs a wall");
  }

  void WallIsWithinReach() const {
    if (s_.wall.present && s_.wall.normal.norm() < 1e-3) Fail("wall.normal", "has no direction");
    const double reach = s_.arm.reach_m();
    const Eigen::Vector3d from_base = s_.wall.point_m - s_.arm.base.xyz_m;
    const double distance = std::abs(from_base.dot(s_.wall.normal.normalized()));
    if (s_.wall.present && distance > reach)
      Fail("wall.point_m",
           "the wall is " + ToShortText(distance) + " m away, the arm reaches " + ToShortText(reach) + " m");
  }

  /// Laws that track a measured force need something that measures it.
  void ForceIsMeasured() const {
    using Source = ForceConfig::Source;
    const bool needed = s_.force.source == Source::kKnown || s_.force.source == Source::kAuto;
    if (needed && !s_.sensors.wrench)
      Fail("force.source",
           "known and auto need a force sensor, and sensors.wrench = false; allowed: none, unknown");
  }

  void BudgetsAddUp() const {
    const double sum = s_.timing.rx_budget_us + s_.timing.compute_budget_us + s_.timing.tx_budget_us;
    const double period = 1e6 / s_.timing.rate_hz;
    if (sum > period * (1.0 + 1e-9))
      Fail("timing.rx_budget_us", "rx + compute + tx budgets are " + ToShortText(sum) +
                                      " µs, the period is " + ToShortText(period) + " µs");
  }

 private:
  void NameIsShort(const std::string& key, const std::string& name) const {
    if (name.size() > kLongestName) Fail(key, "longer than " + std::to_string(kLongestName) + " bytes");
  }
  void PerJoint(const std::string& key, const std::vector<double>& list, bool needed) const {
    if (list.empty() && needed) Fail(key, "missing; one number per joint");
    if (!list.empty() && list.size() != s_.arm.joints.size())
      Fail(key, std::to_string(list.size()) + " numbers for " + std::to_string(s_.arm.dof()) + " joints");
  }
  void PerParameter(const std::string& key, const std::vector<double>& list) const {
    if (!list.empty() && list.size() != s_.arm.parameters.size())
      Fail(key, std::to_string(list.size()) + " numbers for " + std::to_string(s_.arm.parameters.size()) +
                    " parameters");
  }
  void InBox(const std::string& key, const char* what, const std::vector<double>& list) const {
    for (std::size_t k = 0; k < list.size(); ++k) {
      const StructuralParameter& p = s_.arm.parameters[k];
      if (list[k] < p.lo || list[k] > p.hi)
        Fail(key, p.name + ": " + what + " " + ToText(list[k]) + " lies outside the box " + ToText(p.lo) +
                      " ... " + ToText(p.hi));
    }
  }
  void Present(const std::string& key, const std::vector<double>& list) const {
    if (list.empty()) Fail(key, "missing; a run needs one number per joint");
  }
};

}  // namespace

void CheckRules(const Document& doc, const Scenario& scenario, bool has_law) {
  const Rules rules(doc, scenario);
  rules.NamesAreShort();
  rules.ArmIsComplete();
  rules.SizesOfPlant();
  rules.StartInsideLimits();
  rules.BoxHoldsStartAndTruth();
  rules.WallIsWithinReach();
  CheckPlausiblePlant(doc, scenario);
  if (!has_law) return;
  rules.SizesOfLaw();
  rules.LawIsKnown();
  rules.ForceLimitIsMeasured();
  rules.ForceLimitsMomentIsMeasured();
  rules.AgesAreGraded();
  rules.ForceLoopIsStable();
  rules.NoChatter();
  rules.SpeedIsResolved();
  rules.WallIsMeaningful();
  rules.ForceIsMeasured();
  rules.BudgetsAddUp();
  CheckPlausibleLaw(doc, scenario);
}

}  // namespace reed
