// Contact on the whole loop in virtual time: what the wall feels, before, during and after the press.
#include <gtest/gtest.h>

#include <cmath>

#include "reed/tests/firmware/sil_rig.h"

namespace reed {
namespace {

using mode::Mode;
using protect::Reason;
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
  scenario.sensors.force_bias_N = {0.0, 0.0, -59.0};
  scenario.force.desired_N = 75.0;
  SilRig rig(scenario);
  EXPECT_LT(LargestForce(rig, 2.9), 62.0);
  EXPECT_EQ(rig.trip(), Reason::kContactForce);
}

TEST(ContactForceLimit, ABiasIsNoForceOfTheWall) {
  Scenario scenario = PressKnown();
  scenario.sensors.force_bias_N = {0.0, 0.0, 55.0};
  SilRig rig(scenario);
  EXPECT_LT(LargestForce(rig, 2.9), 10.0);
  EXPECT_EQ(rig.mode(), Mode::kActive) << protect::Text(static_cast<int>(rig.trip()));
  EXPECT_NEAR(rig.truth().normal_force, 8.0, 0.5);
}

TEST(ContactForceLimit, ASensorAtTheEndOfItsRangeStopsTheArm) {
  Scenario scenario = PressKnown();
  scenario.sensors.force_bias_N = {0.0, 0.0, 100.0};
  scenario.sensors.force_range_N = 104.0;  // it can measure no more than 4 N of the wall
  SilRig rig(scenario);
  EXPECT_LT(LargestForce(rig, 2.9), 10.0);
  EXPECT_EQ(rig.trip(), Reason::kWrenchRange);
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

TEST(WallBeforeItsTime, IsNoZeroOfTheObserver) {
  Scenario scenario = LoadScenario("press_no_sensor");
  scenario.force.start_s = 1.0;
  scenario.wall.offset_m = 0.0025;
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(3.0));
  double sum_N = 0.0, known_N = 0.0;
  for (int k = 0; k < 900; ++k) {
    rig.Run();
    sum_N += rig.truth().normal_force / 900;
    known_N += rig.snapshot().control.f / 900;
  }
  EXPECT_NEAR(known_N, 8.0, 0.8);
  EXPECT_NEAR(sum_N, 8.0, 1.0);
}

}  // namespace
}  // namespace reed
