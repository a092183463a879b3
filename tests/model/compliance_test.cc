// The serial form of the loop against the direct stiffness method, on arms with odd twists.
#include "reed/core/model/compliance.h"

#include <gtest/gtest.h>

#include "reed/firmware/setup/arm_model.h"
#include "reed/firmware/stiffness/direct_stiffness_arm.h"
#include "reed/tests/model/states.h"

namespace reed::model {
namespace {

constexpr double kAgree = 1e-10;

template <int N, int P>
void ExpectAgreement(const test::ModelArm<N, P>& arm, JointModel joints, test::Draw& draw) {
  Kinematics<N> kin;
  ForwardKinematics<N>(arm, draw.Vector<N>(3.0), Vec<N>::Zero(), kin);
  StructuralLoads<N> loads;
  loads.tip = {draw.Vector<3>(10.0), draw.Vector<3>(2.0)};
  AddBodyWeight(arm, kin, BodiesFor(arm, arm.p_true), loads);
  AddSelfWeight(arm, loads);
  const SerialDeflections<N> serial = DeflectSerially(arm, kin, loads);
  const auto node = NodeDeflections(arm, kin, serial, joints);
  const ArmStructure structure = StructureOf(arm, kin, loads, joints);
  const auto solution = structure.matrix.Solve();
  ASSERT_TRUE(solution.determinate());

  Vec6 tip = serial.tip_links.AsVector();
  if (joints == JointModel::kElastic) tip += TipBySprings(kin, serial).AsVector();
  EXPECT_NEAR((structure.matrix.Displacement(structure.tip, solution) - tip).norm(), 0.0,
              kAgree * tip.norm());
  for (int j = 0; j < arm.num_members; ++j) {
    const Vec6 expected =
        structure.matrix.Displacement(structure.members[static_cast<std::size_t>(j)], solution);
    EXPECT_NEAR((node[j].AsVector() - expected).norm(), 0.0, kAgree * expected.norm()) << "node " << j;
  }
  if (joints == JointModel::kRigid) return;
  for (int i = 0; i < N; ++i) {
    const double xi = structure.matrix.JointRotation(structure.joints[static_cast<std::size_t>(i)], solution);
    EXPECT_NEAR(serial.spring(i), xi, kAgree * serial.spring.norm()) << "joint " << i;
  }
}

TEST(SerialCompliance, AgreesWithTheDirectStiffnessMethodOnA5) {
  const test::ModelArm<5, 6> arm(test::ArmA5());
  test::Draw draw(21);
  for (int n = 0; n < 50; ++n) ExpectAgreement(arm, JointModel::kElastic, draw);
  for (int n = 0; n < 50; ++n) ExpectAgreement(arm, JointModel::kRigid, draw);
}

TEST(SerialCompliance, AgreesWithTheDirectStiffnessMethodOnASkewArm) {
  const test::ModelArm<6, 4> arm(test::SkewArm());
  test::Draw draw(22);
  for (int n = 0; n < 50; ++n) ExpectAgreement(arm, JointModel::kElastic, draw);
  for (int n = 0; n < 50; ++n) ExpectAgreement(arm, JointModel::kRigid, draw);
}

/// Several members on a link, in any direction, apart from joints and from each other, flat sections; a rigid link.
ArmDescription ArmOfMembers() {
  ArmDescription arm = test::SkewArm();
  arm.sections.clear();
  const auto add = [&](int link, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                       const Eigen::Vector3d& y) {
    arm.members.push_back({link, from, to, y, 1.0e7, 900.0, 250.0, 700.0, 0.4});
  };
  add(0, {0.0, 0.0, -0.25}, {0.05, 0.1, -0.1}, {1.0, 0.0, 0.0});
  add(0, {0.05, 0.1, -0.1}, {0.1, -0.05, 0.02}, {0.0, 0.0, 0.0});
  add(0, {0.1, -0.02, 0.02}, {0.1, 0.0, 0.0}, {0.0, 1.0, 1.0});
  add(2, {0.0, 0.01, 0.0}, {-0.08, 0.0, 0.3}, {0.0, 0.0, 0.0});
  add(5, {0.0, 0.0, -0.1}, {0.02, -0.03, 0.0}, {0.3, 1.0, 0.0});
  return arm;
}

TEST(SerialCompliance, AgreesWithTheDirectStiffnessMethodOnMembersInAnyDirection) {
  const test::ModelArm<6, 4> arm(ArmOfMembers());
  test::Draw draw(25);
  for (int n = 0; n < 50; ++n) ExpectAgreement(arm, JointModel::kElastic, draw);
  for (int n = 0; n < 50; ++n) ExpectAgreement(arm, JointModel::kRigid, draw);
}

TEST(SerialCompliance, MatricesAreTheTipsAnswerToUnitWrenches) {
  const test::ModelArm<5, 6> arm(test::ArmA5());
  test::Draw draw(23);
  for (int n = 0; n < 20; ++n) {
    Kinematics<5> kin;
    ForwardKinematics<5>(arm, draw.Vector<5>(3.0), Vec<5>::Zero(), kin);
    const Mat6 C = JointCompliance(arm, kin) + LinkCompliance(arm, kin);
    EXPECT_NEAR((C - C.transpose()).norm(), 0.0, 1e-12 * C.norm());
    const StructuralLoads<5> none;
    const ArmStructure structure = StructureOf(arm, kin, none, JointModel::kElastic);
    const auto cartesian = structure.matrix.CartesianStiffness(structure.tip);
    EXPECT_EQ(cartesian.rank, 6);
    EXPECT_NEAR((cartesian.K * C - Mat6::Identity()).norm(), 0.0, 1e-9);
  }
}

TEST(SerialCompliance, AStraightArmIsOneCantilever) {
  // a5 with all joints at zero and only its two upright-free members counted: members 2 and 3 along x as one
  // beam.
  ArmDescription description = test::ArmA5();
  for (BeamSection& section : description.sections) section = {section.length_m, 1e6, 400.0, 300.0, 0.0};
  description.joints[0].d_m = 0.0;
  description.joints[4].d_m = 0.0;
  description.sections = {description.sections[1], description.sections[2]};
  const test::ModelArm<5, 6> arm(description);
  Kinematics<5> kin;
  ForwardKinematics<5>(arm, Vec<5>::Zero(), Vec<5>::Zero(), kin);
  const Mat6 C = LinkCompliance(arm, kin);
  const double L = 0.65;
  EXPECT_NEAR(C(2, 2), L * L * L / (3.0 * 400.0), 1e-9 * C(2, 2));
  EXPECT_NEAR(C(4, 2), -L * L / (2.0 * 400.0), 1e-9 * C(2, 2));
  EXPECT_NEAR(C(4, 4), L / 400.0, 1e-9 * C(4, 4));
  EXPECT_NEAR(C(3, 3), L / 300.0, 1e-9 * C(3, 3));
  EXPECT_NEAR(C(0, 0), L / 1e6, 1e-9 * C(0, 0));
}

TEST(SerialCompliance, AnArmWithoutSectionsBendsOnlyInItsJoints) {
  ArmDescription description = test::ArmA5();
  description.sections.clear();
  const test::ModelArm<5, 6> arm(description);
  test::Draw draw(24);
  Kinematics<5> kin;
  ForwardKinematics<5>(arm, draw.Vector<5>(3.0), Vec<5>::Zero(), kin);
  StructuralLoads<5> loads;
  AddBodyWeight(arm, kin, BodiesFor(arm, arm.p_true), loads);
  const SerialDeflections<5> serial = DeflectSerially(arm, kin, loads);
  EXPECT_EQ(serial.tip_links.AsVector().norm(), 0.0);
  const Vec<5> G = GravityTorque(BodiesFor(arm, arm.p_true), kin, arm.gravity);
  EXPECT_NEAR((serial.torque + G).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace reed::model
