// Arms and sensors that are not press_known's, on the whole loop in virtual time: nearly stretched, heavy, rough,
// coarse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "reed/tests/firmware/sil_rig.h"

namespace reed {
namespace {

using mode::Mode;
using protect::Reason;
using test::Refusal;
using test::SilRig;

/// p2, nearly stretched, seeks a wall ahead that is not there.
Scenario StretchSeek() {
  Scenario scenario = LoadScenario("joints2");
  scenario.duration_s = 12.0;
  scenario.reference.start_rad = {0.3, -0.65};
  scenario.reference.legs.resize(1);
  scenario.reference.legs[0] = ReferenceLeg{};
  scenario.reference.legs[0].duration_s = 60.0;
  scenario.wall.present = true;
  scenario.wall.point_m = {0.865, 0.0, 0.0};
  scenario.wall.normal = {-1.0, 0.0, 0.0};
  scenario.wall.offset_m = -0.1;
  scenario.force.source = ForceConfig::Source::kKnown;
  scenario.force.desired_N = 8.0;
  scenario.force.start_s = 0.3;
  scenario.force.ramp_s = 0.5;
  return scenario;
}

TEST(StretchedArm, SlowsDownAndIsHeldBeforeAnythingIsFast) {
  SilRig rig(StretchSeek());
  ASSERT_TRUE(rig.RunActive(0.001));
  double fastest = 0.0, torque_step = 0.0, torque_before = rig.snapshot().control.tau[0];
  bool held = false;
  while (rig.mode() == Mode::kActive && rig.snapshot().control.t_s < 11.9) {
    rig.Run();
    for (const double speed : rig.truth().motor_speed) fastest = std::max(fastest, std::abs(speed));
    torque_step = std::max(torque_step, std::abs(rig.snapshot().control.tau[0] - torque_before));
    torque_before = rig.snapshot().control.tau[0];
    held = held || rig.LimitActs(Reason::kStretch);
  }
  EXPECT_EQ(rig.mode(), Mode::kActive) << protect::Text(static_cast<int>(rig.trip()));
  EXPECT_TRUE(held);
  EXPECT_LT(fastest, 1.2) << "0.3 of the speed limit";
  EXPECT_LT(torque_step, 4.0) << "a tenth of the torque limit";
}

TEST(StretchedArm, MeetsAWallThatIsJustWithinReach) {
  Scenario scenario = StretchSeek();
  scenario.wall.offset_m = -0.02;  // 0.885 m ahead of 0.9 m
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(11.5));
  EXPECT_NEAR(rig.truth().normal_force, 8.0, 1.0);
}

TEST(StretchedArm, IsNotAskedToPressFromAStraightStart) {
  Scenario scenario = StretchSeek();
  scenario.reference.start_rad = {0.0, 0.0};
  scenario.wall.point_m = {0.9, 0.0, 0.0};
  scenario.wall.offset_m = 0.0;
  EXPECT_THAT(Refusal(scenario), ::testing::HasSubstr("cannot move along wall.normal"));
  scenario.reference.start_rad = {0.01, -0.02};
  scenario.wall.point_m = {0.91, 0.0, 0.0};
  EXPECT_THAT(Refusal(scenario), ::testing::HasSubstr("allowed: up to 55.5 rad/m"));
}

TEST(StretchedArm, ThatTouchesAWallWhereItCannotPressStopsWithAReasonOfItsOwn) {
  Scenario scenario = StretchSeek();
  ReferenceLeg out;
  out.kind = ReferenceLeg::Kind::kJoint;
  out.duration_s = 1.0;
  out.to_rad = {0.0, 0.0};
  ReferenceLeg back = out;
  back.to_rad = scenario.reference.start_rad;
  scenario.reference.legs.insert(scenario.reference.legs.begin(), {out, back});
  scenario.wall.point_m = {0.91, 0.0, 0.0};
  scenario.wall.offset_m = 0.0102;  // in truth 0.2 mm before the end of its reach
  scenario.force.start_s = 2.5;
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(0.001));
  double fastest = 0.0;
  while (rig.mode() == Mode::kActive && rig.snapshot().control.t_s < 3.0) {
    rig.Run();
    for (const double speed : rig.truth().motor_speed) fastest = std::max(fastest, std::abs(speed));
  }
  EXPECT_EQ(rig.trip(), Reason::kStretched) << protect::Text(static_cast<int>(rig.trip()));
  EXPECT_TRUE(rig.TorqueIsZero());
  EXPECT_LT(fastest, 2.0) << "half of the speed limit";
}

