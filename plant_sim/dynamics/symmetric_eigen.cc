// The one translation unit with Eigen's symmetric solvers: they take 7 s to compile, wherever they are used.
#include "reed/plant/dynamics/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace reed::plant {

using Eigen::MatrixXd;

Eigen::VectorXd SymmetricEigenvalues(const MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

EigenPairs GeneralizedEigen(const MatrixXd& A, const MatrixXd& B, Wanted wanted) {
  const bool pairs = wanted == Wanted::kPairs;
  // Else the machine's own caches decide the order of sums in products of large matrices.
  Eigen::setCpuCacheSizes(32 << 10, 256 << 10, 2 << 20);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(
      A, B, (pairs ? Eigen::ComputeEigenvectors : Eigen::EigenvaluesOnly) | Eigen::Ax_lBx);
  return {solver.eigenvalues(), pairs ? solver.eigenvectors() : MatrixXd()};
}

}  // namespace reed::plant
