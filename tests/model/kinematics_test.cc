// (1)-(3) against products of 4x4 matrices and central differences.
#include "reed/core/model/kinematics.h"

#include <gtest/gtest.h>

#include "reed/firmware/setup/arm_model.h"
#include "reed/tests/model/states.h"

namespace reed::model {
namespace {

Eigen::Matrix4d Craig(const Joint& row, double theta) {
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  T.rotate(Eigen::AngleAxisd(row.rpy_rad.x(), Eigen::Vector3d::UnitX()));
  T.translate(Eigen::Vector3d(row.xyz_m.x(), 0.0, 0.0));
  T.rotate(Eigen::AngleAxisd(theta, Eigen::Vector3d::UnitZ()));
  T.translate(Eigen::Vector3d(0.0, 0.0, row.d_m));
  return T.matrix();
}

class SkewArmKinematics : public ::testing::Test {
 protected:
  const ArmDescription description_ = test::SkewArm();
  const test::ModelArm<6, 4> arm_{description_};
  test::Draw draw_{1};

  Kinematics<6> At(const Vec<6>& q, const Vec<6>& qd) const {
    Kinematics<6> kin;
    ForwardKinematics(arm_, q, qd, kin);
    return kin;
  }
};

TEST_F(SkewArmKinematics, EveryLinkStandsWhereTheCraigMatricesPutIt) {
  for (int n = 0; n < 100; ++n) {
    const Vec<6> q = draw_.Vector<6>(3.0);
    const Kinematics<6> kin = At(q, Vec<6>::Zero());
    Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
    for (int i = 0; i < 6; ++i) {
      T = (T * Craig(description_.joints[static_cast<std::size_t>(i)], q(i))).eval();
      EXPECT_NEAR((T.topLeftCorner<3, 3>() - kin.R[i]).norm(), 0.0, 1e-14);
      EXPECT_NEAR((T.topRightCorner<3, 1>() - kin.p[i]).norm(), 0.0, 1e-14);
    }
    const Eigen::Vector4d tool = T * description_.tool.xyz_m.homogeneous();
    EXPECT_NEAR((tool.head<3>() - kin.tip).norm(), 0.0, 1e-14);
  }
}

TEST_F(SkewArmKinematics, TheJacobianIsTheDerivativeOfThePose) {
  constexpr double h = 1e-6;
  for (int n = 0; n < 50; ++n) {
    const Vec<6> q = draw_.Vector<6>(3.0);
    const Kinematics<6> kin = At(q, Vec<6>::Zero());
    for (int i = 0; i < 6; ++i) {
      const Kinematics<6> hi = At(q + h * Vec<6>::Unit(i), Vec<6>::Zero()),
                          lo = At(q - h * Vec<6>::Unit(i), Vec<6>::Zero());
      const Eigen::Matrix3d spin = (hi.R_last() - lo.R_last()) / (2.0 * h) * kin.R_last().transpose();
      EXPECT_NEAR(((hi.tip - lo.tip) / (2.0 * h) - kin.J.col(i).head<3>()).norm(), 0.0, 1e-9);
      EXPECT_NEAR((0.5 * Vee(spin) - kin.J.col(i).tail<3>()).norm(), 0.0, 1e-9);
    }
  }
}

TEST_F(SkewArmKinematics, JdotQdIsTheDerivativeOfTheTipVelocityAtConstantSpeed) {
  constexpr double h = 1e-6;
  for (int n = 0; n < 50; ++n) {
    const Vec<6> q = draw_.Vector<6>(3.0), qd = draw_.Vector<6>(2.0);
    const Vec6 ahead = At(q + h * qd, qd).tip_velocity(), behind = At(q - h * qd, qd).tip_velocity();
    EXPECT_NEAR(((ahead - behind) / (2.0 * h) - TipAcceleration(arm_, At(q, qd))).norm(), 0.0, 1e-8);
  }
}

TEST_F(SkewArmKinematics, TwoPosesAtOnceHaveTheBitsOfEachAlone) {
  for (int n = 0; n < 20; ++n) {
    const Vec<6> q = draw_.Vector<6>(3.0), qd = draw_.Vector<6>(2.0), other = draw_.Vector<6>(3.0);
    Kinematics<6> at_once;
    LinkPoses<6> planned;
    ForwardKinematics(arm_, q, qd, at_once, other, planned);
    const Kinematics<6> alone = At(q, qd), planned_alone = At(other, qd);
    EXPECT_EQ(at_once.J, alone.J);
    EXPECT_EQ(at_once.tip, alone.tip);
    EXPECT_EQ(at_once.v[5], alone.v[5]);
    EXPECT_EQ(planned.J, planned_alone.J);
    EXPECT_EQ(planned.tip, planned_alone.tip);
    for (int i = 0; i < 6; ++i) {
      EXPECT_EQ(at_once.R[i], alone.R[i]);
      EXPECT_EQ(planned.R[i], planned_alone.R[i]);
      EXPECT_EQ(planned.p[i], planned_alone.p[i]);
    }
  }
}

TEST_F(SkewArmKinematics, LinkVelocitiesAreThoseOfTheJacobianAtTheLastLink) {
  const Kinematics<6> kin = At(draw_.Vector<6>(3.0), draw_.Vector<6>(2.0));
  const Vec6 tip = kin.tip_velocity();
  EXPECT_NEAR((kin.omega[5] - tip.tail<3>()).norm(), 0.0, 1e-14);
  EXPECT_NEAR((kin.v[5] + kin.omega[5].cross(kin.tip - kin.p[5]) - tip.head<3>()).norm(), 0.0, 1e-14);
}

TEST(EulerAngles, RebuildTheRotationTheyCameFrom) {  // (2)
  test::Draw draw(2);
  for (int n = 0; n < 200; ++n) {
    const double alpha = draw.Number(3.1), beta = draw.Number(1.5), gamma = draw.Number(3.1);
    const Eigen::Matrix3d R = (Eigen::AngleAxisd(gamma, Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(beta, Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(alpha, Eigen::Vector3d::UnitX()))
                                  .toRotationMatrix();
    EXPECT_NEAR((EulerAngles(R) - Eigen::Vector3d(alpha, beta, gamma)).norm(), 0.0, 1e-12);
  }
}

TEST(Pose, FiveJointsReachOnlyFiveOfSixDirections) {  // (3)
  const test::ModelArm<5, 6> arm(test::ArmA5());
  Kinematics<5> kin;
  ForwardKinematics<5>(arm, Vec<5>(0.3, 0.7, -1.1, 0.4, 0.2), Vec<5>::Zero(), kin);
  EXPECT_LT((kin.J * kin.J.transpose()).determinant(), 1e-18);
  EXPECT_GT((kin.J.transpose() * kin.J).determinant(), 1e-6);
  EXPECT_EQ(Pose(arm, kin).head<3>(), kin.tip);
}

}  // namespace
}  // namespace reed::model
