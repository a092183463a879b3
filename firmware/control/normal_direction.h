// D: the joint motion that moves the tip along the wall's normal and nowhere else.
//
//   J_n = nᵀ J_v                              row of the normal tip velocity
//   D   = J⁺ [n; 0] / (J_n J⁺ [n; 0])         pure normal translation, J_n D = 1
//
// J⁺ is damped, J⁺ = (JᵀJ + ε 1)⁻¹ Jᵀ = Jᵀ (JJᵀ + ε 1)⁻¹; the smaller of the two systems is solved. D from
// J_n⁺ alone lets the tip drift sideways by a millimetre while it presses.  RT: safe.
#pragma once

#include "firmware/control/surface.h"
#include "firmware/math/positive_solver.h"

namespace reed::control {

template <int N>
struct NormalDirection {
  Vec<N> D = Vec<N>::Zero();                                              // rad/m
  Eigen::Matrix<double, 1, N> J_n = Eigen::Matrix<double, 1, N>::Zero();  // m/rad
};

/// Damping relative to the mean squared singular value: far below the arm's own accuracy, enough to stay
/// finite.
inline constexpr double kRelativeDamping = 1e-10;

template <int N>
NormalDirection<N> PureNormalTranslation(const Mat<6, N>& J, const Eigen::Vector3d& n) noexcept {
  constexpr int kSmaller = N < 6 ? N : 6;
  const double epsilon = kRelativeDamping * J.squaredNorm() / kSmaller;
  NormalDirection<N> out;
  out.J_n = n.transpose() * J.template topRows<3>();
  Vec<N> x;  // J⁺ [n; 0]
  if constexpr (N < 6) {
    Mat<N, N> JtJ = J.transpose() * J;
    JtJ.diagonal().array() += epsilon;
    x = math::SolvePositive<N>(JtJ, out.J_n.transpose());
  } else {
    Mat<6, 6> JJt = J.lazyProduct(J.transpose());  // from 8 joints on, operator* blocks through the heap
    JJt.diagonal().array() += epsilon;
    Vec<6> direction = Vec<6>::Zero();
    direction.template head<3>() = n;
    x = J.transpose() * math::SolvePositive<6>(JJt, direction);
  }
  const double gain = out.J_n * x;
  if (gain > kRelativeDamping) out.D = x / gain;  // else: the arm cannot move along n here, D = 0
  return out;
}

}  // namespace reed::control
