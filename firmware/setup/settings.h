// A scenario -> what the controller may know of it. RT: set-up only: throws std::runtime_error with one line.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "reed/config/controller/controller_config.h"
#include "reed/core/model/kinematics.h"
#include "reed/core/settings.h"
#include "reed/firmware/setup/arm_model.h"
#include "reed/firmware/setup/contact_checks.h"
#include "reed/firmware/setup/gains.h"
#include "reed/firmware/setup/path_planner.h"

namespace reed {

namespace internal {

inline strategy::LawId LawIdOf(const std::string& name) {
  const auto& names = strategy::kLawNames;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw std::runtime_error("control.law: \"" + name + "\" is no law");
  return static_cast<strategy::LawId>(found - names.begin());
}

inline strategy::ForceModeConfig ForceModeFrom(const ForceConfig& force, const ControlConfig& control) {
  return {{control.k_p, control.k_i, control.a_force},
          force.contact_threshold_N,
          force.approach_speed_mps,
          control.normal_speed_limit_mps,
          control.estimate_wall_stiffness,
          control.force_bandwidth_radps};
}

inline strategy::SourceSetting SourceFrom(ForceConfig::Source source) {
  switch (source) {
    case ForceConfig::Source::kKnown:
      return strategy::SourceSetting::kKnown;
    case ForceConfig::Source::kUnknown:
      return strategy::SourceSetting::kUnknown;
    case ForceConfig::Source::kAuto:
      return strategy::SourceSetting::kAuto;
    case ForceConfig::Source::kNone:
      break;
  }
  return strategy::SourceSetting::kNone;
}

/// How far a commanded torque may move in a cycle, N·m: in proportion to what the joint can do, so that an arm of any
/// size takes over its weight from the brakes within the same few cycles.
template <int N>
model::Vec<N> TorqueStep(const LimitConfig& config, const model::Vec<N>& torque_limit, double T_s) {
  if (config.torque_rate_Nmps > 0.0) return model::Vec<N>::Constant(config.torque_rate_Nmps * T_s);
  return config.torque_rate_scale * T_s * torque_limit;
}

/// What a force sensor that touches nothing may read, N.
inline double ForceNoise(const SensorData& sensors) {
  constexpr double kFrame_N = 0.02;  // of the wrench frame's resolution
  return kFrame_N + sensors.force_noise_N + sensors.force_quantum_N;
}

template <int N, int P>
protect::LimitValues<N> LimitsFrom(const ControllerConfig& scenario, const model::ArmModel<N, P>& arm) {
  protect::LimitValues<N> v;
  v.torque = scenario.limits.torque_scale * arm.torque_limit;
  v.torque_step = TorqueStep<N>(scenario.limits, arm.torque_limit, 1.0 / scenario.timing.rate_hz);
  v.position_min = arm.position_min.array() + scenario.limits.position_margin_rad / 2.0;
  v.position_max = arm.position_max.array() - scenario.limits.position_margin_rad / 2.0;
  v.speed = scenario.limits.speed_scale * arm.speed_limit;
  v.contact_force = scenario.limits.contact_force_N;
  v.hold_age = scenario.limits.hold_age_cycles;
  v.stop_age = scenario.limits.stop_age_cycles;
  return v;
}

template <int N, int P>
protect::MonitorValues<N> MonitorsFrom(const ControllerConfig& scenario, const model::ArmModel<N, P>& arm) {
  constexpr double kFrozenShare = 1.0 / 3.0;
  constexpr double kSteps = 4.0;     // of an encoder: a slow joint stays on one until it comes to the next
  constexpr double kReversal = 2.0;  // Coulomb friction changes by twice itself where a joint turns round
  const LimitConfig& limits = scenario.limits;
  const SensorData& sensors = scenario.sensors;
  const double least_rad = kSteps * std::ldexp(2.0 * std::numbers::pi, -sensors.encoder_bits);
  protect::MonitorValues<N> v;
  v.torque_allowed = limits.torque_error_share * arm.torque_limit;
  v.speed_allowed = limits.speed_error_share * arm.speed_limit;
  v.explained_allowed = limits.unexplained_torque_share * arm.torque_limit;
  const std::vector<double>& coulomb = scenario.arm.coulomb_declared_Nm;
  if (!coulomb.empty()) v.explained_allowed += kReversal * Eigen::Map<const model::Vec<N>>(coulomb.data());
  v.following_allowed = limits.following_error_share * arm.speed_limit;
  v.observer_gain = scenario.control.observer_gain;
  v.stuck_rad = std::max(limits.stuck_rad, least_rad);
  v.frozen_rad = std::max(kFrozenShare * limits.stuck_rad, least_rad);
  v.standstill_rad = limits.standstill_rad;
  v.wrench_noisy = sensors.force_noise_N > 0.0 && sensors.force_noise_N >= 0.5 * sensors.force_quantum_N;
  v.velocity_filter_hz = sensors.velocity_filter_hz;
  v.people = {limits.tip_speed_mps, limits.power_W, limits.energy_J};
  return v;
}

}  // namespace internal

template <int N, int P>
Settings<N, P> SettingsFrom(const ControllerConfig& scenario, bool start_wanted) {
  Settings<N, P> s;
  s.arm = model::ArmModelFrom<N, P>(scenario.arm);
  s.law = internal::LawIdOf(scenario.control.law);
  s.gains = strategy::GainsFrom<N, P>(scenario.control, scenario.arm, s.arm, s.law);
  s.force_mode = internal::ForceModeFrom(scenario.force, scenario.control);
  s.force = {scenario.force.desired_N, scenario.force.start_s, scenario.force.ramp_s, scenario.force.end_s};
  s.source = internal::SourceFrom(scenario.force.source);
  s.normal = scenario.wall.normal;
  s.reach_m = scenario.arm.reach_m();
  s.force_noise_N = internal::ForceNoise(scenario.sensors);
  s.wall_present = scenario.wall.present;
  s.compensate_deflection = scenario.control.nodal_compensation;
  s.velocity_filter_hz = scenario.sensors.velocity_filter_hz;
  s.limits = internal::LimitsFrom(scenario, s.arm);
  s.monitors = internal::MonitorsFrom(scenario, s.arm);
  s.monitored = scenario.limits.monitors;
  constexpr int kAnyAge = 1'000'000;  // without monitors a measurement may be of any age
  if (!s.monitored) s.limits.hold_age = s.limits.stop_age = kAnyAge;
  s.rate_hz = scenario.timing.rate_hz;
  s.duration_s = scenario.duration_s;
  s.start_wanted = start_wanted;
  return s;
}

/// The scenario's legs as knots. Throws std::runtime_error with one line for what the arm cannot follow.
template <int N, int P>
reference::PlannedPath<N> PathFrom(const ControllerConfig& scenario, const model::ArmModel<N, P>& arm) {
  const auto pose_of = [&arm](const model::Vec<N>& q) {
    model::Kinematics<N> kin;
    model::ForwardKinematics<N, P>(arm, q, model::Vec<N>::Zero(), kin);
    return kin;
  };
  reference::PlannedPath<N> path = reference::PathPlanner<N>(pose_of, scenario).Plan();
  reference::RefuseStartBehindWall<N>(pose_of, scenario, path.View());
  reference::RefusePressNearSingularity<N>(pose_of, scenario, path.View());
  return path;
}

}  // namespace reed
