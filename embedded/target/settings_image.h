// Every number of a controller's settings in one order, as plain doubles: written on the host, read back by a target
// that has neither files nor heap. One list of fields for both ways.
#pragma once

#include <type_traits>

#include "reed/core/settings.h"

namespace reed::embedded {

inline constexpr int N = 5, P = 7;  // the arm a5, as the firmware's loop has it

/// Calls each(double&) for every number of the settings.
template <typename Each>
class Visitor {
 public:
  explicit Visitor(Each each) : each_(each) {}

  void operator()(double& value) { each_(value); }

  /// Whole numbers, flags and names of choices travel as doubles.
  template <typename T>
  requires(std::is_integral_v<T> || std::is_enum_v<T>) void operator()(T& value) {
    double number = static_cast<double>(value);
    each_(number);
    value = static_cast<T>(static_cast<int>(number));
  }

  template <typename Derived>
  void operator()(Eigen::PlainObjectBase<Derived>& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) each_(values.data()[i]);
  }

  template <typename... Values>
  void All(Values&... values) {
    ((*this)(values), ...);
  }

 private:
  Each each_;
};

template <typename Each>
void Visit(Visitor<Each>& visit, model::ArmModel<N, P>& arm) {
  for (int i = 0; i < N; ++i) visit.All(arm.mount_R[i], arm.mount_p[i]);
  visit.All(arm.d, arm.gravity, arm.tool_offset, arm.tool_rotation, arm.sensor_rotation, arm.sensor_to_tool,
            arm.sensor_tool_mass, arm.sensor_tool_com);
  for (int i = 0; i <= N; ++i) visit(arm.first_shape[i]);
  for (int j = 0; j < arm.first_shape[N]; ++j) {
    model::UnitShape& shape = arm.shape[j];
    visit.All(shape.k, shape.unit.m, shape.unit.h, shape.unit.J);
  }
  visit.All(arm.viscous, arm.p_nominal, arm.p_lo, arm.p_hi, arm.num_parameters);
  visit.All(arm.rotor_inertia, arm.joint_stiffness, arm.joint_hardening, arm.torque_limit, arm.position_min,
            arm.position_max, arm.speed_limit, arm.num_members);
  for (int j = 0; j < arm.num_members; ++j) {
    model::Member& m = arm.member[j];
    visit.All(m.link, m.start, m.end, m.t, m.y, m.z, m.length, m.EA, m.EI_y, m.EI_z, m.GJ, m.rhoA, m.softer,
              m.start_at_origin, m.end_at_origin, m.start_along, m.tt);
  }
  for (int i = 0; i < N; ++i) visit(arm.carrier[i]);
}

template <typename Each>
void Visit(Visitor<Each>& visit, strategy::Gains<N, P>& g) {
  visit.All(g.K_d, g.Lambda, g.Gamma_known, g.Gamma_unknown, g.p_0, g.eta_0);
  visit.All(g.sliding.c_0, g.sliding.c_1, g.sliding.phi, g.sliding.scale);
  visit.All(g.sigma0_max, g.sigma1_max, g.dead_zone, g.leak_p, g.leak_sigma, g.K_o);
  visit.All(g.Gamma_c_known, g.Gamma_c_unknown, g.kappa_0, g.kappa_max, g.friction_speed,
            g.subtract_observer);
}

template <typename Each>
void Visit(Visitor<Each>& visit, strategy::ForceModeConfig& f) {
  visit.All(f.gains.k_p, f.gains.k_i, f.gains.a, f.threshold_N, f.approach_speed_mps, f.speed_limit_mps,
            f.schedule, f.bandwidth_radps, f.approach_time_s, f.least_k_p, f.most_k_p);
}

template <typename Each>
void Visit(Visitor<Each>& visit, protect::LimitValues<N>& v) {
  visit.All(v.torque, v.torque_step, v.position_min, v.position_max, v.speed, v.contact_force, v.hold_age,
            v.stop_age);
}

template <typename Each>
void Visit(Visitor<Each>& visit, protect::MonitorValues<N>& v) {
  visit.All(v.torque_allowed, v.speed_allowed, v.explained_allowed, v.following_allowed, v.observer_gain,
            v.stuck_rad, v.frozen_rad, v.standstill_rad, v.wrench_noisy, v.velocity_filter_hz,
            v.people.tip_speed, v.people.power, v.people.energy);
}

template <typename Each>
void VisitSettings(Each each, Settings<N, P>& s) {
  Visitor<Each> visit(each);
  Visit(visit, s.arm);
  Visit(visit, s.gains);
  visit(s.law);
  Visit(visit, s.force_mode);
  visit.All(s.force.desired_N, s.force.start_s, s.force.ramp_s, s.force.end_s);
  visit.All(s.source, s.normal, s.reach_m, s.force_noise_N, s.wall_present, s.compensate_deflection,
            s.velocity_filter_hz);
  Visit(visit, s.limits);
  Visit(visit, s.monitors);
  visit.All(s.monitored, s.rate_hz, s.duration_s, s.start_wanted);
}

}  // namespace reed::embedded
