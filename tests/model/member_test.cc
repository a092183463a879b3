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
  beam.EI_y = beam.EI_z = kEI;
  beam.GJ = kGJ;
  for (int n = 0; n < 50; ++n) {
    const Eigen::Vector3d t = draw.Vector<3>(1.0).normalized(), Q = draw.Vector<3>(20.0);
    const Vec6 W = draw.Vector<6>(10.0);
    const Vec6 expected = ClampedCompliance(t) * (W + EquivalentNodalLoad(t, kL, Q).tail<6>());
    const Deflection end = Cantilever(beam, t, {W.head<3>(), W.tail<3>()}, Q);
    EXPECT_NEAR((end.AsVector() - expected).norm(), 0.0, 1e-12 * (1.0 + expected.norm()));
  }
}

TEST(MemberStiffness, BendsInEachPlaneWithItsOwnStiffness) {
  const double EI_y = 200.0, EI_z = 900.0;
  const Mat12 K = MemberStiffness(Eigen::Matrix3d::Identity(), kL, {kEA, EI_y, EI_z, kGJ});
  const Mat6 C = K.bottomRightCorner<6, 6>().inverse();
  EXPECT_NEAR(C(1, 1) * 3.0 * EI_z / (kL * kL * kL), 1.0, 1e-9) << "a force along y bends about z";
  EXPECT_NEAR(C(2, 2) * 3.0 * EI_y / (kL * kL * kL), 1.0, 1e-9);
  EXPECT_NEAR(C(5, 1) * 2.0 * EI_z / (kL * kL), 1.0, 1e-9);
  EXPECT_NEAR(C(4, 2) * 2.0 * EI_y / (kL * kL), -1.0, 1e-9);
  EXPECT_NEAR(C(5, 5) * EI_z / kL, 1.0, 1e-9);
  EXPECT_NEAR(C(4, 4) * EI_y / kL, 1.0, 1e-9);
}

TEST(Cantilever, WithASofterPlaneIsTheInverseToo) {
  test::Draw draw(12);
  Member beam;
  beam.length = kL;
  beam.EA = kEA;
  beam.EI_y = 900.0;
  beam.EI_z = 200.0;
  beam.softer = 1.0 / beam.EI_z - 1.0 / beam.EI_y;
  beam.GJ = kGJ;
  for (int n = 0; n < 50; ++n) {
    const Eigen::Matrix3d axes = Eigen::Quaterniond(draw.Number(1.0), draw.Number(1.0), draw.Number(1.0), 1.0)
                                     .normalized()
                                     .toRotationMatrix();
    const Eigen::Vector3d Q = draw.Vector<3>(20.0);
    const Vec6 W = draw.Vector<6>(10.0);
    const Mat12 K = MemberStiffness(axes, kL, {beam.EA, beam.EI_y, beam.EI_z, beam.GJ});
    const Vec6 expected =
        K.bottomRightCorner<6, 6>().inverse() * (W + EquivalentNodalLoad(axes.col(0), kL, Q).tail<6>());
    Deflection end = Cantilever(beam, axes.col(0), {W.head<3>(), W.tail<3>()}, Q);
    end.AddRigidly(SofterPlane(beam, axes.col(1), axes.col(2), {W.head<3>(), W.tail<3>()}, Q),
                   Eigen::Vector3d::Zero());
    EXPECT_NEAR((end.AsVector() - expected).norm(), 0.0, 1e-12 * (1.0 + expected.norm()));
  }
}

Member Between(const Eigen::Vector3d& start, const Eigen::Vector3d& end) {
  Member beam;
  beam.Span(start, end);
  return beam;
}

TEST(LayOnMember, FindsTheUniformRodAndTheTipMassThatABodyIsMadeOf) {
  const Member beam = Between(Eigen::Vector3d::Zero(), {0.35, 0.0, 0.0});
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
  const Member beam = Between({0.0, 0.0, 0.15}, Eigen::Vector3d::Zero());  // d = -0.15: from +z to the origin
  const MassMoments at_start(1.0, Eigen::Vector3d(0.0, 0.0, 0.15), Eigen::Matrix3d::Zero());
  EXPECT_NEAR(LayOnMember(at_start, beam).start, 1.0, 1e-12);
  EXPECT_NEAR(LayOnMember(at_start, beam).end, 0.0, 1e-12);
}

TEST(LayOnMember, FollowsASkewMemberThatDoesNotPassTheOrigin) {
  const Eigen::Vector3d start(0.1, -0.2, 0.05), end(0.3, 0.1, 0.45);
  const Member beam = Between(start, end);
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - beam.t * beam.t.transpose();
  const Eigen::Vector3d beside = across * Eigen::Vector3d(0.02, 0.01, 0.0);
  MassMoments body(0.7, 0.5 * (start + end), 0.7 * beam.length * beam.length / 12.0 * across);  // a rod
  body.Add(1.0, MassMoments(0.5, end + beside, Eigen::Matrix3d::Zero()));
  body.Add(1.0, MassMoments(0.2, start, Eigen::Matrix3d::Zero()));
  const MassOnMember mass = LayOnMember(body, beam);
  EXPECT_NEAR(mass.start, 0.2, 1e-12);
  EXPECT_NEAR(mass.spread, 0.7, 1e-12);
  EXPECT_NEAR(mass.end, 0.5, 1e-12);
  EXPECT_NEAR((mass.off_axis - 0.5 * beside).norm(), 0.0, 1e-15);
}

}  // namespace
}  // namespace reed::model
