#include "reed/firmware/stiffness/semidefinite_solver.h"

#include <Eigen/Eigenvalues>

namespace reed::model {
namespace {

constexpr double kRankTolerance = 1e-11;  // relative to the largest eigenvalue of the scaled matrix
constexpr double kNothing =
    1e-24;  // relative to the largest diagonal entry: what rounding leaves of a zero row

}  // namespace

SemidefiniteSolver::SemidefiniteSolver(const Eigen::MatrixXd& A) {
  const Eigen::ArrayXd diagonal = A.diagonal();
  const double nothing = A.rows() == 0 ? 0.0 : kNothing * diagonal.maxCoeff();
  scale_ = (diagonal > nothing).select(diagonal.cwiseMax(nothing).sqrt().inverse(), 0.0).matrix();
  const Eigen::MatrixXd scaled = scale_.asDiagonal() * A * scale_.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  const Eigen::ArrayXd values = eigen.eigenvalues();
  const double smallest = A.rows() == 0 ? 0.0 : kRankTolerance * values.abs().maxCoeff();
  rank_ = static_cast<int>((values > smallest).count());
  if (rank_ == A.rows()) {
    ldlt_.compute(scaled);
    return;
  }
  const Eigen::VectorXd inverse = (values > smallest).select(values.inverse(), 0.0).matrix();
  pseudo_inverse_ = eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

Eigen::MatrixXd SemidefiniteSolver::Solve(const Eigen::MatrixXd& b) const {
  const Eigen::MatrixXd scaled = scale_.asDiagonal() * b;
  if (rank_ == scale_.size()) return scale_.asDiagonal() * ldlt_.solve(scaled);
  return scale_.asDiagonal() * (pseudo_inverse_ * scaled);
}

}  // namespace reed::model
