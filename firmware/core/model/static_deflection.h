// (22): θ_d, the desired joint angle after static deflection compensation (the paper: after nodal displacement).
// The plan is for a rigid arm. The tool point of the bent arm reaches the planned point at the motor angles
//   θ_d = θ_plan + ξ - J_v⁺ Δp
// with ξ_i = τ_i / k_q,i the angle by which the motor leads its joint while the spring carries the static
// torque τ_i, and Δp the displacement (4) of the tool point by its bending links.  RT: safe.
#pragma once

#include "reed/core/model/compliance.h"
#include "reed/core/model/positive_solver.h"

namespace reed::model {

template <int N>
struct StaticDeflection {
  Vec<N> offset;           // θ_d - θ_plan
  Vec<N> spring;           // ξ, motor minus joint
  Eigen::Vector3d link_u;  // Δp, displacement of the tool point by the links
};

/// ξ of a spring with torque k ξ + k₃ ξ³ (k₃ ≥ 0). Newton from the linear answer converges monotonically from
/// beyond; six steps reach rounding while the cubic torque at the linear answer is below three times the
/// linear one.
inline double SpringAngle(double torque, double k, double k3) {
  double xi = torque / k;
  if (k3 > 0.0) {
    for (int step = 0; step < 6; ++step)
      xi -= (k * xi + k3 * xi * xi * xi - torque) / (k + 3.0 * k3 * xi * xi);
  }
  return xi;
}

/// Damped pseudo-inverse of the linear Jacobian: J_vᵀ (J_v J_vᵀ + λ² 1)⁻¹ u.
template <int N>
Vec<N> DampedInverse(const Mat<6, N>& J, const Eigen::Vector3d& u, double lambda) {
  const Mat<3, N> J_v = J.template topRows<3>();
  Eigen::Matrix3d A = math::LowerGram(J_v);
  A.diagonal().array() += lambda * lambda;
  const Eigen::Vector3d y = math::SolvePositive<3>(A, u);
  return J_v.transpose() * y;
}

/// Static deflection at the state of `pose` (θ_plan, or θ nearby) under the weight of `bodies` and
/// `tip_wrench`, the environment's wrench on the tool point (force, moment about it; world axes).
template <int N, int P>
StaticDeflection<N> CompensateDeflection(const ArmModel<N, P>& arm, const LinkPoses<N>& pose,
                                         const Bodies<N>& bodies, const Wrench& tip_wrench) {
  constexpr double kDamping_m = 1e-3;  // costs 1 ppm of the correction where the arm is 1 m from singular
  StructuralLoads<N> loads;
  loads.tip = tip_wrench;
  AddBodyWeight(arm, pose, bodies, loads);
  const SerialDeflections<N> bent = DeflectSerially(arm, pose, loads);
  StaticDeflection<N> out;
  for (int i = 0; i < N; ++i) {
    out.spring(i) = SpringAngle(-bent.torque(i), arm.joint_stiffness(i), arm.joint_hardening(i));
  }
  out.link_u = bent.tip_links.u;
  out.offset = out.spring - DampedInverse(pose.J, out.link_u, kDamping_m);
  return out;
}

}  // namespace reed::model
