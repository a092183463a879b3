// Contact on the whole loop in virtual time: what the wall feels, before, during and after the press.
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

Scenario PressKnown() { return LoadScenario("press_known"); }

/// Largest true normal force until the arm has been active this long, or stops.
double LargestForce(SilRig& rig, double until_s) {
  double largest_N = 0.0;
  if (!rig.RunActive(0.001)) return largest_N;
  while (rig.mode() == Mode::kActive && rig.snapshot().control.t_s < until_s - 0.0005) {
    rig.Run();
    largest_N = std::max(largest_N, rig.truth().normal_force);
  }
  return largest_N;
}

TEST(ContactForceLimit, JudgesWhatTheWallFeelsAndNotABiasThatHidesIt) {
  Scenario scenario = PressKnown();
  scenario.sensors.force_bias_N = {0.0, 0.0, 59.0};  // the hand points down, and with it z of the sensor
  scenario.force.desired_N = 75.0;
  SilRig rig(scenario);
  EXPECT_LT(LargestForce(rig, 2.9), 62.0);
  EXPECT_EQ(rig.trip(), Reason::kContactForce);
}

TEST(ContactForceLimit, ABiasIsNoForceOfTheWall) {
  Scenario scenario = PressKnown();
  scenario.sensors.force_bias_N = {0.0, 0.0, -55.0};
  SilRig rig(scenario);
  EXPECT_LT(LargestForce(rig, 2.9), 10.0);
  EXPECT_EQ(rig.mode(), Mode::kActive) << protect::Text(static_cast<int>(rig.trip()));
  EXPECT_NEAR(rig.truth().normal_force, 8.0, 0.5);
}

TEST(ContactForceLimit, ASensorAtTheEndOfItsRangeStopsTheArm) {
  Scenario scenario = PressKnown();
  scenario.sensors.force_bias_N = {0.0, 0.0, -100.0};
  scenario.sensors.force_range_N = 104.0;  // it can measure no more than 4 N of the wall
  SilRig rig(scenario);
  EXPECT_LT(LargestForce(rig, 2.9), 10.0);
  EXPECT_EQ(rig.trip(), Reason::kWrenchRange);
}

TEST(ContactForceLimit, ASensorAtTheEndOfItsRangeIsNoZero) {
  Scenario scenario = PressKnown();
  scenario.sensors.force_bias_N = {0.0, 0.0, 100.0};
  scenario.sensors.force_range_N = 90.0;
  SilRig rig(scenario);
  EXPECT_FALSE(rig.RunActive(0.001));
  EXPECT_EQ(rig.trip(), Reason::kWrenchRange) << "before the brakes open";
  EXPECT_EQ(rig.trip_place().value, 90.0);
  EXPECT_FALSE(SilRig(scenario, false).RunActive(0.001)) << "an arm that shall not start waits";
}

Scenario PressWithTurnedSensor() {
  Scenario scenario = PressKnown();
  scenario.arm.force_sensor.xyz_m = {0.0, 0.05, -0.06};
  scenario.arm.force_sensor.rpy_rad = {0.4, -1.1, 2.0};
  return scenario;
}

TEST(TurnedSensor, PressesAsOneThatIsFlushWithTheTool) {
  const auto exact = [](Scenario scenario) {
    scenario.sensors.force_noise_N = scenario.sensors.force_quantum_N = 0.0;
    return scenario;
  };
  SilRig turned(exact(PressWithTurnedSensor())), flush(exact(PressKnown()));
  ASSERT_TRUE(turned.RunActive(0.5) && flush.RunActive(0.5));
  double largest_moment = 0.0;
  for (int k = 0; k < 1500; ++k) {
    turned.Run();
    flush.Run();
    ASSERT_NEAR(turned.truth().normal_force, flush.truth().normal_force, 1e-3);
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      ASSERT_NEAR(turned.snapshot().control.tip_force[i], flush.snapshot().control.tip_force[i], 1e-3);
      largest_moment = std::max(largest_moment, std::abs(turned.snapshot().measured.moment[i]));
    }
  }
  EXPECT_GT(flush.truth().normal_force, 7.0);
  EXPECT_GT(largest_moment, 0.3) << "8 N, 0.05 m beside the tool point";
}

TEST(TurnedSensor, WithAToolBehindItAndABiasMeasuresWhatTheWallFeels) {
  Scenario scenario = PressWithTurnedSensor();
  scenario.arm.force_sensor.tool_mass_kg = 0.5;
  scenario.arm.force_sensor.tool_com_m = {0.01, 0.0, 0.03};
  scenario.sensors.force_bias_N = {3.0, -2.0, 4.0};
  scenario.sensors.moment_bias_Nm = {0.2, 0.1, -0.3};
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(2.0));
  double square_sum = 0.0;
  for (int k = 0; k < 990; ++k) {
    rig.Run();
    square_sum += std::pow(rig.truth().normal_force - rig.snapshot().control.f_d, 2);
  }
  EXPECT_LT(std::sqrt(square_sum / 990), 0.03 * 8.0);
}

