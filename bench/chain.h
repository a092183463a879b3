// An arm of any length for the growth with the number of joints: links of 0.1 m, every second axis turned by
// a right angle, one unknown mass per link. And what it shall do: swing about its start, pressing. Set-up
// only.
#pragma once

#include <numbers>
#include <string>

#include "reed/config/schema/halves.h"

namespace reed::bench {

inline ArmDescription Chain(int joints) {
  constexpr double kLength = 0.1, kMass = 0.3, kInertia = kMass * kLength * kLength / 12.0;
  const auto n = static_cast<std::size_t>(joints);
  ArmDescription arm;
  arm.name = "chain" + std::to_string(joints);
  for (std::size_t i = 0; i < n; ++i) {
    const double twist = i % 2 == 0 ? 0.5 * std::numbers::pi : -0.5 * std::numbers::pi;
    arm.joints.push_back(JointOf({i == 0 ? 0.0 : twist, i == 0 ? 0.0 : kLength, 0.0}));
    InertialBody body;
    body.mass_kg = kMass;
    body.com_m = {0.5 * kLength, 0.0, 0.0};
    body.inertia_com_kgm2.diagonal() << 0.1 * kInertia, kInertia, kInertia;
    arm.bodies.push_back(body);
    StructuralParameter mass{"m" + std::to_string(i + 1), kMass, 0.8 * kMass, 0.0, 2.0 * kMass, {}, {}};
    InertialBody unit = body;
    unit.mass_kg = 1.0;
    unit.inertia_com_kgm2 /= kMass;
    mass.shapes.push_back({static_cast<int>(i), unit});
    arm.parameters.push_back(mass);
    if (i + 1 < n) arm.sections.push_back({kLength, 1e7, 1e3, 1e3, 1.0});
  }
  arm.tool.xyz_m = {kLength, 0.0, 0.0};
  arm.rotor_inertia_kgm2.assign(n, 0.1);
  arm.joint_stiffness_Nmprad.assign(n, 8e3);
  arm.joint_hardening_Nmprad3.assign(n, 0.0);
  arm.coulomb_Nm.assign(n, 0.1);
  arm.torque_limit_Nm.assign(n, 100.0);
  arm.position_min_rad.assign(n, -2.9);
  arm.position_max_rad.assign(n, 2.9);
  arm.speed_limit_radps.assign(n, 10.0);
  return arm;
}

inline Scenario Swing(int joints) {
  const auto n = static_cast<std::size_t>(joints);
  Scenario scenario;
  scenario.name = "swing";
  scenario.arm = Chain(joints);
  scenario.duration_s = 3.0;
  scenario.reference.start_rad.assign(n, 0.3);
  ReferenceLeg leg;
  leg.kind = ReferenceLeg::Kind::kSine;
  leg.duration_s = 3.0;
  leg.frequency_hz = 0.5;
  leg.amplitude_rad.assign(n, 0.1);
  scenario.reference.legs.push_back(leg);
  scenario.wall.present = true;
  scenario.force.source = ForceConfig::Source::kKnown;
  scenario.force.desired_N = 10.0;
  scenario.control.K_d.assign(n, 10.0);
  scenario.control.Lambda.assign(n, 10.0);
  return scenario;
}

}  // namespace reed::bench
