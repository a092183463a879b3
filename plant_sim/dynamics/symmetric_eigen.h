#pragma once

#include <Eigen/Core>

namespace reed::plant {

struct EigenPairs {
  Eigen::VectorXd values;   // ascending
  Eigen::MatrixXd vectors;  // by column; empty where none were asked for
};

enum class Wanted { kValues, kPairs };

/// Eigenvalues of A, symmetric, ascending. Set-up.
[[nodiscard]] Eigen::VectorXd SymmetricEigenvalues(const Eigen::MatrixXd& A);

/// A φ = λ B φ, A symmetric, B symmetric and positive definite, φᵀBφ = 1. Set-up.
[[nodiscard]] EigenPairs GeneralizedEigen(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, Wanted wanted);

}  // namespace reed::plant
