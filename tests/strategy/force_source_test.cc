// The separation (Fig. 7) cycle by cycle, without an arm: who is in charge, and no jump where one takes over.
#include "reed/core/contact/force_source.h"

#include <gtest/gtest.h>

#include "reed/core/contact/normal_force.h"

namespace reed::strategy {
namespace {

using Source = SourceSetting;
constexpr double kT = 1e-3;
constexpr double kContact_N = 1.5;
const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

TEST(SourceSelector, LosesTheSensorInTheThirdCycleWithoutAFrameAndNotBefore) {
  SourceSelector source(Source::kAuto);
  EXPECT_EQ(source.Step(0, true), ForceSource::kKnown);
  EXPECT_EQ(source.Step(1, true), ForceSource::kKnown);
  EXPECT_EQ(source.Step(2, true), ForceSource::kKnown);
  EXPECT_EQ(source.Step(3, true), ForceSource::kObserver);
}

TEST(SourceSelector, WithoutAWishToPressTheUnknownForceLawTakesOver) {
  SourceSelector source(Source::kAuto);
  EXPECT_EQ(source.Step(3, false), ForceSource::kUnknown);
}

TEST(SourceSelector, ComesBackOnlyAfterAHundredSoundFramesInARow) {
  SourceSelector source(Source::kAuto);
  source.Step(3, true);
  for (int k = 1; k < SourceSelector::kReturnCycles; ++k)
    ASSERT_EQ(source.Step(0, true), ForceSource::kObserver);
  source.Step(1, true);  // one frame is missing: the count starts over
  for (int k = 1; k < SourceSelector::kReturnCycles; ++k)
    ASSERT_EQ(source.Step(0, true), ForceSource::kObserver);
  EXPECT_EQ(source.Step(0, true), ForceSource::kKnown);
}

TEST(SourceSelector, DoesWhatTheScenarioSaysInEveryOtherMode) {
  EXPECT_EQ(SourceSelector(Source::kNone).Step(0, true), ForceSource::kNone);
  EXPECT_EQ(SourceSelector(Source::kKnown).Step(50, true), ForceSource::kKnown);
  EXPECT_EQ(SourceSelector(Source::kUnknown).Step(0, false), ForceSource::kUnknown);
  EXPECT_EQ(SourceSelector(Source::kUnknown).Step(0, true), ForceSource::kObserver);
}

TEST(NormalForce, IsContinuousAtLossAndReturnAlthoughTheObserverIsOffByThreeNewton) {
  NormalForce force(kUp, kContact_N, kT);
  for (int k = 0; k < 64; ++k) force.Tare({Eigen::Vector3d(0.0, 0.0, 0.4)}, true);
  const Eigen::Vector3d read(0.0, 0.0, 8.4), observed(0.0, 0.0, 11.0);
  double before = 0.0;
  for (int k = 0; k < 1000; ++k) before = force.Step(ForceSource::kKnown, {read, kUp}, observed, true);
  EXPECT_NEAR(before, 8.0, 1e-12);
  const double lost = force.Step(ForceSource::kObserver, {read, kUp}, observed + 0.2 * kUp, true);
  EXPECT_NEAR(lost, before, 1e-9) << "what the observer sees differently is carried over";
  double held = lost;
  for (int k = 0; k < 3000; ++k)
    held = force.Step(ForceSource::kObserver, {read, kUp}, observed + 0.2 * kUp, true);
  EXPECT_NEAR(held, 8.2, 1e-3) << "and forgotten";
  EXPECT_NEAR(force.Step(ForceSource::kKnown, {read, kUp}, observed, true), held, 1e-9);
}

TEST(NormalForce, AConstantAndASaturatedReadingAreReadings) {
  NormalForce force(kUp, kContact_N, kT);
  for (int k = 0; k < 64; ++k) force.Tare({Eigen::Vector3d::Zero()}, true);
  for (int k = 0; k < 500; ++k)
    EXPECT_EQ(force.Step(ForceSource::kKnown, {200.0 * kUp, kUp}, Eigen::Vector3d::Zero(), true), 200.0);
}

TEST(NormalForce, TakesANewZeroFromFramesThatReturnToAFreeArm) {
  NormalForce force(kUp, kContact_N, kT);
  for (int k = 0; k < 64; ++k) force.Tare({1.0 * kUp}, true);
  for (int k = 1; k < SourceSelector::kReturnCycles; ++k) {
    EXPECT_NEAR(force.Step(ForceSource::kKnown, {5.0 * kUp, kUp}, Eigen::Vector3d::Zero(), false), 4.0,
                1e-12);
    force.Retare({5.0 * kUp}, k, true);
  }
  EXPECT_NEAR(force.Step(ForceSource::kKnown, {5.0 * kUp, kUp}, Eigen::Vector3d::Zero(), false), 0.0, 1e-12);
}

TEST(NormalForce, KeepsItsZeroWhenTheArmMeetsTheWallWhileFramesReturn) {
  for (const int contact_at : {2, 40, 70, 99}) {
    NormalForce force(kUp, kContact_N, kT);
    for (int k = 0; k < 64; ++k) force.Tare({1.0 * kUp}, true);
    for (int k = 1; k < SourceSelector::kReturnCycles; ++k) force.Retare({5.0 * kUp}, k, k < contact_at);
    EXPECT_NEAR(force.Step(ForceSource::kKnown, {5.0 * kUp, kUp}, Eigen::Vector3d::Zero(), false), 4.0, 1e-12)
        << contact_at;
  }
}

TEST(NormalForce, TheObserversTareFollowsTheFreeArmButNotTheRiseOfAContact) {
  NormalForce force(kUp, kContact_N, kT);
  for (int k = 0; k < 1000; ++k) force.Step(ForceSource::kUnknown, {kUp, kUp}, -4.0 * kUp, false);
  EXPECT_NEAR(force.Step(ForceSource::kObserver, {kUp, kUp}, -4.0 * kUp, false), 0.0, 1e-3);
  double f = 0.0;
  for (int k = 0; k < 100; ++k)
    f = force.Step(ForceSource::kObserver, {kUp, kUp}, (-4.0 + 0.04 * k) * kUp, false);
  EXPECT_GT(f, 3.5);
}

TEST(NormalForce, AWallThatIsMetBeforeItsTimeIsNoNewZeroOfTheObserver) {
  for (const double x_dot : {-5e-3, 0.0}) {  // a jump while the tip does not approach is a change of weight
    NormalForce force(kUp, kContact_N, kT);
    for (int k = 0; k < 1000; ++k)
      force.Step(ForceSource::kUnknown, {kUp, kUp}, -4.0 * kUp, false, x_dot * kUp);
    for (int k = 0; k < 100; ++k)
      force.Step(ForceSource::kUnknown, {kUp, kUp}, (-4.0 + 0.08 * k) * kUp, false, x_dot * kUp);
    double f = 0.0;
    for (int k = 0; k < 3000; ++k) f = force.Step(ForceSource::kUnknown, {kUp, kUp}, 4.0 * kUp, false);
    EXPECT_NEAR(f, x_dot < 0.0 ? 8.0 : 0.0, 1.0) << x_dot;
    for (int k = 0; k < 1000; ++k) f = force.Step(ForceSource::kUnknown, {kUp, kUp}, -4.0 * kUp, false);
    EXPECT_NEAR(f, 0.0, 1e-3) << "followed again when the wall is left";
  }
}

TEST(NormalForce, HoweverSlowlyTheTipMovesTheForceOfAWallIsNoNewZero) {
  constexpr double kSoft_Npm = 800.0, kDepth_m = 5e-3;
  for (const double speed : {0.3e-3, 1e-3, 3e-3, 10e-3}) {
    NormalForce force(kUp, kContact_N, kT);
    for (int k = 0; k < 1000; ++k)
      force.Step(ForceSource::kUnknown, {kUp, kUp}, -4.0 * kUp, false, -speed * kUp);
    double f = 0.0;
    for (int k = 0; k * kT * speed < kDepth_m; ++k)
      f = force.Step(ForceSource::kUnknown, {kUp, kUp}, (-4.0 + kSoft_Npm * k * kT * speed) * kUp, false,
                     -speed * kUp);
    EXPECT_NEAR(f, kSoft_Npm * kDepth_m, 0.25 * kSoft_Npm * kDepth_m + 0.5) << speed;
    EXPECT_TRUE(force.met_wall()) << speed;
  }
}

TEST(NormalForce, TheErrorOfTheWeightIsFollowedWhileTheTipApproaches) {
  constexpr double kError_Npm = 50.0;
  for (const double speed : {1e-3, 10e-3, 50e-3}) {
    NormalForce force(kUp, kContact_N, kT);
    double f = 0.0;
    for (int k = 0; k * kT * speed < 0.1; ++k)
      f = force.Step(ForceSource::kUnknown, {kUp, kUp}, (-4.0 + kError_Npm * k * kT * speed) * kUp, false,
                     -speed * kUp);
    EXPECT_FALSE(force.met_wall()) << speed;
    EXPECT_LT(f, kContact_N) << speed;
  }
}

}  // namespace
}  // namespace reed::strategy
