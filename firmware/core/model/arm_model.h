// The constants of one arm as the controller believes it to be, in the sizes and the form that the recursions
// want. N joints, P structural parameters. SI. Built once from the description (set-up only: throws
// std::invalid_argument); afterwards plain numbers, no heap. RT: reading is safe.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "reed/config/controller/nominal_arm.h"
#include "reed/core/model/fixed_array.h"
#include "reed/core/model/mass_moments.h"

namespace reed::model {

template <int N>
using Vec = Eigen::Matrix<double, N, 1>;
template <int R, int C>
using Mat = Eigen::Matrix<double, R, C>;
using Vec6 = Vec<6>;
using Mat6 = Mat<6, 6>;

/// What one unit of parameter k adds to the body it is listed under. k = P: the part of the body that is
/// known.
struct UnitShape {
  int k = 0;
  MassMoments unit;
};

/// A straight elastic member along one axis of its link; one EI for both bending planes (round tube).
struct Member {
  int link = 0;                         // 0-based
  int axis = 2;                         // 2: d of the link, along z_i; 0: a of the next row, along x_i
  double start_at = 0.0, end_at = 0.0;  // where on that axis, from the origin of the link
  double length = 0.0, EA = 0.0, EI = 0.0, GJ = 0.0, rhoA = 0.0;

  double sign() const { return end_at < start_at ? -1.0 : 1.0; }
};

template <int N, int P>
struct ArmModel {
  static constexpr int kMaxMembers = 2 * N;

  // Craig DH (1): T_{i-1,i} = Rx(alpha) Tx(a) Rz(theta) Tz(d).
  Vec<N> cos_alpha, sin_alpha, a, d;
  Eigen::Vector3d gravity;      // base frame
  Eigen::Vector3d tool_offset;  // last link frame

  // Bodies: shapes of link b are shape[first_shape[b]] ... shape[first_shape[b + 1] - 1].
  FixedArray<UnitShape, N*(P + 1)> shape;
  FixedArray<int, N + 1> first_shape;
  Mat<N, P> viscous;  // F_v = diag(viscous p)
  Vec<P> p_nominal, p_lo, p_hi;
  int num_parameters;  // columns from here to P are zero

  // Drive train and limits; where the description does not say: no inertia, no hardening, everything else
  // infinite.
  Vec<N> rotor_inertia, joint_stiffness, joint_hardening, torque_limit, position_min, position_max,
      speed_limit;

  // Elastic members from base to tip; none for an arm that is described without sections.
  FixedArray<Member, kMaxMembers> member;
  int num_members;
  FixedArray<int, N>
      carrier;  // the longer member of each link, which carries its weight; -1: the link has none

  ArmModel() = default;  // empty: for a target without a heap, whose fields are filled from an image
  explicit ArmModel(const NominalArm& arm);

 private:
  void ReadParameters(const NominalArm& arm);
  void ReadBodies(const NominalArm& arm);
  void ReadMembers(const NominalArm& arm);
  void AddMember(const NominalArm& arm, Member beam);
};

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

}  // namespace internal

