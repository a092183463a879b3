// The contact force that explains the momentum observer's r, without a force sensor.
//
//   F̂ = (J_v J_vᵀ + ε 1)⁻¹ J_v r            (50)     N, least squares of Jᵀ F = r
//   f̂ = nᵀ F̂
//
// r also holds what the model does not know, so f̂ is good after a tare shortly before contact.  RT: safe.
#pragma once

#include "reed/core/law/surface.h"
#include "reed/core/model/positive_solver.h"

namespace reed::control {

template <int N>
Eigen::Vector3d EstimateTipForce(const Mat<6, N>& J, const Vec<N>& r) noexcept {
  constexpr double kRankDamping = 1e-6;  // of the mean squared singular value; a planar arm has rank 2
  const Mat<3, N> J_v = J.template topRows<3>();
  Eigen::Matrix3d A = math::LowerGram(J_v);
  A.diagonal().array() += kRankDamping * A.trace() / 3.0;
  const Eigen::Vector3d b = J_v * r;
  return math::SolvePositive<3>(A, b);  // (50)
}

}  // namespace reed::control
