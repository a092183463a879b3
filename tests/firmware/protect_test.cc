// The last gate before the bus, limit by limit.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "reed/core/safety/limits.h"
#include "reed/core/safety/reason.h"

namespace reed::protect {
namespace {

using Vec2 = Vec<2>;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr int kHold = 2, kStop = 10;

LimitValues<2> Values() {
  LimitValues<2> v;
  v.torque << 40.0, 8.0;
  v.torque_step.setConstant(5.0);
  v.position_min << -1.0, -2.0;
  v.position_max << 1.5, 2.5;
  v.speed << 3.0, 4.0;
  v.contact_force = 60.0;
  v.hold_age = kHold;
  v.stop_age = kStop;
  return v;
}

struct Gate {
  Limits<2> limits{Values()};
  LimitCheck check;

  Vec2 Apply(double tau_1, double tau_2, int age = 0) {
    check = {};
    return limits.Apply(Vec2(tau_1, tau_2), age, check);
  }
  /// Fresh cycles until the rate limit no longer matters.
  void Reach(double tau_1, double tau_2) {
    for (int i = 0; i < 20; ++i) Apply(tau_1, tau_2);
  }
  bool Acts(Reason reason) const { return (check.limits & LimitBit(reason)) != 0; }
  LimitCheck CheckState(double q_1, double q_2, double qd_1 = 0.0, double qd_2 = 0.0, double force = 0.0,
                        int age = 0) const {
    return limits.CheckState(Vec2(q_1, q_2), Vec2(qd_1, qd_2), force, age, 1);
  }
};

TEST(Protect, ATorqueInsideEveryLimitPassesUnchanged) {
  Gate gate;
  EXPECT_EQ(gate.Apply(3.0, -4.0), Vec2(3.0, -4.0));
  EXPECT_EQ(gate.check.limits, 0);
  EXPECT_EQ(gate.check.trip, Reason::kNone);
}

TEST(Protect, TorqueIsCutToEachJointsOwnLimit) {
  Gate gate;
  gate.Reach(100.0, -100.0);
  EXPECT_LT((gate.Apply(100.0, -100.0) - Vec2(40.0, -8.0)).norm(), 1e-12);
  EXPECT_TRUE(gate.Acts(Reason::kTorque));
  EXPECT_EQ(gate.check.trip, Reason::kNone);
}

TEST(Protect, TorqueChangesByAtMostOneStepPerCycleUpAndDown) {
  Gate gate;
  double before = 0.0;
  for (const double wanted : {23.0, 23.0, 23.0, 23.0, 23.0, -23.0, -23.0}) {
    const double tau = gate.Apply(wanted, 0.0)[0];
    EXPECT_LE(std::abs(tau - before), 5.0 + 1e-12);
    before = tau;
  }
  EXPECT_DOUBLE_EQ(before, 13.0);  // 23 reached after 5 cycles, then twice one step back
  EXPECT_TRUE(gate.Acts(Reason::kTorqueRate));
}

TEST(Protect, AfterAReleaseTheTorqueClimbsFromZeroAgain) {
  Gate gate;
  gate.Reach(30.0, 6.0);
  EXPECT_EQ(gate.limits.Release(), Vec2(0.0, 0.0));
  EXPECT_EQ(gate.Apply(30.0, 6.0), Vec2(5.0, 5.0));
}

TEST(Protect, ALawThatIsNotFiniteTripsWithTorqueZeroWhateverTheAge) {
  for (const double bad : {kNaN, kInf, -kInf}) {
    for (const int age : {0, kHold + 1, kStop + 1}) {
      Gate gate;
      gate.Reach(30.0, 6.0);
      EXPECT_EQ(gate.Apply(1.0, bad, age), Vec2(0.0, 0.0));
      EXPECT_EQ(gate.check.trip, Reason::kNotFinite);
      EXPECT_EQ(gate.check.joint, 1);
    }
  }
}

TEST(Protect, MeasurementsUpToTheHoldAgeAreUsedAsTheyAre) {
  for (int age = 0; age <= kHold; ++age) {
    Gate gate;
    gate.Reach(20.0, 0.0);
    EXPECT_EQ(gate.Apply(17.0, 1.0, age), Vec2(17.0, 1.0));
    EXPECT_FALSE(gate.Acts(Reason::kHeldMeasurement));
  }
}

TEST(Protect, BeyondTheHoldAgeTheLastTorqueStays) {
  Gate gate;
  gate.Reach(20.0, 4.0);
  for (int age = 1; age <= kStop; ++age) {
    const Vec2 tau = gate.Apply(20.0 + age, 4.0, age);
    EXPECT_EQ(gate.Acts(Reason::kHeldMeasurement), age > kHold);
    EXPECT_DOUBLE_EQ(tau[0], 20.0 + std::min(age, kHold));
  }
}

TEST(Protect, ATorqueIsNotHeldForEverWhereEveryMeasurementComesLate) {
  Gate gate;
  gate.Reach(20.0, 4.0);
  for (int cycle = 1; cycle <= 2 * kStop; ++cycle) {
    EXPECT_EQ(gate.Apply(1.0, 1.0, kHold + 1), Vec2(20.0, 4.0)) << cycle;
    EXPECT_EQ(gate.check.trip, Reason::kNone);
  }
  EXPECT_EQ(gate.Apply(1.0, 1.0, kHold + 1), Vec2(0.0, 0.0));
  EXPECT_EQ(gate.check.trip, Reason::kStaleMeasurement);
  EXPECT_EQ(gate.check.value, kHold + 1);

  Gate sometimes;
  for (int cycle = 0; cycle < 10 * kStop; ++cycle) {
    sometimes.Apply(1.0, 1.0, cycle % kStop == 0 ? 0 : kHold + 1);
    EXPECT_EQ(sometimes.check.trip, Reason::kNone) << cycle;
  }
}

TEST(Protect, BeyondTheStopAgeTheTorqueFallsInEqualStepsToZeroAtTwiceTheStopAge) {
  Gate gate;
  gate.Reach(20.0, -4.0);
  for (int age = 1; age <= kStop; ++age) gate.Apply(20.0, -4.0, age);
  for (int age = kStop + 1; age <= 2 * kStop; ++age) {
    const double left = (2.0 * kStop - age) / kStop;
    EXPECT_LT((gate.Apply(33.0, 33.0, age) - left * Vec2(20.0, -4.0)).norm(), 1e-12) << "age " << age;
    EXPECT_TRUE(gate.Acts(Reason::kRampDown));
    EXPECT_EQ(gate.CheckState(0, 0, 0, 0, 0, age).trip, Reason::kNone);
  }
  const LimitCheck check = gate.CheckState(0, 0, 0, 0, 0, 2 * kStop + 1);
  EXPECT_EQ(check.trip, Reason::kStaleMeasurement);
  EXPECT_EQ(check.joint, 1);
  EXPECT_EQ(check.value, 2 * kStop + 1);
}

TEST(Protect, FreshMeasurementsEndHoldAndRampAtTheTorqueRate) {
  Gate gate;
  gate.Reach(20.0, 0.0);
  for (int age = 1; age <= kStop + 5; ++age) gate.Apply(20.0, 0.0, age);
  EXPECT_DOUBLE_EQ(gate.Apply(20.0, 0.0, 0)[0], 10.0 + 5.0);
}

TEST(Protect, EveryJointTripsAtBothEndsOfItsOwnRange) {
  const Gate gate;
  EXPECT_EQ(gate.CheckState(1.5, 2.5).trip, Reason::kNone);
  EXPECT_EQ(gate.CheckState(-1.0, -2.0).trip, Reason::kNone);
  const struct {
    double q_1, q_2;
    int joint;
  } outside[] = {{1.5001, 0, 0},  {-1.0001, 0, 0}, {0, 2.5001, 1},
                 {0, -2.0001, 1}, {kNaN, 0, 0},    {0, kNaN, 1}};
  for (const auto& at : outside) {
    const LimitCheck check = gate.CheckState(at.q_1, at.q_2);
    EXPECT_EQ(check.trip, Reason::kJointPosition);
    EXPECT_EQ(check.joint, at.joint);
  }
  EXPECT_EQ(gate.CheckState(1.6, 0).value, 1.6);
}

TEST(Protect, EveryJointTripsAtItsOwnSpeedInBothDirections) {
  const Gate gate;
  EXPECT_EQ(gate.CheckState(0, 0, 3.0, -4.0).trip, Reason::kNone);
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(gate.CheckState(0, 0, 3.001 * sign, 0).trip, Reason::kJointSpeed);
    EXPECT_EQ(gate.CheckState(0, 0, 0, 4.001 * sign).joint, 1);
  }
  EXPECT_EQ(gate.CheckState(0, 0, kNaN, 0).trip, Reason::kJointSpeed);
}

TEST(Protect, TheContactForceTripsAboveItsLimitAndWhenItIsNoNumber) {
  const Gate gate;
  EXPECT_EQ(gate.CheckState(0, 0, 0, 0, 60.0).trip, Reason::kNone);
  EXPECT_EQ(gate.CheckState(0, 0, 0, 0, 60.1).trip, Reason::kContactForce);
  EXPECT_EQ(gate.CheckState(0, 0, 0, 0, kNaN).trip, Reason::kContactForce);
}

// Logs outlive versions: these numbers are promises.
TEST(Reason, NumbersAreFixedForEver) {
  const std::pair<Reason, int> numbers[] = {{Reason::kNone, 0},
                                            {Reason::kModeChange, 1},
                                            {Reason::kForceSourceChange, 2},
                                            {Reason::kContact, 3},
                                            {Reason::kDriveState, 4},
                                            {Reason::kJointPosition, 32},
                                            {Reason::kJointSpeed, 33},
                                            {Reason::kContactForce, 34},
                                            {Reason::kNotFinite, 35},
                                            {Reason::kStaleMeasurement, 36},
                                            {Reason::kDriveFault, 37},
                                            {Reason::kForeignController, 38},
                                            {Reason::kUnexpectedJoint, 42},
                                            {Reason::kMissedCycles, 39},
                                            {Reason::kBusLost, 40},
                                            {Reason::kOperator, 41},
                                            {Reason::kPhaseBudget, 5},
                                            {Reason::kCyclesMissed, 6},
                                            {Reason::kCollision, 7},
                                            {Reason::kPhaseBudgetInRow, 44},
                                            {Reason::kStaleWrench, 43},
                                            {Reason::kWrenchRange, 45},
                                            {Reason::kStretched, 46},
                                            {Reason::kTorqueNotDelivered, 47},
                                            {Reason::kSpeedContradicts, 48},
                                            {Reason::kJointDoesNotFollow, 49},
                                            {Reason::kFrozenWrench, 50},
                                            {Reason::kTipSpeed, 51},
                                            {Reason::kPower, 52},
                                            {Reason::kNotAtStandstill, 53},
                                            {Reason::kTorqueUnexplained, 54},
                                            {Reason::kFollowingError, 55},
                                            {Reason::kEnergy, 56},
                                            {Reason::kForceZero, 8},
                                            {Reason::kStretchHeld, 9},
                                            {Reason::kCommandCut, 10},
                                            {Reason::kStretch, 101},
                                            {Reason::kTorque, 96},
                                            {Reason::kTorqueRate, 97},
                                            {Reason::kNormalSpeed, 98},
                                            {Reason::kHeldMeasurement, 99},
                                            {Reason::kRampDown, 100}};
  for (const auto& [reason, number] : numbers) {
    EXPECT_EQ(static_cast<int>(reason), number);
    EXPECT_EQ(IsTrip(reason), number >= 32 && number < 96);
  }
}

TEST(Reason, EveryKnownNumberHasItsOwnTextAndTheOthersSayUnknown) {
  const std::set<int> known{0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 32, 33,  34,
                            35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47,  48,
                            49, 50, 51, 52, 53, 54, 55, 56, 96, 97, 98, 99, 100, 101};
  std::set<std::string> texts;
  for (int code = -5; code < 300; ++code) {
    if (known.contains(code)) {
      EXPECT_TRUE(texts.insert(Text(code)).second) << code << " shares its text";
      EXPECT_STRNE(Text(code), "unknown") << code;
    } else {
      EXPECT_STREQ(Text(code), "unknown") << code;
    }
  }
}

TEST(Reason, LimitsHaveOneBitEachFromBitZero) {
  EXPECT_EQ(LimitBit(Reason::kTorque), 1);
  EXPECT_EQ(LimitBit(Reason::kTorqueRate), 2);
  EXPECT_EQ(LimitBit(Reason::kNormalSpeed), 4);
  EXPECT_EQ(LimitBit(Reason::kHeldMeasurement), 8);
  EXPECT_EQ(LimitBit(Reason::kRampDown), 16);
  EXPECT_EQ(LimitBit(Reason::kStretch), 32);
}

}  // namespace
}  // namespace reed::protect
