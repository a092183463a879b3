#include <gtest/gtest.h>

#include "reed/tests/plant_sim/endpoint_rig.h"

namespace reed::plant {
namespace {

using bus::DriveRequest;
using bus::DriveState;

constexpr std::int64_t kMs = 1'000'000;
constexpr double kTau_Nm = 4.0;

/// The clock under the test's control.
class Realtime : public ::testing::Test {
 protected:
  Realtime() {
    EndpointClock clock{[this] { return now_ns_; }, [this] { return 1'700'000'000'000'000 + now_ns_ / 1000; },
                        [this] { return paused_ns_; }};
    endpoint_ = std::make_unique<RealtimeEndpoint>(TwoJointScenario(), wire_.plant, body_, recorder_, clock);
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
  std::int64_t paused_ns_ = 0;
  test::FakeWire wire_;
  RotorBody body_;
  VectorRecorder recorder_;
  FakeController controller_{wire_.controller};
  std::unique_ptr<RealtimeEndpoint> endpoint_;
};

TEST_F(Realtime, ACommandActsWhenItArrives) {
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

TEST_F(Realtime, SyncSamplesTheInstantOfItsArrival) {
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

TEST_F(Realtime, TheArmStandsStillUntilTheFirstSync) {
  At(700 * kMs);
  At(900 * kMs);
  EXPECT_EQ(endpoint_->robot().time_s(), 0.0);
  EXPECT_EQ(wire_.plant.last_deadline_ns, now_ns_ + 50 * kMs) << "and nobody is woken for it";
}

TEST_F(Realtime, FramesOfNobodysConcernCostNoIntegration) {
  Enable();
  const double before_s = endpoint_->robot().time_s();
  bus::Frame damaged = controller_.CommandFrame(1, DriveRequest::kEnable, kTau_Nm);
  damaged.data[8] ^= 1U;
  for (int i = 0; i < 40; ++i) {
    controller_.Send(damaged);
    At(2 * kMs + i * kMs / 10);
  }
  EXPECT_EQ(endpoint_->robot().time_s(), before_s);
  controller_.Sync(2);
  At(7 * kMs);
  EXPECT_NEAR(endpoint_->robot().time_s(), 7e-3, 1e-12) << "nothing of the time is lost";
}

TEST_F(Realtime, AnArmThatNobodyAsksMovesOnUnderForeignFramesAllTheSame) {
  Enable();
  bus::Frame damaged = controller_.CommandFrame(1, DriveRequest::kEnable, kTau_Nm);
  damaged.data[8] ^= 1U;
  for (int i = 0; i < 70; ++i) {
    controller_.Send(damaged);
    At(2 * kMs + i * kMs);
  }
  EXPECT_GT(endpoint_->robot().time_s(), 50e-3);
  EXPECT_EQ(state(), DriveState::kBraked) << "no command came";
}

TEST_F(Realtime, StepsAreBoundedHoweverLongNoFrameCame) {
  Enable();
  At(10 * kMs);
  EXPECT_LE(body_.longest_step_s, PlantModelConfig{}.max_step_s * (1.0 + 1e-9));
  EXPECT_NEAR(endpoint_->robot().time_s(), 10e-3, 1e-12);
}

TEST_F(Realtime, BrakesCloseAfter20MsOfSilence) {
  Enable();  // last command at 1.25 ms
  for (std::int64_t t_ns = 2 * kMs; t_ns <= 21 * kMs; t_ns += kMs / 2) At(t_ns);
  EXPECT_EQ(state(), DriveState::kEnabled);
  At(21 * kMs + kMs / 2);
  EXPECT_EQ(state(), DriveState::kBraked);
}

TEST_F(Realtime, ACommandThatComesTooLateFindsTheBrakesClosed) {
  Enable();
  controller_.Sync(2);
  At(2 * kMs);
  controller_.Command(2, DriveRequest::kEnable, kTau_Nm);  // the controller has computed for 30 ms
  At(32 * kMs);
  EXPECT_EQ(state(), DriveState::kBraked);
  EXPECT_EQ(endpoint_->robot().drives().torque_Nm()[0], 0.0);
}

TEST_F(Realtime, APlantThatIsLateBehindASilentControllerBrakesAtTheRightInstant) {
  Enable();
  controller_.Command(1, DriveRequest::kEnable, kTau_Nm);
  At(2 * kMs);
  At(100 * kMs);
  EXPECT_EQ(state(), DriveState::kBraked);
  const double tau_Nm = 4.0, t_s = 20e-3;  // torque flowed for 20 ms and no longer
  EXPECT_NEAR(body_.truth().motor_angle_rad[0], 0.25 + 0.5 * tau_Nm / RotorBody::kInertia_kgm2 * t_s * t_s,
              1e-6);
}

TEST_F(Realtime, TheArmsClockIsHeldInAHostPause) {
  Enable();
  controller_.Command(1, DriveRequest::kEnable, kTau_Nm);
  At(2 * kMs);
  paused_ns_ = 98 * kMs;
  controller_.Sync(2);
  At(101 * kMs);
  EXPECT_EQ(state(), DriveState::kEnabled) << "of 99 ms the arm has seen one";
  EXPECT_NEAR(recorder_.Plants().back().t_s, 3e-3, 1e-12);
  EXPECT_EQ(recorder_.Plants().back().stalls, 1);
  EXPECT_NEAR(recorder_.Plants().back().stood_s, 98e-3, 1e-12);
  EXPECT_EQ(recorder_.Count(PlantEvent::kHostPause), 1);

  controller_.Sync(3);
  At(102 * kMs);
  EXPECT_NEAR(endpoint_->robot().time_s(), 4e-3, 1e-12);
  At(121 * kMs + kMs / 2);
  EXPECT_EQ(state(), DriveState::kBraked) << "a silent controller still is one";
}

TEST_F(Realtime, APauseInALateCycleHoldsTheArmForThePauseAlone) {
  Enable();
  paused_ns_ = 2 * kMs;
  controller_.Sync(2);
  At(6 * kMs);  // five after the last answer, two of them the host's
  EXPECT_NEAR(recorder_.Plants().back().t_s, 4e-3, 1e-12);
  EXPECT_EQ(recorder_.Plants().back().stalls, 1);
}

TEST_F(Realtime, ShortPausesAreCountedWithoutALine) {
  Enable();
  for (std::uint32_t k = 2; k < 12; ++k) {
    paused_ns_ += kMs;
    Cycle(2 * k, DriveRequest::kEnable);
  }
  EXPECT_EQ(recorder_.Plants().back().stalls, 10);
  EXPECT_EQ(recorder_.Count(PlantEvent::kHostPause), 0);
}

TEST_F(Realtime, APauseSeenAfterTheClockWasReadHoldsTheArmAndNeverTurnsItBack) {
  Enable();
  paused_ns_ = 30 * kMs;  // the reading of the clock is older than the pause
  At(2 * kMs);
  EXPECT_NEAR(endpoint_->robot().time_s(), 1.25e-3, 1e-12);
  At(32 * kMs);
  EXPECT_NEAR(endpoint_->robot().time_s(), 2e-3, 1e-12);
}

TEST_F(Realtime, PausesBeforeTheFirstSyncAreNobodysLoss) {
  paused_ns_ = 500 * kMs;
  At(600 * kMs);
  controller_.Sync(0);
  At(601 * kMs);
  EXPECT_EQ(recorder_.Plants().back().stalls, 0);
}

TEST_F(Realtime, AStaleCommandIsRefused) {
  Enable();
  for (std::uint32_t k = 2; k < 40; ++k) Cycle(k, DriveRequest::kEnable, 0.0);
  controller_.Command(15, DriveRequest::kEnable, kTau_Nm);
  controller_.Command(41, DriveRequest::kEnable, kTau_Nm);
  At(40 * kMs);
  EXPECT_EQ(endpoint_->robot().drives().torque_Nm()[0], 0.0);
  EXPECT_EQ(endpoint_->rejected(), 2U);
}

TEST_F(Realtime, TimeThatCannotBeCaughtUpIsGivenUpAndSaidSo) {
  Enable();
  At(2000 * kMs);
  EXPECT_EQ(recorder_.Count(PlantEvent::kTooSlow), 1);
  EXPECT_LT(endpoint_->robot().time_s(), 0.3);
}

TEST_F(Realtime, ANewControllerFindsTheArmAtItsStart) {
  Enable();
  for (std::uint32_t k = 2; k < 40; ++k) Cycle(k, DriveRequest::kEnable, kTau_Nm);
  FakeController second(wire_.controller);
  wire_.controller.inbox().clear();
  second.Sync(0);
  At(60 * kMs);
  EXPECT_EQ(state(), DriveState::kOff);
  EXPECT_EQ(recorder_.Plants().back().t_s, 0.0);
  EXPECT_NEAR(recorder_.Plants().back().motor_angle[0], 0.25, 1e-12);
}

}  // namespace
}  // namespace reed::plant