template <int N, int P>
ArmModel<N, P>::ArmModel(const NominalArm& arm)
    : gravity(arm.gravity_mps2), tool_offset(arm.tool_offset_m) {
  if (arm.dof() != N) {
    throw std::invalid_argument(arm.name + ": " + std::to_string(arm.dof()) +
                                " joints, the model is built for " + std::to_string(N));
  }
  for (int i = 0; i < N; ++i) {
    const DhRow& row = arm.dh[static_cast<std::size_t>(i)];
    cos_alpha(i) = std::cos(row.alpha_rad);
    sin_alpha(i) = std::sin(row.alpha_rad);
    a(i) = row.a_m;
    d(i) = row.d_m;
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  rotor_inertia = internal::PerJoint<N>(arm.rotor_inertia_kgm2, 0.0, "rotor inertia");
  joint_stiffness = internal::PerJoint<N>(arm.joint_stiffness_Nmprad, kInfinity, "joint stiffness");
  joint_hardening = internal::PerJoint<N>(arm.joint_hardening_Nmprad3, 0.0, "joint hardening");
  torque_limit = internal::PerJoint<N>(arm.torque_limit_Nm, kInfinity, "torque limit");
  position_min = internal::PerJoint<N>(arm.position_min_rad, -kInfinity, "lower position limit");
  position_max = internal::PerJoint<N>(arm.position_max_rad, kInfinity, "upper position limit");
  speed_limit = internal::PerJoint<N>(arm.speed_limit_radps, kInfinity, "speed limit");
  ReadParameters(arm);
  ReadBodies(arm);
  ReadMembers(arm);
}

template <int N, int P>
void ArmModel<N, P>::ReadParameters(const NominalArm& arm) {
  num_parameters = arm.num_parameters();
  if (num_parameters > P) {
    throw std::invalid_argument(arm.name + ": " + std::to_string(num_parameters) +
                                " parameters, the model is built for at most " + std::to_string(P));
  }
  viscous.setZero();
  p_nominal.setZero();
  p_lo.setZero();
  p_hi.setZero();
  for (int k = 0; k < num_parameters; ++k) {
    const NominalParameter& parameter = arm.parameters[static_cast<std::size_t>(k)];
    p_nominal(k) = parameter.nominal;
    p_lo(k) = parameter.lo;
    p_hi(k) = parameter.hi;
    viscous.col(k) = internal::PerJoint<N>(parameter.viscous_weights, 0.0, "viscous weights");
  }
}

/// The units of the parameters, then what is known of each link without them.
template <int N, int P>
void ArmModel<N, P>::ReadBodies(const NominalArm& arm) {
  if (static_cast<int>(arm.known.size()) != N) {
    throw std::invalid_argument(arm.name + ": " + std::to_string(arm.known.size()) + " bodies for " +
                                std::to_string(N) + " joints");
  }
  int count = 0;
  for (int b = 0; b < N; ++b) {
    first_shape[b] = count;
    for (int k = 0; k < num_parameters; ++k) {
      const NominalParameter& parameter = arm.parameters[static_cast<std::size_t>(k)];
      MassMoments unit;
      for (const ParameterShape& part : parameter.shapes) {
        if (part.body == b) unit.Add(1.0, MassMoments(part.unit));
      }
      if (unit.IsZero()) continue;
      shape[count++] = {k, unit};
    }
    const KnownMass& rest = arm.known[static_cast<std::size_t>(b)];
    MassMoments known;
    known.m = rest.mass_kg;
    known.h = rest.first_kgm;
    known.J = rest.second_kgm2;
    if (!known.IsZero()) shape[count++] = {P, known};
  }
  first_shape[N] = count;
}

/// Sections follow the chain: for each link its d along z_i, then the next row's a along x_i, where not zero.
/// What lies before the first joint (a of the first row) and behind the last origin (the tool) is rigid.
template <int N, int P>
void ArmModel<N, P>::ReadMembers(const NominalArm& arm) {
  num_members = 0;
  for (int i = 0; i < N; ++i) {
    carrier[i] = -1;
    if (arm.sections.empty()) continue;
    if (d(i) != 0.0) AddMember(arm, {i, 2, -d(i), 0.0});
    if (i + 1 < N && a(i + 1) != 0.0) AddMember(arm, {i, 0, 0.0, a(i + 1)});
  }
  if (static_cast<int>(arm.sections.size()) != num_members) {
    throw std::invalid_argument(arm.name + ": " + std::to_string(arm.sections.size()) + " sections for " +
                                std::to_string(num_members) + " members (non-zero d and a)");
  }
}

template <int N, int P>
void ArmModel<N, P>::AddMember(const NominalArm& arm, Member beam) {
  const int j = num_members++;
  if (j >= static_cast<int>(arm.sections.size())) return;  // the caller compares the counts
  const BeamSection& section = arm.sections[static_cast<std::size_t>(j)];
  beam.length = std::abs(beam.end_at - beam.start_at);
  if (std::abs(section.length_m - beam.length) > 1e-6) {
    throw std::invalid_argument(arm.name + ": section " + std::to_string(j + 1) + " is " +
                                std::to_string(section.length_m) + " m long, its DH entry " +
                                std::to_string(beam.length) + " m");
  }
  beam.EA = section.EA_N;
  beam.EI = section.EI_Nm2;
  beam.GJ = section.GJ_Nm2;
  beam.rhoA = section.rhoA_kgpm;
  member[j] = beam;
  int& longest = carrier[beam.link];
  if (longest < 0 || beam.length > member[longest].length) longest = j;
}

}  // namespace reed::model
