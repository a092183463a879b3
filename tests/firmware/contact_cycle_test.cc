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
