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

/// An arm that shall start: first off, then ready.
class WaitingArm : public ::testing::Test {
 protected:
  WaitingArm() {
    measured_.drive.fill(DriveState::kReady);
    measured_.wrench_age = 0;
  }

  /// What is reported in the cycle of that number, everything the same until then.
  LimitCheck After(int cycles) {
    LimitCheck check;
    for (int cycle = 0; cycle < cycles && check.trip == Reason::kNone; ++cycle) {
      check = start_.Check(measured_, supervisor_);
      supervisor_.Step({.all_fresh = measured_.OldestAge() == 0,
                        .drives_ready = measured_.AllDrives(DriveState::kReady),
                        .drives_braked = measured_.AnyDrive(DriveState::kBraked),
                        .tared = tared_});
    }
    return check;
  }

  static void ExpectDrive2(const LimitCheck& check, DriveState state) {
    EXPECT_EQ(check.trip, Reason::kDriveFault);
    EXPECT_EQ(check.joint, 1);
    EXPECT_EQ(check.value, static_cast<double>(state));
  }

  static constexpr int kPatience = 2000;
  mode::Supervisor supervisor_{true};
  Measurement<kJoints> measured_;
  bool tared_ = true;
  StartWatch<kJoints> start_{0.001};
};

TEST_F(WaitingArm, IsGivenNoReasonWhenItStarts) {
  EXPECT_EQ(After(3 * kPatience).trip, Reason::kNone);
  EXPECT_EQ(supervisor_.Request(), DriveRequest::kEnable);
}

TEST_F(WaitingArm, WaitsForAnArmThatDoesNotAnswerAtAll) {
  measured_.age.fill(Measurement<kJoints>::kNever);
  EXPECT_EQ(After(3 * kPatience).trip, Reason::kNone);
}

TEST_F(WaitingArm, NamesTheJointThatNeverAnswers) {
  measured_.age = {0, Measurement<kJoints>::kNever};
  EXPECT_EQ(After(kPatience).trip, Reason::kNone);
  const LimitCheck check = After(1);
  EXPECT_EQ(check.trip, Reason::kStaleMeasurement);
  EXPECT_EQ(check.joint, 1);
}

TEST_F(WaitingArm, NamesTheJointThatIsAlwaysLate) {
  measured_.age = {3, 0};
  const LimitCheck check = After(kPatience + 1);
  EXPECT_EQ(check.trip, Reason::kStaleMeasurement);
  EXPECT_EQ(check.joint, 0);
  EXPECT_EQ(check.value, 3);
}

TEST_F(WaitingArm, ADriveInFaultIsReportedAtOnceBeforeTheArmHasStarted) {
  measured_.drive = {DriveState::kReady, DriveState::kFault};
  const LimitCheck check = After(mode::Supervisor::kFreshInRow + 1);
  ExpectDrive2(check, DriveState::kFault);
}

TEST_F(WaitingArm, NamesTheDriveThatDoesNotGetReady) {
  measured_.drive = {DriveState::kReady, DriveState::kOff};
  const LimitCheck check = After(kPatience + 1);
  ExpectDrive2(check, DriveState::kOff);
}

TEST_F(WaitingArm, NamesTheDriveThatStaysBraked) {
  measured_.drive = {DriveState::kOff, DriveState::kBraked};
  const LimitCheck check = After(kPatience + 1);
  ExpectDrive2(check, DriveState::kBraked);
}

TEST_F(WaitingArm, SaysThatTheForceSensorsZeroIsMissing) {
  tared_ = false;
  measured_.wrench_age = 700;
  const LimitCheck check = After(kPatience + 1);
  EXPECT_EQ(check.trip, Reason::kStaleWrench);
  EXPECT_EQ(check.value, 700);
}

TEST_F(WaitingArm, IsOnlyWatchedWhereNobodyWantsItToStart) {
  supervisor_ = mode::Supervisor(false);
  measured_.drive.fill(DriveState::kFault);
  measured_.age = {3, 0};
  EXPECT_EQ(After(3 * kPatience).trip, Reason::kNone);
}

}  // namespace
}  // namespace reed::protect
