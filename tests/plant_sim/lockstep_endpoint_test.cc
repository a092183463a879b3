#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>

#include "tests/plant_sim/endpoint_rig.h"

namespace reed::plant {
namespace {

using bus::DriveRequest;
using bus::DriveState;

constexpr double kPeriod_s = 1e-3;
constexpr double kLsb_rad = 6.283185307179586 / 1048576.0;
constexpr double kTau_Nm = 4.0;

class Lockstep : public ::testing::Test {
 protected:
  void Start(const Scenario& scenario) {
    endpoint_ = std::make_unique<LockstepEndpoint>(scenario, wire_.plant, body_, recorder_);
  }
  Lockstep() { Start(TwoJointScenario()); }

  Answer SyncAndTake(std::uint32_t cycle) {
    controller_.Sync(cycle);
    endpoint_->Poll(0);
    return controller_.Take();
  }
  Answer Cycle(std::uint32_t cycle, DriveRequest request, double tau_Nm = 0.0) {
    const Answer answer = SyncAndTake(cycle);
    controller_.Command(cycle, request, tau_Nm);
    endpoint_->Poll(0);
    return answer;
  }
  /// Cycles 0 and 1 ask for ready and enable; the enable acts in the period that SYNC 2 starts.
  void Enable() {
    Cycle(0, DriveRequest::kReady);
    Cycle(1, DriveRequest::kEnable);
  }
  DriveState state() const { return endpoint_->robot().drives().state(); }

