// x of A x = b for a small symmetric positive matrix, A = L Dᵢ Lᵀ without pivoting, in plain loops.
// Eigen's LDLT gives the same answers (tests/math); its five instantiations made a quarter of the time that a
// cycle takes to compile.  RT: safe.
#pragma once

#include <Eigen/Core>

namespace reed::math {

/// A: positive definite, usually J Jᵀ + ε 1. A pivot that rounding left at or below zero gives the answer no
/// part in its direction, so that the answer stays finite whatever A holds.
template <int N>
class PositiveSolver {
 public:
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;

  /// Reads the lower half.
  explicit PositiveSolver(const Matrix& A) noexcept {
    for (int j = 0; j < N; ++j) {
      double d = A(j, j);
      for (int k = 0; k < j; ++k) d -= L_(j, k) * L_(j, k) * d_(k);
      d_(j) = d;
      inverse_d_(j) = d > 0.0 ? 1.0 / d : 0.0;
      for (int i = j + 1; i < N; ++i) {
        double sum = A(i, j);
        for (int k = 0; k < j; ++k) sum -= L_(i, k) * L_(j, k) * d_(k);
        L_(i, j) = sum * inverse_d_(j);
      }
    }
  }

  Vector Solve(Vector x) const noexcept {
    for (int i = 0; i < N; ++i) {
      for (int k = 0; k < i; ++k) x(i) -= L_(i, k) * x(k);
    }
    for (int i = N - 1; i >= 0; --i) {
      x(i) *= inverse_d_[i];
      for (int k = i + 1; k < N; ++k) x(i) -= L_(k, i) * x(k);
    }
    return x;
  }

 private:
  Matrix L_;  // strictly below the diagonal
  Vector d_, inverse_d_;
};

/// The lower half of J Jᵀ.
template <int R, int C>
Eigen::Matrix<double, R, R> LowerGram(const Eigen::Matrix<double, R, C>& J) noexcept {
  Eigen::Matrix<double, R, R> A;
  for (int i = 0; i < R; ++i)
    for (int j = 0; j <= i; ++j) A(i, j) = J.row(i).dot(J.row(j));
  return A;
}

/// A deduces N.
template <int N>
Eigen::Matrix<double, N, 1> SolvePositive(const Eigen::Matrix<double, N, N>& A,
                                          const Eigen::Matrix<double, N, 1>& b) noexcept {
  return PositiveSolver<N>(A).Solve(b);
}

}  // namespace reed::math