/// An industrial arm's two big axes, as far as the bus can carry their torques.
Scenario HeavyArm() {
  Scenario scenario = LoadScenario("joints2");
  scenario.duration_s = 1.0;
  ArmDescription& arm = scenario.arm;
  arm.joints = JointsOf({{1.5707963267948966, 0.0, 0.0}, {0.0, 1.2, 0.0}});
  arm.tool.xyz_m = {1.0, 0.0, 0.0};
  arm.rotor_inertia_kgm2 = {40.0, 30.0};
  arm.joint_stiffness_Nmprad = {2e6, 1e6};
  arm.coulomb_Nm.clear();
  arm.coulomb_declared_Nm.clear();
  arm.torque_limit_Nm = {2000.0, 1000.0};
  arm.speed_limit_radps = {2.0, 2.0};
  arm.bodies[0] = {75.0, {0.6, 0.0, 0.0}, Eigen::Vector3d(0.25, 9.0, 9.0).asDiagonal()};
  arm.bodies[1] = {50.0, {0.5, 0.0, 0.0}, Eigen::Vector3d(0.25, 4.25, 4.25).asDiagonal()};
  arm.sections.clear();
  scenario.plant.flexible_links = false;
  scenario.reference.start_rad = {0.0, 0.0};
  scenario.reference.legs.resize(1);
  scenario.reference.legs[0] = ReferenceLeg{};
  scenario.reference.legs[0].duration_s = 60.0;
  scenario.control.K_d = {4000.0, 2500.0};
  scenario.control.Lambda = {10.0, 10.0};
  return scenario;
}

/// Largest way of a joint from its start in the first half second, rad.
double Sag(const Scenario& scenario) {
  SilRig rig(scenario);
  double sag = 0.0;
  for (int k = 0; k < 650; ++k) {
    rig.Run();
    for (std::size_t i = 0; i < scenario.reference.start_rad.size(); ++i)
      sag = std::max(sag, std::abs(rig.truth().motor_angle[i] - scenario.reference.start_rad[i]));
  }
  EXPECT_EQ(rig.mode(), Mode::kActive);
  return sag;
}

TEST(HeavyArm, DoesNotSagWhenItsDrivesAreEnabled) {
  const double relative = Sag(HeavyArm());
  Scenario absolute = HeavyArm();
  absolute.limits.torque_rate_Nmps = 20000.0;  // what holds an arm of 40 N·m
  absolute.limits.monitors = false;            // they stop an arm that sags
  EXPECT_LT(relative, 1e-3);
  EXPECT_GT(Sag(absolute), 5.0 * relative) << "the key still does what it says";
}

TEST(RoughArm, LearnsTheFrictionThatItDeclares) {
  Scenario scenario = LoadScenario("press_no_sensor");
  scenario.arm.coulomb_Nm = {4.0, 4.0, 2.5, 1.2, 0.8};  // a tenth of the torque limits
  scenario.arm.coulomb_declared_Nm = scenario.arm.coulomb_Nm;
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(3.0));
  double square_sum = 0.0;
  for (int k = 0; k < 990; ++k) {
    rig.Run();
    square_sum += std::pow(rig.truth().normal_force - rig.snapshot().control.f_d, 2);
  }
  EXPECT_LT(std::sqrt(square_sum / 990), 0.12 * 8.0) << "the limit of the scenario";
}

TEST(RoughArm, FollowsAFreePathAsASmoothOneWhereItsFrictionIsKnown) {
  Scenario scenario = LoadScenario("free_motion");
  scenario.arm.coulomb_Nm = {4.0, 4.0, 2.5, 1.2, 0.8};
  scenario.arm.coulomb_declared_Nm = scenario.arm.coulomb_Nm;
  scenario.control.coulomb_known = 1.0;
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(2.0));
  double square_sum = 0.0;
  for (int k = 0; k < 990; ++k) {
    rig.Run();
    for (std::size_t i = 0; i < 3; ++i)
      square_sum += std::pow(rig.truth().tip[i] - rig.snapshot().control.tip_plan[i], 2);
  }
  EXPECT_LT(std::sqrt(square_sum / 990), 0.2e-3);
}

TEST(CoarseEncoder, ThatIsStillAcceptedSeeksTheWall) {
  Scenario scenario = LoadScenario("press_known", LoadOptions{"", {"sensors.encoder_bits=15"}});
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(2.9));
  EXPECT_NEAR(rig.truth().normal_force, 8.0, 1.0);
}

TEST(CoarseEncoder, ThatShakesTheTorqueIsRefusedWithTheFigure) {
  try {
    LoadScenario("press_known", LoadOptions{"", {"sensors.encoder_bits=12"}});
    FAIL() << "accepted";
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("sensors.encoder_bits"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("joint 1"));
  }
}

}  // namespace
}  // namespace reed
