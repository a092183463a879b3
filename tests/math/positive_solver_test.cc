#include "reed/core/model/positive_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace reed::math {
namespace {

/// Eigen's answer; of any size, because the compiler then reads its decomposition once.
Eigen::VectorXd Solved(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) { return A.ldlt().solve(b); }

template <int N>
void ExpectEigensAnswer() {
  std::srand(5);  // Eigen's Random
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::MatrixXd B = Eigen::MatrixXd::Random(N, N);
    const Eigen::MatrixXd A = B * B.transpose() + 0.1 * Eigen::MatrixXd::Identity(N, N);
    const Eigen::VectorXd b = Eigen::VectorXd::Random(N);
    const Eigen::VectorXd x = SolvePositive<N>(A, b);
    EXPECT_LT((A * x - b).norm(), 1e-13 * A.norm() * x.norm()) << N;
    EXPECT_LT((x - Solved(A, b)).norm(), 1e-12 * x.norm()) << N;
  }
}

TEST(PositiveSolver, AgreesWithEigenAndSatisfiesTheEquation) {
  ExpectEigensAnswer<1>();
  ExpectEigensAnswer<2>();
  ExpectEigensAnswer<3>();
  ExpectEigensAnswer<5>();
  ExpectEigensAnswer<6>();
}

TEST(PositiveSolver, StaysFiniteAtRankLossAndAnswersInTheRangeOnly) {
  const Eigen::Vector3d u(1.0, 2.0, 2.0);
  const Eigen::Matrix3d A = u * u.transpose();  // rank 1
  const Eigen::Vector3d x = SolvePositive<3>(A, 3.0 * u);
  EXPECT_TRUE(x.allFinite());
  EXPECT_LT((A * x - 3.0 * u).norm(), 1e-12);
}

TEST(PositiveSolver, AMatrixWithoutAPositivePivotGivesZero) {
  EXPECT_EQ(SolvePositive<2>(-Eigen::Matrix2d::Identity(), Eigen::Vector2d(1.0, 1.0)),
            Eigen::Vector2d::Zero());
}

}  // namespace
}  // namespace reed::math
