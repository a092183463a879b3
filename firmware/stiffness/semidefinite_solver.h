// Symmetric positive semidefinite systems whose unknowns have different units. RT: set-up only (allocates).
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace reed::model {

/// A x = b, scaled to a unit diagonal; rank by the eigenvalues of the scaled matrix. Below full rank the
/// answer is the one of least norm (in the scaled unknowns), and b is met as well as it can be.
class SemidefiniteSolver {
 public:
  explicit SemidefiniteSolver(const Eigen::MatrixXd& A);
  Eigen::MatrixXd Solve(const Eigen::MatrixXd& b) const;
  int rank() const { return rank_; }

 private:
  int rank_;
  Eigen::VectorXd scale_;
  Eigen::LDLT<Eigen::MatrixXd> ldlt_;  // at full rank
  Eigen::MatrixXd pseudo_inverse_;     // below
};

}  // namespace reed::model
