// (4) for one member against the closed forms of a cantilever.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "reed/core/model/compliance.h"
#include "reed/firmware/stiffness/member_stiffness.h"
#include "reed/tests/model/states.h"

namespace reed::model {
namespace {

constexpr double kL = 0.7, kEA = 3.0e6, kEI = 500.0, kGJ = 380.0;

Mat6 ClampedCompliance(const Eigen::Vector3d& direction) {
  const Mat12 K = MemberStiffness(direction, kL, kEA, kEI, kGJ);
  return K.bottomRightCorner<6, 6>().inverse();
}

TEST(MemberStiffness, GivesTheCantileverCoefficients) {
  const Mat6 C = ClampedCompliance(Eigen::Vector3d::UnitX());
  EXPECT_NEAR(C(0, 0) * kEA / kL, 1.0, 1e-9);
  EXPECT_NEAR(C(1, 1) * 3.0 * kEI / (kL * kL * kL), 1.0, 1e-9);  // L³/3EI
  EXPECT_NEAR(C(2, 2) * 3.0 * kEI / (kL * kL * kL), 1.0, 1e-9);
  EXPECT_NEAR(C(5, 1) * 2.0 * kEI / (kL * kL), 1.0, 1e-9);   // L²/2EI: force along y turns about +z
  EXPECT_NEAR(C(4, 2) * 2.0 * kEI / (kL * kL), -1.0, 1e-9);  // force along z turns about -y
  EXPECT_NEAR(C(4, 4) * kEI / kL, 1.0, 1e-9);                // L/EI
  EXPECT_NEAR(C(3, 3) * kGJ / kL, 1.0, 1e-9);                // L/GJ
}

TEST(MemberStiffness, HasTheSixMotionsOfARigidBodyAndNoOtherThatCostNothing) {
  const Eigen::Vector3d t = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
  const Mat12 K = MemberStiffness(t, kL, kEA, kEI, kGJ);
  for (int k = 0; k < 6; ++k) {
    Vec12 rigid = Vec12::Zero();
    rigid(k) = rigid(k + 6) = 1.0;
    if (k >= 3) rigid.segment<3>(6) = Eigen::Vector3d::Unit(k - 3).cross(kL * t);
    EXPECT_NEAR((K * rigid).norm(), 0.0, 1e-9 * K.norm());
  }
  EXPECT_GT((K.bottomRightCorner<6, 6>()).determinant(), 0.0);
  EXPECT_NEAR((K - K.transpose()).norm(), 0.0, 1e-12 * K.norm());
}

TEST(MemberStiffness, TurnsWithTheMember) {
  const Eigen::Vector3d t = Eigen::Vector3d(0.3, 0.4, -0.8).normalized();
  const Eigen::Matrix3d R =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), t).toRotationMatrix();
  Mat6 turn = Mat6::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = R;
  const Mat6 expected = turn * ClampedCompliance(Eigen::Vector3d::UnitX()) * turn.transpose();
  EXPECT_NEAR((ClampedCompliance(t) - expected).norm(), 0.0, 1e-9 * expected.norm());
}

TEST(Cantilever, IsTheInverseOfTheClampedStiffnessAndOfItsSpreadLoad) {
  test::Draw draw(11);
  Member beam;
  beam.length = kL;
  beam.EA = kEA;
  beam.EI = kEI;
  beam.GJ = kGJ;
  for (int n = 0; n < 50; ++n) {
    const Eigen::Vector3d t = draw.Vector<3>(1.0).normalized(), Q = draw.Vector<3>(20.0);
    const Vec6 W = draw.Vector<6>(10.0);
    const Vec6 expected = ClampedCompliance(t) * (W + EquivalentNodalLoad(t, kL, Q).tail<6>());
    const Deflection end = Cantilever(beam, t, {W.head<3>(), W.tail<3>()}, Q);
    EXPECT_NEAR((end.AsVector() - expected).norm(), 0.0, 1e-12 * (1.0 + expected.norm()));
  }
}

TEST(LayOnMember, FindsTheUniformRodAndTheTipMassThatABodyIsMadeOf) {
  Member beam;
  beam.axis = 0;
  beam.start_at = 0.0;
  beam.end_at = beam.length = 0.35;
  MassMoments body(0.7, Eigen::Vector3d(0.175, 0.0, 0.0),
                   test::Symmetric(0.0, 0.0, 0.0, 0.7 * 0.1225 / 12.0, 0.0, 0.7 * 0.1225 / 12.0));
  body.Add(1.0, MassMoments(0.5, Eigen::Vector3d(0.35, 0.02, 0.0), Eigen::Matrix3d::Zero()));
  const MassOnMember mass = LayOnMember(body, beam);
  EXPECT_NEAR(mass.spread, 0.7, 1e-12);
  EXPECT_NEAR(mass.end, 0.5, 1e-12);
  EXPECT_NEAR(mass.start, 0.0, 1e-12);
  EXPECT_NEAR((mass.off_axis - Eigen::Vector3d(0.0, 0.01, 0.0)).norm(), 0.0, 1e-15);
}

TEST(LayOnMember, CountsFromTheStartOfAMemberThatPointsBackwards) {
  Member beam;
  beam.axis = 2;
  beam.start_at = 0.15;  // d = -0.15: from +z to the origin
  beam.end_at = 0.0;
  beam.length = 0.15;
  const MassMoments at_start(1.0, Eigen::Vector3d(0.0, 0.0, 0.15), Eigen::Matrix3d::Zero());
  EXPECT_NEAR(LayOnMember(at_start, beam).start, 1.0, 1e-12);
  EXPECT_NEAR(LayOnMember(at_start, beam).end, 0.0, 1e-12);
}

}  // namespace
}  // namespace reed::model
