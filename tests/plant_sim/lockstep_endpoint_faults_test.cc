// What a plant in lockstep does about damaged frames, other controllers, a diverging arm and a lost bus.
#include <limits>

#include "reed/tests/plant_sim/lockstep_rig.h"

namespace reed::plant {
namespace {

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

TEST_F(Lockstep, AnotherLayoutEndsTheProgramWithOneLineAndExit2AndNoAnswer) {
  controller_.Sync(0, static_cast<std::uint8_t>(bus::layout::kLayoutId + 1));
  endpoint_->Poll(0);
  EXPECT_EQ(endpoint_->outcome(), Outcome::kWrongLayout);
  EXPECT_EQ(ExitStatus(endpoint_->outcome()), 2);
  EXPECT_NE(endpoint_->failure().find("layout " + std::to_string(bus::layout::kLayoutId)), std::string::npos);
  EXPECT_EQ(endpoint_->failure().find('\n'), std::string::npos);
  EXPECT_TRUE(wire_.controller.inbox().empty());
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

TEST_F(Lockstep, ACycleNumberThatWrapsIsTheNextOneAndNoRestart) {
  constexpr std::uint32_t kFirst = 0xFFFFFFFD;  // three before the wrap
  Cycle(kFirst, DriveRequest::kReady);
  for (std::uint32_t k = 1; k < 8; ++k) Cycle(kFirst + k, DriveRequest::kEnable, kTau_Nm);
  EXPECT_EQ(state(), DriveState::kEnabled);
  EXPECT_EQ(recorder_.Count(PlantEvent::kControllerRestarted), 0);
  EXPECT_EQ(endpoint_->robot().time_s(), 8 * kPeriod_s);
  EXPECT_EQ(recorder_.Plants().back().cycle, (std::int64_t{1} << 32) + 4) << "the record counts on";
  EXPECT_EQ(recorder_.Plants().back().utime, 1000 * ((std::int64_t{1} << 32) + 4));
}

TEST_F(Lockstep, ACycleNumberThatLeapsIsAnotherControllers) {
  for (std::uint32_t k = 3'000'000'000; k < 3'000'000'004; ++k) SyncAndTake(k);
  SyncAndTake(0);  // a controller that was started anew: 1.3 thousand million ahead, modulo 2^32
  EXPECT_EQ(recorder_.Count(PlantEvent::kControllerRestarted), 1);
  EXPECT_EQ(recorder_.Plants().back().t_s, 0.0);
}

TEST_F(Lockstep, ANewControllerWithFreshCountersIsServedFromItsFirstFrames) {
  Enable();
  for (std::uint32_t k = 2; k < 60; ++k) Cycle(k, DriveRequest::kEnable, kTau_Nm);
  FakeController second(wire_.controller);
  std::vector<DriveState> states;
  for (std::uint32_t k = 0; k < 4; ++k) {
    second.Sync(k);
    endpoint_->Poll(0);
    wire_.controller.inbox().clear();
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
  bus::FrameEncoder encoder;
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
  EXPECT_TRUE(wire_.controller.inbox().empty());
}

TEST_F(Lockstep, ADamagedStateFrameIsNoOtherArm) {
  bus::FrameEncoder another_arm;
  bus::Frame state = another_arm.JointState(0, {});
  state.data[8] ^= 1U;
  controller_.Send(state);
  controller_.Sync(0);
  endpoint_->Poll(0);
  EXPECT_EQ(recorder_.Count(PlantEvent::kAnotherArm), 0);
  EXPECT_EQ(endpoint_->rejected(), 1U);
}

TEST_F(Lockstep, AnotherArmOnTheBusIsToldOnceAndAnswersGoOn) {
  bus::FrameEncoder another_arm;
  for (std::uint32_t k = 0; k < 3; ++k) {
    EXPECT_EQ(recorder_.Count(PlantEvent::kAnotherArm), k > 0 ? 1 : 0);
    controller_.Sync(k);
    controller_.Send(another_arm.JointState(0, {}));
    endpoint_->Poll(0);
  }
  EXPECT_EQ(recorder_.Count(PlantEvent::kAnotherArm), 1);
  EXPECT_EQ(endpoint_->syncs(), 3);
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
