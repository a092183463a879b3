#include "reed/firmware/setup/arm_model.h"

#include <gtest/gtest.h>

#include "reed/core/model/dynamics.h"
#include "reed/tests/model/states.h"

namespace reed::model {
namespace {

TEST(ArmModel, ParametersAtTheirTruthGiveTheBodiesBack) {
  const ArmDescription description = test::SkewArm();
  const test::ModelArm<6, 4> arm(description);
  const Bodies<6> bodies = BodiesFor(arm, arm.p_true);
  for (int b = 0; b < 6; ++b) {
    const InertialBody& body = description.bodies[static_cast<std::size_t>(b)];
    EXPECT_NEAR(bodies.link[b].m, body.mass_kg, 1e-14);
    EXPECT_NEAR((bodies.link[b].h - body.mass_kg * body.com_m).norm(), 0.0, 1e-14);
    // Steiner, about the link origin, from the second moment.
    const Eigen::Matrix3d about_origin =
        body.inertia_com_kgm2 + body.mass_kg * (body.com_m.squaredNorm() * Eigen::Matrix3d::Identity() -
                                                body.com_m * body.com_m.transpose());
    const Eigen::Matrix3d J = bodies.link[b].J;
    EXPECT_NEAR((J.trace() * Eigen::Matrix3d::Identity() - J - about_origin).norm(), 0.0, 1e-14);
  }
}

TEST(ArmModel, NothingIsLeftOfABodyThatItsParametersExplain) {
  const test::ModelArm<5, 6> arm(test::ArmA5());
  for (int j = 0; j < arm.first_shape[5]; ++j) EXPECT_LT(arm.shape[j].k, 6) << "link shape " << j;
}

TEST(ArmModel, ColumnsBeyondTheDescribedParametersStayZero) {
  const test::ModelArm<6, 4> arm(test::SkewArm());
  EXPECT_EQ(arm.num_parameters, 3);
  EXPECT_TRUE(arm.viscous.col(3).isZero(0.0));
  EXPECT_EQ(arm.p_true(3), 0.0);
}

TEST(ArmModel, MembersFollowTheChainWithTheirSigns) {
  const test::ModelArm<6, 4> arm(test::SkewArm());
  ASSERT_EQ(arm.num_members, 7);
  EXPECT_EQ(arm.member[0].t, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(arm.member[1].t, Eigen::Vector3d::UnitX());
  EXPECT_EQ(arm.member[2].link, 1);
  EXPECT_EQ(arm.member[2].t, -Eigen::Vector3d::UnitZ());
  EXPECT_EQ(arm.carrier[1], 3);   // a = 0.3 is longer than d = -0.05
  EXPECT_EQ(arm.carrier[4], -1);  // neither d nor a
}

TEST(ArmModel, RefusesMoreMembersThanItHasRoomFor) {
  ArmDescription arm = test::ArmA5();
  arm.sections.clear();
  FlexibleMember member{0, {0.0, 0.0, 0.0}, {0.1, 0.2, 0.3}, {0.0, 0.0, 0.0}, 1e7, 900.0, 500.0, 700.0, 0.0};
  arm.members.assign(10, member);
  EXPECT_EQ((test::ModelArm<5, 6>(arm)).num_members, 10);
  arm.members.push_back(member);
  EXPECT_THROW((test::ModelArm<5, 6>(arm)), std::invalid_argument);
}

TEST(ArmModel, RefusesADescriptionOfAnotherSize) {
  EXPECT_THROW((test::ModelArm<6, 6>(test::ArmA5())), std::invalid_argument);
  EXPECT_THROW((test::ModelArm<5, 5>(test::ArmA5())), std::invalid_argument);
  ArmDescription arm = test::ArmA5();
  arm.sections.pop_back();
  EXPECT_THROW((test::ModelArm<5, 6>(arm)), std::invalid_argument);
  arm = test::ArmA5();
  arm.sections[1].length_m = 0.36;
  EXPECT_THROW((test::ModelArm<5, 6>(arm)), std::invalid_argument);
  arm = test::ArmA5();
  arm.bodies.pop_back();
  EXPECT_THROW((test::ModelArm<5, 6>(arm)), std::invalid_argument);
  arm = test::ArmA5();
  arm.torque_limit_Nm.pop_back();
  EXPECT_THROW((test::ModelArm<5, 6>(arm)), std::invalid_argument);
}

}  // namespace
}  // namespace reed::model
