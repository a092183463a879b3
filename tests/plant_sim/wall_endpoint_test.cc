#include <gtest/gtest.h>

#include "reed/tests/plant_sim/endpoint_rig.h"

namespace reed::plant {
namespace {

using bus::DriveRequest;
using bus::DriveState;

constexpr std::int64_t kMs = 1'000'000;
constexpr double kTau_Nm = 4.0;

/// The wall clock under the test's control.
class Wall : public ::testing::Test {
 protected:
  Wall() {
    WallClock clock{[this] { return now_ns_; }, [this] { return 1'700'000'000'000'000 + now_ns_ / 1000; },
                    [this] { return stood_ns_; }};
    endpoint_ = std::make_unique<WallEndpoint>(TwoJointScenario(), wire_.plant, body_, recorder_, clock);
  }
  void At(std::int64_t time_ns) {
    now_ns_ = kStart_ns + time_ns;
    endpoint_->Poll(now_ns_ + 50 * kMs);
  }
  /// Cycle k at k ms; a little later its command.
  void Cycle(std::uint32_t k, DriveRequest request, double tau_Nm = 0.0) {
    controller_.Sync(k);
    At(k * kMs);
    controller_.Command(k, request, tau_Nm);
    At(k * kMs + kMs / 4);
  }
  void Enable() {
    Cycle(0, DriveRequest::kReady);
    Cycle(1, DriveRequest::kEnable);
    ASSERT_EQ(state(), DriveState::kEnabled);
  }
  DriveState state() const { return endpoint_->robot().drives().state(); }

  static constexpr std::int64_t kStart_ns = 5'000 * kMs;
  std::int64_t now_ns_ = kStart_ns;
  std::int64_t stood_ns_ = 0;
  test::FakeWire wire_;
  RotorBody body_;
  VectorRecorder recorder_;
  FakeController controller_{wire_.controller};
  std::unique_ptr<WallEndpoint> endpoint_;
};

TEST_F(Wall, ACommandActsWhenItArrives) {
  Enable();
  controller_.Command(1, DriveRequest::kEnable, kTau_Nm);
  At(2 * kMs);
  const double tau_Nm = endpoint_->robot().drives().torque_Nm()[0];
  EXPECT_NEAR(tau_Nm, kTau_Nm, 1e-3);
  At(5 * kMs);  // no SYNC needed for the arm to move
  const double t_s = 3e-3;
  EXPECT_NEAR(body_.truth().motor_angle_rad[0], 0.25 + 0.5 * tau_Nm / RotorBody::kInertia_kgm2 * t_s * t_s,
              1e-12);
}

TEST_F(Wall, SyncSamplesTheInstantOfItsArrival) {
  Enable();
  controller_.Command(1, DriveRequest::kEnable, kTau_Nm);
  At(2 * kMs);
  controller_.Take();
  controller_.Sync(2);
  At(3 * kMs + kMs / 2);
  const double tau_Nm = endpoint_->robot().drives().torque_Nm()[0];
  EXPECT_NEAR(recorder_.Plants().back().t_s, 3.5e-3, 1e-12);
  EXPECT_NEAR(recorder_.Plants().back().motor_speed[0], tau_Nm / RotorBody::kInertia_kgm2 * 1.5e-3, 1e-12);
  EXPECT_EQ(recorder_.Plants().back().utime, 1'700'000'000'000'000 + now_ns_ / 1000);
  EXPECT_EQ(controller_.Take().joints.size(), 2U);
}

TEST_F(Wall, TheArmStandsStillUntilTheFirstSync) {
  At(700 * kMs);
  At(900 * kMs);
  EXPECT_EQ(endpoint_->robot().time_s(), 0.0);
  EXPECT_EQ(wire_.plant.last_deadline_ns, now_ns_ + 50 * kMs) << "and nobody is woken for it";
}

TEST_F(Wall, StepsAreBoundedHoweverLongNoFrameCame) {
  Enable();
  At(10 * kMs);
  EXPECT_LE(body_.longest_step_s, PlantModelConfig{}.max_step_s * (1.0 + 1e-9));
  EXPECT_NEAR(endpoint_->robot().time_s(), 10e-3, 1e-12);
}

TEST_F(Wall, BrakesCloseAfter20MsOfSilence) {
  Enable();  // last command at 1.25 ms
  for (std::int64_t t_ns = 2 * kMs; t_ns <= 21 * kMs; t_ns += kMs / 2) At(t_ns);
  EXPECT_EQ(state(), DriveState::kEnabled);
  At(21 * kMs + kMs / 2);
  EXPECT_EQ(state(), DriveState::kBraked);
}

TEST_F(Wall, ACommandThatComesTooLateFindsTheBrakesClosed) {
  Enable();
  controller_.Sync(2);
  At(2 * kMs);
  controller_.Command(2, DriveRequest::kEnable, kTau_Nm);  // the controller has computed for 30 ms
  At(32 * kMs);
  EXPECT_EQ(state(), DriveState::kBraked);
  EXPECT_EQ(endpoint_->robot().drives().torque_Nm()[0], 0.0);
}

TEST_F(Wall, AStalledMachineWithASilentControllerBrakesAtTheRightInstant) {
  Enable();
  controller_.Command(1, DriveRequest::kEnable, kTau_Nm);
  At(2 * kMs);
  At(100 * kMs);
  EXPECT_EQ(state(), DriveState::kBraked);
  const double tau_Nm = 4.0, t_s = 20e-3;  // torque flowed for 20 ms and no longer
  EXPECT_NEAR(body_.truth().motor_angle_rad[0], 0.25 + 0.5 * tau_Nm / RotorBody::kInertia_kgm2 * t_s * t_s,
              1e-6);
}

TEST_F(Wall, TheArmsClockStandsStillWhileTheMachineIsAway) {
  Enable();
  controller_.Command(1, DriveRequest::kEnable, kTau_Nm);
  At(2 * kMs);
  controller_.Take();
  stood_ns_ = 98 * kMs;
  controller_.Sync(2);
  At(101 * kMs);
  EXPECT_EQ(state(), DriveState::kEnabled) << "of 99 ms the arm has seen one";
  EXPECT_NEAR(recorder_.Plants().back().t_s, 3e-3, 1e-12);
  EXPECT_EQ(recorder_.Plants().back().stalls, 1);
  EXPECT_NEAR(recorder_.Plants().back().stood_s, 98e-3, 1e-12);
  EXPECT_EQ(recorder_.Count(PlantEvent::kClockStood), 1);
  for (const bus::JointStateMessage& joint : controller_.Take().joints) EXPECT_TRUE(joint.clock_stood);

  controller_.Sync(3);
  At(102 * kMs);
  for (const bus::JointStateMessage& joint : controller_.Take().joints) EXPECT_FALSE(joint.clock_stood);
  EXPECT_NEAR(endpoint_->robot().time_s(), 4e-3, 1e-12);
  At(121 * kMs + kMs / 2);
  EXPECT_EQ(state(), DriveState::kBraked) << "a silent controller still is one";
}

TEST_F(Wall, AStallThatTookTheSmallerPartOfALateCycleExcusesNobody) {
  Enable();
  controller_.Take();
  stood_ns_ = 2 * kMs;
  controller_.Sync(2);
  At(6 * kMs);  // five after the last answer, two of them the machine's
  for (const bus::JointStateMessage& joint : controller_.Take().joints) EXPECT_FALSE(joint.clock_stood);
  EXPECT_EQ(recorder_.Plants().back().stalls, 1) << "counted all the same";
}

TEST_F(Wall, ShortStallsAreCountedWithoutALine) {
  Enable();
  for (std::uint32_t k = 2; k < 12; ++k) {
    stood_ns_ += kMs;
    Cycle(2 * k, DriveRequest::kEnable);
  }
  EXPECT_EQ(recorder_.Plants().back().stalls, 10);
  EXPECT_EQ(recorder_.Count(PlantEvent::kClockStood), 0);
}

TEST_F(Wall, AStallSeenAfterTheClockWasReadHoldsTheArmAndNeverTurnsItBack) {
  Enable();
  stood_ns_ = 30 * kMs;  // the reading of the clock is older than the stall
  At(2 * kMs);
  EXPECT_NEAR(endpoint_->robot().time_s(), 1.25e-3, 1e-12);
  At(32 * kMs);
  EXPECT_NEAR(endpoint_->robot().time_s(), 2e-3, 1e-12);
}

TEST_F(Wall, StallsBeforeTheFirstSyncAreNobodysLoss) {
  stood_ns_ = 500 * kMs;
  At(600 * kMs);
  controller_.Sync(0);
  At(601 * kMs);
  EXPECT_EQ(recorder_.Plants().back().stalls, 0);
  for (const bus::JointStateMessage& joint : controller_.Take().joints) EXPECT_FALSE(joint.clock_stood);
}

TEST_F(Wall, AStaleCommandIsRefused) {
  Enable();
  for (std::uint32_t k = 2; k < 40; ++k) Cycle(k, DriveRequest::kEnable, 0.0);
  controller_.Command(15, DriveRequest::kEnable, kTau_Nm);
  controller_.Command(41, DriveRequest::kEnable, kTau_Nm);
  At(40 * kMs);
  EXPECT_EQ(endpoint_->robot().drives().torque_Nm()[0], 0.0);
  EXPECT_EQ(endpoint_->rejected(), 2U);
}

TEST_F(Wall, TimeThatCannotBeCaughtUpIsGivenUpAndSaidSo) {
  Enable();
  At(2000 * kMs);
  EXPECT_EQ(recorder_.Count(PlantEvent::kTooSlow), 1);
  EXPECT_LT(endpoint_->robot().time_s(), 0.3);
}

TEST_F(Wall, ANewControllerFindsTheArmAtItsStart) {
  Enable();
  for (std::uint32_t k = 2; k < 40; ++k) Cycle(k, DriveRequest::kEnable, kTau_Nm);
  FakeController second(wire_.controller);
  wire_.controller.inbox.clear();
  second.Sync(0);
  At(60 * kMs);
  EXPECT_EQ(state(), DriveState::kOff);
  EXPECT_EQ(recorder_.Plants().back().t_s, 0.0);
  EXPECT_NEAR(recorder_.Plants().back().motor_angle[0], 0.25, 1e-12);
}

}  // namespace
}  // namespace reed::plant
