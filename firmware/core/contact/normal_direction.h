// D: the joint motion that moves the tip along the wall's normal and nowhere else.
//
//   J_n = nᵀ J_v                              row of the normal tip velocity
//   D   = J⁺ [n; 0] / (J_n J⁺ [n; 0])         pure normal translation, J_n D = 1
//
// J⁺ is the pseudo-inverse, kept finite near singular poses by damping that is taken out again where it is
// not needed (iterated Tikhonov): with A = JᵀJ + ε 1
//
//   x ← A⁻¹ Jᵀ b,    then twice   x ← x + A⁻¹ Jᵀ (b − J x)
//
// which leaves (ε/(σ² + ε))³ of the part of b along a singular value σ: nothing for σ² ≫ ε, all of it for
// σ = 0. For six joints and more the smaller system A = J Jᵀ + ε 1 gives the same, x = Jᵀ y.
// D from J_n⁺ alone lets the tip drift sideways by a millimetre while it presses.  RT: safe.
#pragma once

#include "reed/core/law/surface.h"
#include "reed/core/model/positive_solver.h"
#include "reed/math/side_by_side.h"

namespace reed::control {

template <int N>
struct NormalDirection {
  Vec<N> D = Vec<N>::Zero();                                              // rad/m
  Eigen::Matrix<double, 1, N> J_n = Eigen::Matrix<double, 1, N>::Zero();  // m/rad
};

/// Damping relative to the mean squared singular value: below the arm's own accuracy, above rounding.
inline constexpr double kRelativeDamping = 1e-12;

inline constexpr int kCorrections = 2;

/// J⁺ [n; 0] as above.
template <int N>
Vec<N> PseudoInverseOfNormal(const Mat<6, N>& J, const Eigen::Vector3d& n) noexcept {
  constexpr int kSmaller = N < 6 ? N : 6;
  const double epsilon = kRelativeDamping * J.squaredNorm() / kSmaller;
  Vec<N> x = Vec<N>::Zero(), step;
  if constexpr (N < 6) {
    const auto S = math::Halved(J);
    using T = typename decltype(S)::Scalar;
    Mat<N, N> A;  // its lower half
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j <= i; ++j) A(i, j) = math::SumOf(S.col(i).dot(S.col(j)));
      A(i, i) += epsilon;
    }
    const math::PositiveSolver<N> damped(A);
    Vec<6> b;
    b << n, 0.0, 0.0, 0.0;
    auto rest = math::Halved(b);  // b - J x
    for (int pass = 0; pass <= kCorrections; ++pass) {
      if (pass > 0) rest.noalias() -= S * step.template cast<T>();
      for (int i = 0; i < N; ++i) step(i) = math::SumOf(S.col(i).dot(rest));
      step = damped.Solve(step);
      x += step;
    }
  } else {
    Mat<6, 6> A =
        J.lazyProduct(J.transpose());  // not blocked: Eigen's blocked product allocates from eight joints on
    A.diagonal().array() += epsilon;
    const math::PositiveSolver<6> damped(A);
    Vec<6> rest;  // b - J x
    rest << n, 0.0, 0.0, 0.0;
    for (int pass = 0; pass <= kCorrections; ++pass) {
      if (pass > 0) rest.noalias() -= J * step;
      step.noalias() = J.transpose() * damped.Solve(rest);
      x += step;
    }
  }
  return x;
}

template <int N>
NormalDirection<N> PureNormalTranslation(const Mat<6, N>& J, const Eigen::Vector3d& n) noexcept {
  constexpr double kNoMotion = 1e-10;  // of n; what the arm follows less than this is rounding
  NormalDirection<N> out;
  out.J_n = n.transpose() * J.template topRows<3>();
  const Vec<N> x = PseudoInverseOfNormal(J, n);
  const double gain = out.J_n.dot(x);
  if (gain > kNoMotion) out.D = x / gain;  // else: the arm cannot move along n here, D = 0
  return out;
}

}  // namespace reed::control