TEST(HangingArm, PressesWithItsBaseTurned) {
  Scenario scenario = PressKnown();
  scenario.arm.base.xyz_m = {0.0, 0.0, 2.0};
  scenario.arm.base.rpy_rad = {3.141592653589793, 0.0, 0.0};  // y and z point the other way
  scenario.wall.point_m = Eigen::Vector3d(0.0, 0.0, 2.0) +
                          scenario.arm.base.rotation() * LoadScenario("press_known").wall.point_m;
  scenario.wall.normal = scenario.arm.base.rotation() * scenario.wall.normal;
  for (ReferenceLeg& leg : scenario.reference.legs) {
    leg.by_m = scenario.arm.base.rotation() * leg.by_m;
    leg.amplitude_m = scenario.arm.base.rotation() * leg.amplitude_m;
  }
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(2.9));
  EXPECT_NEAR(rig.truth().normal_force, 8.0, 0.4);
}

TEST(ContactForceLimit, HoldsForTheObservedForceToo) {
  Scenario scenario = LoadScenario("press_no_sensor");
  scenario.force.desired_N = 75.0;
  SilRig rig(scenario);
  EXPECT_LT(LargestForce(rig, 3.9), 70.0);
  EXPECT_EQ(rig.trip(), Reason::kContactForce);
}

ReferenceLeg Lift(double by_m, double duration_s) {
  ReferenceLeg leg;
  leg.kind = ReferenceLeg::Kind::kCartesian;
  leg.duration_s = duration_s;
  leg.by_m = {0.0, 0.0, by_m};
  return leg;
}

ReferenceLeg Hold(double duration_s) {
  ReferenceLeg leg;
  leg.duration_s = duration_s;
  return leg;
}

TEST(EndOfAPress, LeavesNoForceOnAWallThatThePathLeadsInto) {
  Scenario scenario = PressKnown();
  scenario.duration_s = 4.0;
  scenario.force.end_s = 1.5;
  scenario.wall.offset_m = 0.002;
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(2.5));
  EXPECT_LT(LargestForce(rig, 3.9), 1.0);
  EXPECT_EQ(rig.mode(), Mode::kActive);
  EXPECT_GT(rig.truth().gap, -0.2e-3);
  EXPECT_LT(rig.truth().gap, 1.5e-3) << "and does not float away";
}

TEST(EndOfAPress, LeavesNoForceWithoutASensorEither) {
  Scenario scenario = LoadScenario("press_no_sensor");
  scenario.force.end_s = 1.5;
  scenario.wall.offset_m = 0.002;
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(2.5));
  EXPECT_LT(LargestForce(rig, 3.9), 2.0);
  EXPECT_EQ(rig.mode(), Mode::kActive);
}

TEST(EndOfAPress, LetsTheArmFollowAPathThatLeavesTheWall) {
  Scenario scenario = PressKnown();
  scenario.force.end_s = 1.0;
  scenario.reference.legs[1] = Hold(1.4);
  scenario.reference.legs.push_back(Lift(0.02, 0.5));
  scenario.reference.legs.push_back(Hold(60.0));
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(2.8));
  EXPECT_NEAR(rig.truth().tip[2], 0.156 + 0.02, 1e-3);
}

/// How long the approach of 4 mm takes, s; the wall is met after 1.5 mm.
class WallBeforeItsTime : public ::testing::TestWithParam<double> {};

TEST_P(WallBeforeItsTime, IsNoZeroOfTheObserver) {
  Scenario scenario = LoadScenario("press_no_sensor");
  scenario.reference.legs[0].duration_s = GetParam();
  scenario.force.start_s = GetParam() + 0.6;
  scenario.duration_s = GetParam() + 4.0;
  scenario.wall.offset_m = 0.0025;
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(GetParam() + 2.6));
  double sum_N = 0.0, known_N = 0.0;
  for (int k = 0; k < 900; ++k) {
    rig.Run();
    sum_N += rig.truth().normal_force / 900;
    known_N += rig.snapshot().control.f / 900;
  }
  EXPECT_NEAR(known_N, 8.0, 0.8);
  EXPECT_NEAR(sum_N, 8.0, 1.0);
}
INSTANTIATE_TEST_SUITE_P(Approach, WallBeforeItsTime, ::testing::Values(0.4, 2.0, 8.0));

bool Noted(const SilRig& rig, Reason reason, double least) {
  for (int i = 0; i < rig.snapshot().num_events; ++i) {
    const telemetry::Event& event = rig.snapshot().events[static_cast<std::size_t>(i)];
    if (event.code == static_cast<int>(reason) && event.value >= least) return true;
  }
  return false;
}

TEST(StartAtAWall, AZeroThatIsMoreThanNoiseIsSaid) {
  for (const double offset_m : {-0.001, 0.005}) {
    Scenario scenario = PressKnown();
    scenario.wall.offset_m = offset_m;  // 5 mm: the arm starts 1 mm inside
    SilRig rig(scenario);
    while (rig.mode() != Mode::kActive && rig.cycle_number() < 1000) rig.Run();
    EXPECT_EQ(Noted(rig, Reason::kForceZero, 5.0), offset_m > 0.0);
    EXPECT_EQ(Noted(rig, Reason::kForceZero, 0.0), offset_m > 0.0);
  }
}

TEST(StartAtAWall, BehindTheBelievedOneIsRefused) {
  Scenario scenario = PressKnown();
  scenario.wall.normal = {0.0, 0.0, -1.0};
  EXPECT_THAT(Refusal(scenario), ::testing::HasSubstr("reference.start_rad: the tool point starts 4.000 mm"));
  scenario = PressKnown();
  scenario.wall.point_m[2] += 0.003999;
  EXPECT_EQ(Refusal(scenario), "accepted");
}

}  // namespace
}  // namespace reed