  test::FakeWire wire_;
  RotorBody body_;
  VectorRecorder recorder_;
  FakeController controller_{wire_.controller};
  std::unique_ptr<LockstepEndpoint> endpoint_;
};

TEST_F(Lockstep, AnswersSyncWithEveryJointThenTheWrenchInOneBatch) {
  const Answer answer = SyncAndTake(0);
  const auto& joint_id = bus::layout::kJointState;
  EXPECT_EQ(answer.ids,
            (std::vector<std::uint32_t>{joint_id[0].id, joint_id[1].id, bus::layout::kWrench.id}));
  EXPECT_EQ(wire_.plant.batches, 1);
}

TEST_F(Lockstep, TheFirstAnswerIsTheStartAtRestWithBrakesClosed) {
  const Answer answer = SyncAndTake(0);
  EXPECT_NEAR(answer.joints[0].position_rad, 0.25, 0.5 * kLsb_rad + 1e-7);
  EXPECT_NEAR(answer.joints[1].position_rad, -1.0, 0.5 * kLsb_rad + 1e-7);
  for (const auto& joint : answer.joints) {
    EXPECT_EQ(joint.velocity_radps, 0.0);
    EXPECT_EQ(joint.torque_Nm, 0.0);
    EXPECT_EQ(joint.state, DriveState::kOff);
  }
  ASSERT_EQ(recorder_.Plants().size(), 1U);
  EXPECT_TRUE(recorder_.Plants()[0].braked);
  EXPECT_EQ(recorder_.Plants()[0].t_s, 0.0);
}

TEST_F(Lockstep, ACommandComputedInCycleKActsFromSyncKPlus1On) {
  Enable();
  const double start_rad = body_.truth().motor_angle_rad[0];
  Cycle(2, DriveRequest::kEnable, kTau_Nm);                  // computed in cycle 2 ...
  const Answer at_3 = Cycle(3, DriveRequest::kEnable, 0.0);  // ... not yet felt at 3T ...
  const Answer at_4 = Cycle(4, DriveRequest::kEnable, 0.0);  // ... felt over [3T, 4T]
  const Answer at_5 = Cycle(5, DriveRequest::kEnable, 0.0);  // and the zero of cycle 3 over [4T, 5T]
  EXPECT_EQ(at_3.joints[0].torque_Nm, 0.0);
  EXPECT_NEAR(at_4.joints[0].torque_Nm, kTau_Nm, 80.0 / 65534.0);
  EXPECT_EQ(at_5.joints[0].torque_Nm, 0.0);

  const auto truth = recorder_.Plants();
  const double tau_Nm = truth[4].torque[0];
  const double speed_radps = tau_Nm / RotorBody::kInertia_kgm2 * kPeriod_s;
  EXPECT_DOUBLE_EQ(truth[3].motor_angle[0], start_rad);
  EXPECT_NEAR(truth[4].motor_angle[0], start_rad + 0.5 * speed_radps * kPeriod_s, 1e-12);
  EXPECT_NEAR(truth[5].motor_angle[0], start_rad + 1.5 * speed_radps * kPeriod_s, 1e-12);
  EXPECT_NEAR(truth[5].motor_speed[0], speed_radps, 1e-12);
}

TEST_F(Lockstep, EachSyncIsExactlyOnePeriodAndUtimeIsSimulatedTime) {
  for (std::uint32_t k = 0; k < 50; ++k) SyncAndTake(k);
  const auto truth = recorder_.Plants();
  ASSERT_EQ(truth.size(), 50U);
  for (std::size_t k = 0; k < truth.size(); ++k) {
    EXPECT_NEAR(truth[k].t_s, static_cast<double>(k) * kPeriod_s, 1e-12);
    EXPECT_EQ(truth[k].cycle, static_cast<std::int64_t>(k));
    EXPECT_EQ(truth[k].utime, static_cast<std::int64_t>(k) * 1000);
  }
}

TEST_F(Lockstep, UtimeIsRoundedWhenThePeriodIsNoWholeMicrosecond) {
  Scenario scenario = TwoJointScenario();
  scenario.timing.rate_hz = 3000.0;
  Start(scenario);
  for (std::uint32_t k = 0; k < 4; ++k) SyncAndTake(k);
  const auto truth = recorder_.Plants();
  EXPECT_EQ(truth[1].utime, 333);
  EXPECT_EQ(truth[2].utime, 667);
  EXPECT_EQ(truth[3].utime, 1000);
}

TEST_F(Lockstep, ALostSyncStillTakesItsPeriod) {
  Enable();
  Cycle(2, DriveRequest::kEnable, 0.0);
  SyncAndTake(7);
  EXPECT_NEAR(recorder_.Plants().back().t_s, 7 * kPeriod_s, 1e-12);
  EXPECT_EQ(body_.resets, 2) << "constructor and first SYNC only";
}

TEST_F(Lockstep, ADamagedCommandIsNotApplied) {
  Enable();
  Cycle(2, DriveRequest::kEnable, 0.0);
  SyncAndTake(3);
  bus::Frame damaged = controller_.CommandFrame(3, DriveRequest::kEnable, kTau_Nm);
  damaged.data[20] ^= 0x10U;
  controller_.Send(damaged);
  endpoint_->Poll(0);
  for (std::uint32_t k = 4; k < 8; ++k) {
    const Answer answer = SyncAndTake(k);
    EXPECT_EQ(answer.joints[0].torque_Nm, 0.0);
  }
  EXPECT_EQ(endpoint_->rejected(), 1U);
}

TEST_F(Lockstep, ATorqueThatIsNotANumberIsNeverAppliedEvenUnderAValidChecksum) {
  Enable();
  Cycle(2, DriveRequest::kEnable, 1.0);
  SyncAndTake(3);
  bus::Frame frame = controller_.CommandFrame(3, DriveRequest::kEnable, 2.0);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&frame.data[8], &nan, sizeof nan);  // torque_1 of COMMAND: bit 64
  bus::E2eSender protection;
  for (int counter = 0; counter <= 3; ++counter) {
    protection.Protect(std::span(frame.data).first(frame.size), bus::layout::kCommand.data_id);
  }
  controller_.Send(frame);
  endpoint_->Poll(0);
  SyncAndTake(4);
  const Answer answer = SyncAndTake(5);
  EXPECT_NEAR(answer.joints[0].torque_Nm, 1.0, 1e-3) << "the last good torque holds";
  EXPECT_NEAR(answer.joints[1].torque_Nm, 1.0, 1e-3) << "no part of the command counts";
  EXPECT_EQ(endpoint_->rejected(), 1U);
}

TEST_F(Lockstep, ACommandOfAnotherCycleIsRefused) {
  Enable();
  Cycle(2, DriveRequest::kEnable, 0.0);
  SyncAndTake(3);
  controller_.Command(2, DriveRequest::kEnable, kTau_Nm);
  controller_.Command(4, DriveRequest::kEnable, kTau_Nm);
  endpoint_->Poll(0);
  SyncAndTake(4);
  EXPECT_EQ(SyncAndTake(5).joints[0].torque_Nm, 0.0);
  EXPECT_EQ(endpoint_->rejected(), 2U);
}

TEST_F(Lockstep, BrakesCloseAfter20CyclesWithoutACommand) {
  Enable();
  Cycle(2, DriveRequest::kEnable, 1.0);  // acts over [3T, 4T]; silence is counted from SYNC 4 on
  for (std::uint32_t k = 3; k <= 23; ++k) {
    EXPECT_EQ(SyncAndTake(k).joints[0].state, DriveState::kEnabled) << "SYNC " << k;
  }
  const Answer at_24 = SyncAndTake(24);
  EXPECT_EQ(at_24.joints[0].state, DriveState::kBraked);
  EXPECT_EQ(at_24.joints[0].torque_Nm, 0.0);
  EXPECT_EQ(recorder_.Count(PlantEvent::kBrakesReleased), 1);
  EXPECT_EQ(recorder_.Count(PlantEvent::kBrakesClosed), 1);
}

TEST_F(Lockstep, AnotherLayoutEndsTheProgramWithOneLineAndExit2AndNoAnswer) {
  controller_.Sync(0, static_cast<std::uint8_t>(bus::layout::kLayoutId + 1));
  endpoint_->Poll(0);
  EXPECT_EQ(endpoint_->outcome(), Outcome::kWrongLayout);
  EXPECT_EQ(ExitStatus(endpoint_->outcome()), 2);
  EXPECT_NE(endpoint_->failure().find("layout " + std::to_string(bus::layout::kLayoutId)), std::string::npos);
  EXPECT_EQ(endpoint_->failure().find('\n'), std::string::npos);
  EXPECT_TRUE(wire_.controller.inbox.empty());
}

TEST_F(Lockstep, ACycleNumberThatGoesBackRestartsTheArm) {
  Enable();
  for (std::uint32_t k = 2; k < 20; ++k) Cycle(k, DriveRequest::kEnable, kTau_Nm);
  const Answer answer = SyncAndTake(5);
  EXPECT_NEAR(answer.joints[0].position_rad, 0.25, 0.5 * kLsb_rad + 1e-7);
  EXPECT_EQ(answer.joints[0].velocity_radps, 0.0);
  EXPECT_EQ(answer.joints[0].state, DriveState::kOff);
  EXPECT_EQ(recorder_.Plants().back().t_s, 0.0);
  EXPECT_EQ(recorder_.Count(PlantEvent::kControllerRestarted), 1);
}

TEST_F(Lockstep, ANewControllerWithFreshCountersIsServedFromItsFirstFrames) {
  Enable();
  for (std::uint32_t k = 2; k < 60; ++k) Cycle(k, DriveRequest::kEnable, kTau_Nm);
  FakeController second(wire_.controller);
  std::vector<DriveState> states;
  for (std::uint32_t k = 0; k < 4; ++k) {
    second.Sync(k);
    endpoint_->Poll(0);
    wire_.controller.inbox.clear();
    second.Command(k, k == 0 ? DriveRequest::kReady : DriveRequest::kEnable);
    endpoint_->Poll(0);
    states.push_back(state());
  }
  EXPECT_EQ(states,
            (std::vector{DriveState::kOff, DriveState::kReady, DriveState::kEnabled, DriveState::kEnabled}));
  EXPECT_EQ(endpoint_->rejected(), 0U);
}

TEST_F(Lockstep, TheSameSyncFrameTwiceIsAnsweredOnce) {
  Enable();
  bus::Encoder encoder;
  encoder.Sync({0});
  encoder.Sync({1});
  const bus::Frame sync = encoder.Sync({2});
  controller_.Send(sync);
  controller_.Send(sync);
  endpoint_->Poll(0);
  EXPECT_EQ(controller_.Take().joints.size(), 2U);
  EXPECT_EQ(endpoint_->robot().time_s(), 3 * kPeriod_s);
  EXPECT_EQ(endpoint_->rejected(), 1U);
}

TEST_F(Lockstep, FramesOfNobodysConcernAreIgnored) {
  bus::Frame stranger;
  stranger.id = 0x7FF;
  stranger.size = 8;
  controller_.Send(stranger);
  EXPECT_FALSE(endpoint_->Poll(0));
  controller_.Command(0, DriveRequest::kReady);  // before any SYNC
  endpoint_->Poll(0);
  EXPECT_EQ(endpoint_->syncs(), 0);
  EXPECT_EQ(endpoint_->rejected(), 2U);
  EXPECT_TRUE(wire_.controller.inbox.empty());
}

TEST_F(Lockstep, TheWrenchStopsInItsWindowCountedFromEnabling) {
  Scenario scenario = TwoJointScenario();
  scenario.sensors.wrench_lost_from_s = 0.010;
  scenario.sensors.wrench_lost_to_s = 0.015;
  Start(scenario);
  std::vector<std::uint32_t> lost;
  for (std::uint32_t k = 0; k < 30; ++k) {
    const Answer answer = Cycle(k, k == 0 ? DriveRequest::kReady : DriveRequest::kEnable);
    EXPECT_EQ(answer.joints.size(), 2U);
    if (answer.wrenches.empty()) lost.push_back(k);
  }
  EXPECT_EQ(lost, (std::vector<std::uint32_t>{12, 13, 14, 15, 16})) << "enabled at 2T";
  EXPECT_EQ(recorder_.Count(PlantEvent::kWrenchLost), 1);
  EXPECT_EQ(recorder_.Count(PlantEvent::kWrenchBack), 1);
}

TEST_F(Lockstep, TheWrenchIsTheForceOnTheRobotInBaseAxes) {
  Scenario scenario = TwoJointScenario();
  scenario.sensors.force_noise_N = 0.0;
  body_.force_N = Eigen::Vector3d(1.0, -2.0, 8.25);
  Start(scenario);
  const Answer answer = SyncAndTake(0);
  ASSERT_EQ(answer.wrenches.size(), 1U);
  EXPECT_NEAR(answer.wrenches[0].force_N[0], 1.0, 1e-6);
  EXPECT_NEAR(answer.wrenches[0].force_N[1], -2.0, 1e-6);
  EXPECT_NEAR(answer.wrenches[0].force_N[2], 8.25, 1e-6);
}

TEST_F(Lockstep, EqualSeedsGiveEqualFramesAndAnotherSeedDoesNot) {
  const auto run = [](std::int64_t seed) {
    Scenario scenario = TwoJointScenario();
    scenario.seed = seed;
    test::FakeWire wire;
    RotorBody body;
    VectorRecorder recorder;
    LockstepEndpoint endpoint(scenario, wire.plant, body, recorder);
    FakeController controller(wire.controller);
    std::vector<std::uint8_t> bytes;
    for (std::uint32_t k = 0; k < 100; ++k) {
      controller.Sync(k);
      endpoint.Poll(0);
      for (const bus::Frame& frame : controller.Take().frames) {
        bytes.insert(bytes.end(), frame.data.begin(), frame.data.end());
      }
      controller.Command(k, k == 0 ? DriveRequest::kReady : DriveRequest::kEnable, 0.3 * k);
      endpoint.Poll(0);
    }
    return bytes;
  };
  const auto first = run(1);
  EXPECT_EQ(first, run(1));
  EXPECT_NE(first, run(2));
}

TEST_F(Lockstep, ADivergingArmClosesTheBrakesAndEndsWithExit3AndOneLine) {
  Enable();
  body_.sick_from_s = 5 * kPeriod_s;
  for (std::uint32_t k = 2; k < 10 && endpoint_->outcome() == Outcome::kRunning; ++k) {
    Cycle(k, DriveRequest::kEnable, kTau_Nm);
  }
  EXPECT_EQ(endpoint_->outcome(), Outcome::kDiverged);
  EXPECT_EQ(ExitStatus(endpoint_->outcome()), 3);
  EXPECT_EQ(state(), DriveState::kFault);
  EXPECT_TRUE(endpoint_->robot().drives().braked());
  EXPECT_NE(endpoint_->failure().find("motor 1 speed is not finite at 0.005 s"), std::string::npos);
  EXPECT_EQ(recorder_.Count(PlantEvent::kDiverged), 1);
}

TEST_F(Lockstep, AnInterfaceThatGoesAwayEndsWithExit3) {
  SyncAndTake(0);
  wire_.plant.Cut();
  endpoint_->Poll(0);
  EXPECT_EQ(endpoint_->outcome(), Outcome::kBusLost);
  EXPECT_EQ(ExitStatus(endpoint_->outcome()), 3);
}

}  // namespace
}  // namespace reed::plant
