// The monitors of core/safety, each against a planted fault and against its own closed form.
#include "reed/core/safety/monitors.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace reed::protect {
namespace {

constexpr int N = 2;
constexpr double T = 1e-3;
using V = Vec<N>;

Measurement<N> Fresh() {
  Measurement<N> m;
  m.age.fill(0);
  m.wrench_age = 0;
  return m;
}

TEST(TorqueDelivery, CommandsOfThisCycleOrOfTheOneBeforeAreDelivered) {
  for (const int late : {1, 2}) {
    TorqueDelivery<N> monitor(V::Constant(0.1));
    std::vector<V> sent(3, V::Zero());
    for (int k = 0; k < 200; ++k) {
      Measurement<N> m = Fresh();
      m.torque = sent[sent.size() - static_cast<std::size_t>(late)];
      sent.emplace_back(V::Constant(5.0 * std::sin(0.3 * k)));
      EXPECT_EQ(monitor.Step(m, sent.back()).trip, Reason::kNone) << k;
    }
  }
}

TEST(TorqueDelivery, HalfATorqueIsFoundAfterItsRow) {
  TorqueDelivery<N> monitor(V::Constant(0.1));
  int k = 0;
  LimitCheck check;
  for (; k < 100 && check.trip == Reason::kNone; ++k) {
    Measurement<N> m = Fresh();
    if (k > 1) m.torque = V(2.0, 1.0);
    check = monitor.Step(m, V(2.0, 2.0));
  }
  EXPECT_EQ(check.trip, Reason::kTorqueNotDelivered);
  EXPECT_EQ(check.joint, 1);
  EXPECT_NEAR(check.value, -1.0, 1e-12);
  EXPECT_EQ(k, TorqueDelivery<N>::kRow + 2) << "the first two cycles report what was before";
}

TEST(TorqueDelivery, AnOldReportSaysNothing) {
  TorqueDelivery<N> monitor(V::Constant(0.1));
  Measurement<N> m = Fresh();
  m.age.fill(1);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(monitor.Step(m, V(2.0, 2.0)).trip, Reason::kNone);
}

TEST(FrozenWrench, AReadingThatStaysIsFoundAfterItsRowAndNoiseIsNot) {
  FrozenWrench monitor(true);
  std::mt19937 engine(1);  // NOLINT(cert-msc32-c, cert-msc51-cpp): the same every time
  std::normal_distribution<double> noise;
  const double step = 2.0;  // twice the noise
  const auto read = [&] { return std::nearbyint(noise(engine) / step) * step; };
  for (int k = 0; k < 100000; ++k)
    ASSERT_EQ(monitor.Step({read(), read(), read()}, true).trip, Reason::kNone) << k;
  int k = 0;
  while (monitor.Step({1.0, 2.0, 2.0}, true).trip == Reason::kNone && k < 1000) ++k;
  EXPECT_EQ(k, FrozenWrench::kRow);
  FrozenWrench without_noise(false);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(without_noise.Step({1.0, 2.0, 2.0}, true).trip, Reason::kNone);
}

constexpr double kNever_rad = 1e9;

/// dw/dt = v - w/τ: w reaches d at t = -τ ln(1 - d / (v τ)).
TEST(JointFollows, AStuckAngleIsFoundWhenTheClosedFormSays) {
  const double v = 0.5, stuck_rad = 0.02, tau = JointFollows<N>::kForget_s;
  JointFollows<N> monitor(stuck_rad, kNever_rad, T);
  Measurement<N> m = Fresh();
  monitor.Reset(m.theta);
  int k = 0;
  while (monitor.Step(m, V(0.0, v)).trip == Reason::kNone && k < 10000) ++k;
  EXPECT_NEAR(k * T, -tau * std::log(1.0 - stuck_rad / (v * tau)), 2 * T);
}

TEST(JointFollows, AnAngleThatDoesNotChangeAtAllIsFoundSooner) {
  const double v = 0.045, frozen_rad = 0.004, tau = JointFollows<N>::kForgetFrozen_s;
  for (const bool frozen : {true, false}) {
    JointFollows<N> monitor(0.02, frozen_rad, T);
    Measurement<N> m = Fresh();
    monitor.Reset(m.theta);
    int k = 0;
    for (; k < 5000 && monitor.Step(m, V(0.0, v)).trip == Reason::kNone; ++k)
      if (!frozen && k % 50 == 0) m.theta[1] = m.theta[1] > 0.0 ? 0.0 : 6e-6;  // one step of an encoder
    if (frozen)
      EXPECT_NEAR(k * T, -tau * std::log(1.0 - frozen_rad / (v * tau)), 2 * T);
    else
      EXPECT_EQ(k, 5000);
  }
}

TEST(JointFollows, FramesThatDoNotComeAreNoStuckAngle) {
  JointFollows<N> monitor(0.02, 0.004, T);
  Measurement<N> m = Fresh();
  m.age.fill(1);
  for (int k = 0; k < 1000; ++k) ASSERT_EQ(monitor.Step(m, V(1.0, 1.0)).trip, Reason::kNone);
}

TEST(JointFollows, AJointThatMovesOrHasAStandingErrorIsNotFound) {
  JointFollows<N> monitor(0.02, kNever_rad, T);
  Measurement<N> m = Fresh();
  monitor.Reset(m.theta);
  for (int k = 0; k < 5000; ++k) {
    m.theta[0] += 0.5 * T;
    ASSERT_EQ(monitor.Step(m, V(0.5, 0.09)).trip, Reason::kNone) << k;  // 0.09 rad/s · 0.2 s < 0.02 rad
  }
}

class Speed : public ::testing::Test {
 protected:
  static constexpr double kFilter_hz = 120.0;
  /// Of a drive that filters its own angle; `wrong` is added to its speed.
  LimitCheck Run(int cycles, double wrong, int lost_every = 0) {
    SpeedAgrees<N> monitor(V::Constant(0.1), kFilter_hz, T);
    const double share = 1.0 - std::exp(-2.0 * std::numbers::pi * kFilter_hz * T);
    Measurement<N> m = Fresh();
    double theta = 0.0, omega = 0.0;
    monitor.Reset(m);
    LimitCheck check;
    for (int k = 1; k <= cycles && check.trip == Reason::kNone; ++k) {
      const double next = 0.5 * std::sin(6.0 * k * T);
      omega += share * ((next - theta) / T - omega);
      theta = next;
      const bool lost = lost_every > 0 && k % lost_every < 2;
      m.age.fill(lost ? 1 : 0);
      if (!lost) m.theta[1] = theta, m.theta_dot[1] = omega + wrong;
      check = monitor.Step(m, false);
    }
    return check;
  }
};

TEST_F(Speed, OfTheSameAngleAgreesAlsoWhereFramesAreLost) {
  EXPECT_EQ(Run(3000, 0.0).trip, Reason::kNone);
  EXPECT_EQ(Run(3000, 0.0, 7).trip, Reason::kNone);
  EXPECT_EQ(Run(3000, 0.09).trip, Reason::kNone);
}

TEST_F(Speed, ThatIsOffContradicts) {
  const LimitCheck check = Run(3000, 0.2);
  EXPECT_EQ(check.trip, Reason::kSpeedContradicts);
  EXPECT_EQ(check.joint, 1);
  EXPECT_NEAR(check.value, 0.2, 0.02);
}

TEST_F(Speed, ThatIsOffIsFoundAfterItsRow) {
  SpeedAgrees<N> monitor(V::Constant(0.1), kFilter_hz, T);
  Measurement<N> m = Fresh();
  monitor.Reset(m);
  monitor.Step(m, false);
  m.theta_dot[0] = 0.2;
  int k = 1;
  while (monitor.Step(m, false).trip == Reason::kNone && k < 100) ++k;
  EXPECT_EQ(k, SpeedAgrees<N>::kRow);
}

/// A fault's torque d as the observer sees it, r = d (1 - e^(-K_o t)), beside a weight that the model has wrong.
class Explained : public ::testing::Test {
 protected:
  static constexpr double kAllowed_Nm = 4.0, kK_o = 80.0, kWeight_Nm = -4.6;
  static constexpr int kOnset = 1000;

