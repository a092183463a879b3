// Who sends, who answers, and how a controller that was away is named.
#include "reed/core/safety/watch.h"

#include <gtest/gtest.h>

namespace reed::protect {
namespace {

constexpr int kJoints = 2, kStop = 10, kAway = 4242;

LimitValues<kJoints> Wide() {
  LimitValues<kJoints> v;
  v.torque.setConstant(10.0);
  v.position_min.setConstant(-3.0);
  v.position_max.setConstant(3.0);
  v.speed.setConstant(3.0);
  v.contact_force = 60.0;
  v.stop_age = kStop;
  return v;
}

/// An arm whose drives are asked to enable, still without torque: here nothing but the age of the measurements says
/// that the controller was away.
class EnablingArm : public ::testing::Test {
 protected:
  EnablingArm() {
    mode::Observation ready{.all_fresh = true, .drives_ready = true, .tared = true};
    for (int i = 0; i < 2 * mode::Supervisor::kFreshInRow; ++i) supervisor_.Step(ready);
    measured_.drive.fill(DriveState::kReady);
    measured_.wrench_age = 0;
  }

  LimitCheck Check(int age, bool away = false) {
    measured_.age.fill(age);
    CycleState state;
    state.missed_in_row_exceeded = away;
    state.missed_in_row = away ? kAway : 0;
    return watch_.CheckState(measured_, state, supervisor_, limits_, strategy::ForceSource::kNone, 0.0);
  }

  mode::Supervisor supervisor_{true};
  Measurement<kJoints> measured_;
  Limits<kJoints> limits_{Wide()};
  Watch<kJoints> watch_{0.001};
};

TEST_F(EnablingArm, HasNothingToReportWhileItAnswers) {
  ASSERT_EQ(supervisor_.Request(), DriveRequest::kEnable);
  ASSERT_NE(supervisor_.mode(), mode::Mode::kActive);
  EXPECT_EQ(Check(0).trip, Reason::kNone);
}

TEST_F(EnablingArm, MeasurementsThatAreOldBecauseTheControllerWasAwayAreReportedAsItsMissedCycles) {
  const LimitCheck check = Check(2 * kStop + 1, true);
  EXPECT_EQ(check.trip, Reason::kMissedCycles);
  EXPECT_EQ(check.value, kAway);
  EXPECT_EQ(check.joint, -1);
}

TEST_F(EnablingArm, TheNameHoldsAsLongAsTheAbsenceIsYoungerThanTheOldestMeasurement) {
  EXPECT_EQ(Check(0, true).trip, Reason::kNone)
      << "fresh measurements: no reason to stop an arm without torque";
  for (int age = 1; age <= 2 * kStop; ++age) EXPECT_EQ(Check(age).trip, Reason::kNone) << age;
  EXPECT_EQ(Check(2 * kStop + 1).trip, Reason::kMissedCycles) << "they became old from the absence on";
}

TEST_F(EnablingArm, AnAbsenceLongAgoIsNoReason) {
  Check(0, true);
  for (int cycle = 0; cycle < 100; ++cycle) Check(0);
  const LimitCheck check = Check(2 * kStop + 1);
  EXPECT_EQ(check.trip, Reason::kStaleMeasurement);
  EXPECT_EQ(check.value, 2 * kStop + 1);
}

TEST_F(EnablingArm, WithoutAnAbsenceOldMeasurementsAreTheReason) {
  EXPECT_EQ(Check(2 * kStop + 1).trip, Reason::kStaleMeasurement);
}

}  // namespace
}  // namespace reed::protect
