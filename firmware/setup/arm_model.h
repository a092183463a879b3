// The arm's description -> the constants of the recursions. Set-up only: throws std::invalid_argument.
#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "reed/config/controller/nominal_arm.h"
#include "reed/config/description/members.h"
#include "reed/core/model/arm_model.h"
#include "reed/math/sine.h"

namespace reed::model {

namespace internal {

/// Per-joint list of the description as a vector; `absent` where the file did not say.
template <int N>
Vec<N> PerJoint(const std::vector<double>& list, double absent, const char* name) {
  if (list.empty()) return Vec<N>::Constant(absent);
  if (static_cast<int>(list.size()) != N) {
    throw std::invalid_argument(std::string(name) + ": " + std::to_string(list.size()) + " entries for " +
                                std::to_string(N) + " joints");
  }
  return Eigen::Map<const Vec<N>>(list.data());
}

inline MassMoments Moments(const InertialBody& body) {
  return MassMoments(body.mass_kg, body.com_m, body.inertia_com_kgm2);
}

inline MassMoments Moments(const KnownMass& mass) {
  MassMoments moments;
  moments.m = mass.mass_kg;
  moments.h = mass.first_kgm;
  moments.J = mass.second_kgm2;
  return moments;
}

template <int N, int P>
void ReadParameters(const NominalArm& arm, ArmModel<N, P>& out) {
  out.num_parameters = arm.num_parameters();
  if (out.num_parameters > P) {
    throw std::invalid_argument(arm.name + ": " + std::to_string(out.num_parameters) +
                                " parameters, the model is built for at most " + std::to_string(P));
  }
  out.viscous.setZero();
  out.p_nominal.setZero();
  out.p_lo.setZero();
  out.p_hi.setZero();
  for (int k = 0; k < out.num_parameters; ++k) {
    const NominalParameter& parameter = arm.parameters[static_cast<std::size_t>(k)];
    out.p_nominal(k) = parameter.nominal;
    out.p_lo(k) = parameter.lo;
    out.p_hi(k) = parameter.hi;
    out.viscous.col(k) = PerJoint<N>(parameter.viscous_weights, 0.0, "viscous weights");
  }
}

/// The shapes of the parameters on each body, then its known part.
template <int N, int P>
void ReadBodies(const NominalArm& arm, ArmModel<N, P>& out) {
  if (static_cast<int>(arm.known.size()) != N) {
    throw std::invalid_argument(arm.name + ": " + std::to_string(arm.known.size()) + " bodies for " +
                                std::to_string(N) + " joints");
  }
  int count = 0;
  for (int b = 0; b < N; ++b) {
    out.first_shape[b] = count;
    for (int k = 0; k < out.num_parameters; ++k) {
      const NominalParameter& parameter = arm.parameters[static_cast<std::size_t>(k)];
      MassMoments unit;
      for (const ParameterShape& part : parameter.shapes) {
        if (part.body == b) unit.Add(1.0, Moments(part.unit));
      }
      if (unit.IsZero()) continue;
      out.shape[count++] = {k, unit};
    }
    const MassMoments known = Moments(arm.known[static_cast<std::size_t>(b)]);
    if (!known.IsZero()) out.shape[count++] = {P, known};
  }
  out.first_shape[N] = count;
}

/// The longest member of a link carries its weight.
template <int N, int P>
void ReadMembers(const NominalArm& arm, ArmModel<N, P>& out) {
  const std::vector<FlexibleMember> members = FlexibleMembers(arm);
  if (members.size() > static_cast<std::size_t>(ArmModel<N, P>::kMaxMembers)) {
    throw std::invalid_argument(arm.name + ": " + std::to_string(members.size()) +
                                " members bend, the model is built for at most " +
                                std::to_string(ArmModel<N, P>::kMaxMembers));
  }
  for (int i = 0; i < N; ++i) out.carrier[i] = -1;
  out.num_members = 0;
  for (const FlexibleMember& member : members) {
    const Eigen::Matrix3d axes = member.axes();
    Member beam;
    beam.link = member.link;
    beam.Span(member.from_m, member.to_m);
    beam.y = axes.col(1);
    beam.z = axes.col(2);
    beam.EA = member.EA_N;
    beam.EI_y = member.EI_y_Nm2;
    beam.EI_z = member.EI_z_Nm2;
    beam.GJ = member.GJ_Nm2;
    beam.rhoA = member.rhoA_kgpm;
    beam.softer = beam.EI_y == beam.EI_z ? 0.0 : 1.0 / beam.EI_z - 1.0 / beam.EI_y;
    const int j = out.num_members++;
    out.member[j] = beam;
    int& longest = out.carrier[beam.link];
    if (longest < 0 || beam.length > out.member[longest].length) longest = j;
  }
}

}  // namespace internal

/// Where the description does not say: no rotor inertia, no hardening, everything else infinite.
/// Throws std::invalid_argument with one line for an arm of other sizes.
template <int N, int P>
ArmModel<N, P> ArmModelFrom(const NominalArm& arm) {
  if (arm.dof() != N) {
    throw std::invalid_argument(arm.name + ": " + std::to_string(arm.dof()) +
                                " joints, the model is built for " + std::to_string(N));
  }
  ArmModel<N, P> out;
  out.gravity = arm.gravity_mps2;
  out.tool_offset = arm.tool.xyz_m;
  out.tool_rotation = arm.tool.rotation();
  out.sensor_rotation = arm.force_sensor.rotation();
  out.sensor_to_tool = out.sensor_rotation.transpose() * (arm.tool.xyz_m - arm.force_sensor.xyz_m);
  out.sensor_tool_mass = arm.force_sensor.tool_mass_kg;
  out.sensor_tool_com = arm.force_sensor.tool_com_m;
  for (int i = 0; i < N; ++i) {
    const Joint& joint = arm.joints[static_cast<std::size_t>(i)];
    out.mount_R[i] = joint.rotation();
    out.mount_p[i] = joint.xyz_m;
    out.d(i) = joint.d_m;
  }
  const Eigen::Matrix3d R_base = arm.base.rotation();
  out.mount_p[0] = arm.base.xyz_m + R_base * out.mount_p[0];
  out.mount_R[0] = (R_base * out.mount_R[0]).eval();
  using internal::PerJoint;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  out.rotor_inertia = PerJoint<N>(arm.rotor_inertia_kgm2, 0.0, "rotor inertia");
  out.joint_stiffness = PerJoint<N>(arm.joint_stiffness_Nmprad, kInfinity, "joint stiffness");
  out.joint_hardening = PerJoint<N>(arm.joint_hardening_Nmprad3, 0.0, "joint hardening");
  out.torque_limit = PerJoint<N>(arm.torque_limit_Nm, kInfinity, "torque limit");
  out.position_min = PerJoint<N>(arm.position_min_rad, -kInfinity, "lower position limit");
  out.position_max = PerJoint<N>(arm.position_max_rad, kInfinity, "upper position limit");
  out.speed_limit = PerJoint<N>(arm.speed_limit_radps, kInfinity, "speed limit");
  internal::ReadParameters(arm, out);
  internal::ReadBodies(arm, out);
  internal::ReadMembers(arm, out);
  return out;
}

}  // namespace reed::model