  /// The cycles from a torque that jumps by d to the finding; -1: none in a second.
  static int Found(double d, LimitCheck* what = nullptr) {
    TorqueExplained<N> monitor(V::Constant(kAllowed_Nm), kK_o, T);
    monitor.Reset();
    for (int k = 0; k < kOnset + 1000; ++k) {
      const double fault = k < kOnset ? 0.0 : d * (1.0 - std::exp(-kK_o * T * (k - kOnset)));
      const LimitCheck check =
          monitor.Step(V(kWeight_Nm * (1.0 - std::exp(-kK_o * T * k)), fault), V::Zero(), true);
      if (check.trip == Reason::kNone) continue;
      if (what != nullptr) *what = check;
      return k - kOnset;
    }
    return -1;
  }
};

TEST_F(Explained, AJumpIsFoundWhenTheClosedFormSays) {
  for (const double d : {5.0, 8.0, 20.0, 40.0}) {
    LimitCheck check;
    const double expected = -std::log(1.0 - kAllowed_Nm / d) / kK_o / T + TorqueExplained<N>::kRow;
    EXPECT_NEAR(Found(d, &check), expected, 0.02 * expected + 1.0) << d;
    EXPECT_EQ(check.trip, Reason::kTorqueUnexplained);
    EXPECT_EQ(check.joint, 1);
    EXPECT_GT(check.value, kAllowed_Nm);
  }
}

TEST_F(Explained, LessThanAllowedIsNotFound) { EXPECT_EQ(Found(0.95 * kAllowed_Nm), -1); }

TEST_F(Explained, AForceThatTheSensorFeelsIsNoFault) {
  TorqueExplained<N> monitor(V::Constant(kAllowed_Nm), kK_o, T);
  V r = V::Zero();
  for (int k = 0; k < 3000; ++k) {
    const V felt = V(12.0, -20.0) * (k < 1000 || k > 2000 ? 0.0 : 1.0);
    r += (1.0 - std::exp(-kK_o * T)) * (felt - r);
    ASSERT_EQ(monitor.Step(r, felt, true).trip, Reason::kNone) << k;
  }
}

TEST_F(Explained, WithoutAForceSensorNothingIsSaid) {
  TorqueExplained<N> monitor(V::Constant(kAllowed_Nm), kK_o, T);
  for (int k = 0; k < 1000; ++k)
    ASSERT_EQ(monitor.Step(V(0.0, 0.05 * k), V::Zero(), false).trip, Reason::kNone);
}

TEST(FollowingError, IsFoundAfterItsRowAndOneThatComesAndGoesIsNot) {
  FollowingError<N> monitor(V::Constant(0.3));
  for (int k = 0; k < 100; ++k)
    ASSERT_EQ(monitor.Step(V(0.29, k % FollowingError<N>::kRow == 0 ? 0.0 : -0.5)).trip, Reason::kNone) << k;
  monitor.Reset();
  int k = 1;
  while (monitor.Step(V(0.0, -0.31)).trip == Reason::kNone && k < 100) ++k;
  EXPECT_EQ(k, FollowingError<N>::kRow);
  const LimitCheck check = monitor.Step(V(0.0, -0.31));
  EXPECT_EQ(check.trip, Reason::kFollowingError);
  EXPECT_EQ(check.joint, 1);
  EXPECT_EQ(check.value, -0.31);
}

/// |s| of a sine of amplitude 2 a is beyond a for 2/3 of each half wave: kRow cycles of it up to 1/(3 T kRow).
TEST(FollowingError, OfALoopThatOscillatesIsFound) {
  for (const double hz : {2.0, 10.0, 50.0}) {
    FollowingError<N> monitor(V::Constant(0.3));
    bool found = false;
    for (int k = 0; k < 1000; ++k)
      found = found ||
              monitor.Step(V(0.6 * std::sin(2.0 * std::numbers::pi * hz * k * T), 0.0)).trip != Reason::kNone;
    EXPECT_TRUE(found) << hz;
  }
}

TEST(NearPeople, TipSpeedPowerAndEnergyHaveTheirLimits) {
  Eigen::Matrix<double, 6, N> J = Eigen::Matrix<double, 6, N>::Zero();
  J(0, 0) = J(1, 1) = 0.5;
  Measurement<N> m = Fresh();
  m.theta_dot = V(0.6, 0.8);  // 0.5 m/s
  m.torque = V(10.0, -1.0);   // 5.2 W
  constexpr double kEnergy_J = 1.0;
  EXPECT_EQ(CheckNearPeople<N>({}, m, J, kEnergy_J).trip, Reason::kNone);
  EXPECT_EQ(CheckNearPeople<N>({.tip_speed = 0.51, .power = 5.3, .energy = 1.1}, m, J, kEnergy_J).trip,
            Reason::kNone);
  EXPECT_EQ(CheckNearPeople<N>({.tip_speed = 0.49}, m, J, kEnergy_J).trip, Reason::kTipSpeed);
  const LimitCheck power = CheckNearPeople<N>({.power = 5.1}, m, J, kEnergy_J);
  EXPECT_EQ(power.trip, Reason::kPower);
  EXPECT_NEAR(power.value, 5.2, 1e-12);
  const LimitCheck energy = CheckNearPeople<N>({.energy = 0.9}, m, J, kEnergy_J);
  EXPECT_EQ(energy.trip, Reason::kEnergy);
  EXPECT_EQ(energy.value, kEnergy_J);
}

class AtRest : public ::testing::Test {
 protected:
  static constexpr double kAllowed_rad = 0.01;
  /// Moves joint 1 by as much and looks.
  LimitCheck Move(double by_rad, DriveState drives, bool ready = true) {
    m_.drive.fill(drives);
    m_.theta[0] += by_rad;
    return monitor_.Step(m_, ready);
  }
  Standstill<N> monitor_{kAllowed_rad};
  Measurement<N> m_ = Fresh();
};

TEST_F(AtRest, IsWatchedFromWhenTheBrakesHaveClosed) {
  EXPECT_EQ(Move(0.1, DriveState::kEnabled).trip, Reason::kNone);
  for (int k = 0; k < Standstill<N>::kSettle; ++k)
    ASSERT_EQ(Move(0.001, DriveState::kReady).trip, Reason::kNone) << "still braking";
  for (int k = 0; k < 9; ++k) ASSERT_EQ(Move(0.001, DriveState::kReady).trip, Reason::kNone);
  const LimitCheck check = Move(0.0015, DriveState::kReady);
  EXPECT_EQ(check.trip, Reason::kNotAtStandstill);
  EXPECT_NEAR(check.value, 0.0105, 1e-12);
  EXPECT_EQ(Move(0.1, DriveState::kEnabled).trip, Reason::kNone) << "brakes open";
}

TEST_F(AtRest, IsWatchedAtOnceBeforeTheFirstStart) {
  EXPECT_EQ(Move(0.1, DriveState::kOff, false).trip, Reason::kNone) << "nobody holds it yet";
  EXPECT_EQ(Move(0.1, DriveState::kReady).trip, Reason::kNone);
  EXPECT_EQ(Move(0.009, DriveState::kReady).trip, Reason::kNone);
  EXPECT_EQ(Move(0.002, DriveState::kReady).trip, Reason::kNotAtStandstill);
}

}  // namespace
}  // namespace reed::protect
