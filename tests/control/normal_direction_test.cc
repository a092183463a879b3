// D against Eigen's singular values: regular, singular and dead poses.
#include "reed/core/contact/normal_direction.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <random>

#include "reed/tests/support/no_alloc.h"

namespace reed::control {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  template <int R, int C>
  Mat<R, C> Matrix() {
    std::uniform_real_distribution<double> draw(-1.0, 1.0);
    Mat<R, C> out;
    for (int i = 0; i < out.size(); ++i) out(i) = draw(engine_);
    return out;
  }
  Eigen::Vector3d Normal() { return Matrix<3, 1>().normalized(); }

 private:
  std::mt19937_64 engine_;
};

/// J with these singular values, the last of them along a direction that n can see.
template <int N>
Mat<6, N> WithSingularValues(Random& random, double last) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(random.Matrix<6, N>(),
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(svd.singularValues().size(), 1.8, 0.2);
  values.tail<1>()(0) = last;
  return svd.matrixU() * values.asDiagonal() * svd.matrixV().transpose();
}

/// J⁺ [n; 0] / (J_n J⁺ [n; 0]) by singular values; those below `smallest` count as zero.
template <int N>
Vec<N> ByDefinition(const Mat<6, N>& J, const Eigen::Vector3d& n, double smallest) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::ArrayXd values = svd.singularValues();
  const Eigen::VectorXd inverse = (values > smallest).select(values.inverse(), 0.0).matrix();
  Vec<6> b;
  b << n, 0.0, 0.0, 0.0;
  const Vec<N> x = svd.matrixV() * (inverse.asDiagonal() * (svd.matrixU().transpose() * b));
  return x / (n.transpose() * J.template topRows<3>() * x).value();
}

template <int N>
void ExpectThePseudoInverse(double last_singular_value, double limit) {
  Random random(100 + N);
  for (int k = 0; k < 200; ++k) {
    const Mat<6, N> J = WithSingularValues<N>(random, last_singular_value);
    const Eigen::Vector3d n = random.Normal();
    const Vec<N> expected = ByDefinition<N>(J, n, 1e-9);
    const NormalDirection<N> normal = PureNormalTranslation<N>(J, n);
    ASSERT_LT((normal.D - expected).norm(), limit * expected.norm()) << N << " joints, case " << k;
    ASSERT_NEAR(normal.J_n.dot(normal.D), 1.0, 1e-9);
  }
}

TEST(NormalDirection, IsThatOfTheExactPseudoInverseAtRegularPoses) {
  ExpectThePseudoInverse<4>(0.1, 1e-12);
  ExpectThePseudoInverse<5>(0.1, 1e-12);
  ExpectThePseudoInverse<6>(0.1, 1e-12);
  ExpectThePseudoInverse<7>(0.1, 1e-12);
  ExpectThePseudoInverse<8>(0.1, 1e-12);
}

TEST(NormalDirection, IsThatOfTheExactPseudoInverseAThousandthFromSingular) {
  ExpectThePseudoInverse<5>(1e-3, 1e-10);
  ExpectThePseudoInverse<6>(1e-3, 1e-10);
  ExpectThePseudoInverse<7>(1e-3, 1e-10);
}

TEST(NormalDirection, LeavesOutTheDirectionThatIsLostAtASingularPose) {
  // Rounding of J along the lost direction, divided by the damping: a motion that the tip does not feel.
  ExpectThePseudoInverse<5>(0.0, 1e-3);
  ExpectThePseudoInverse<6>(0.0, 1e-3);
  ExpectThePseudoInverse<7>(0.0, 1e-3);
}

TEST(NormalDirection, StaysBoundedWhateverTheSingularValue) {
  Random random(7);
  for (double last = 1e-2; last > 1e-20; last /= 3.0) {
    const Mat<6, 6> J = WithSingularValues<6>(random, last);
    const Vec<6> x = PseudoInverseOfNormal<6>(J, random.Normal());
    EXPECT_TRUE(x.allFinite()) << last;
    EXPECT_LT(x.norm(), 2.0 / std::sqrt(kRelativeDamping)) << last;
  }
}

TEST(NormalDirection, IsZeroWhereTheArmCannotMoveAlongTheNormal) {
  Mat<6, 2> planar = Mat<6, 2>::Zero();  // moves in x and z, turns about y
  planar.row(0) << 0.3, 0.1;
  planar.row(2) << -0.5, -0.4;
  planar.row(4) << 1.0, 1.0;
  EXPECT_EQ(PureNormalTranslation<2>(planar, Eigen::Vector3d::UnitY()).D.norm(), 0.0);
  EXPECT_EQ((PureNormalTranslation<5>(Mat<6, 5>::Zero(), Eigen::Vector3d::UnitZ()).D.norm()), 0.0);
}

TEST(NormalDirection, TouchesNoHeap) {
  Random random(8);
  const Mat<6, 8> J = random.Matrix<6, 8>();
  const Mat<6, 5> J5 = random.Matrix<6, 5>();
  const test::NoAlloc guard("PureNormalTranslation");
  EXPECT_GT(PureNormalTranslation<8>(J, Eigen::Vector3d::UnitZ()).D.norm(), 0.0);
  EXPECT_GT(PureNormalTranslation<5>(J5, Eigen::Vector3d::UnitZ()).D.norm(), 0.0);
}

}  // namespace
}  // namespace reed::control
