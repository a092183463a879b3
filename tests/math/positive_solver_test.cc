#include "firmware/math/positive_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace reed::math {
namespace {

template <typename Size>
class PositiveSolverOf : public testing::Test {};
using Sizes = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                             std::integral_constant<int, 3>, std::integral_constant<int, 5>,
                             std::integral_constant<int, 6>>;
TYPED_TEST_SUITE(PositiveSolverOf, Sizes);

TYPED_TEST(PositiveSolverOf, AgreesWithEigenAndSatisfiesTheEquation) {
  constexpr int N = TypeParam::value;
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;
  std::srand(5);  // Eigen's Random
  for (int trial = 0; trial < 200; ++trial) {
    const Matrix B = Matrix::Random();
    const Matrix A = B * B.transpose() + 0.1 * Matrix::Identity();
    const Vector b = Vector::Random();
    const Vector x = SolvePositive<N>(A, b);
    EXPECT_LT((A * x - b).norm(), 1e-13 * A.norm() * x.norm());
    EXPECT_LT((x - A.ldlt().solve(b)).norm(), 1e-12 * x.norm());
  }
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
