// The arm as seen through frames: which values are used and how old they are.
#include <tuple>

#include "reed/rt/monotonic.h"
#include "reed/tests/firmware/arm_bus_rig.h"

namespace reed {
namespace {

TEST_F(ArmBusTest, BeforeAnyAnswerEveryValueIsInfinitelyOld) {
  Sync(0);
  EXPECT_FALSE(Receive());
  EXPECT_EQ(seen().OldestAge(), kNever);
  EXPECT_EQ(seen().wrench_age, kNever);
}

TEST_F(ArmBusTest, AFullAnswerIsFreshAndIsWhatTheJointsSaid) {
  GoodCycle(7);
  for (int i = 0; i < kN; ++i) {
    EXPECT_NEAR(seen().theta[i], Position(i, 7), 1e-7);  // float32 on the wire
    EXPECT_NEAR(seen().theta_dot[i], 0.1 * i, 1e-7);
    EXPECT_EQ(seen().age[static_cast<std::size_t>(i)], 0);
  }
  EXPECT_EQ(seen().wrench_age, 0);
  EXPECT_NEAR(seen().force.z(), 5.0, 1e-6);
  EXPECT_TRUE(seen().AllDrives(DriveState::kReady));
  EXPECT_FALSE(seen().AllDrives(DriveState::kEnabled));
}

TEST_F(ArmBusTest, TheOrderWithinABatchDoesNotMatter) {
  Sync(3);
  Put(Wrench(3, 5.0));
  for (const int i : {2, 0, 1}) Put(Joint(i, 3, Position(i, 3)));
  EXPECT_TRUE(Receive());
  EXPECT_EQ(seen().OldestAge(), 0);
  EXPECT_EQ(seen().wrench_age, 0);
}

TEST_F(ArmBusTest, AJointThatFallsSilentAgesByOnePerCycleAndKeepsItsValue) {
  GoodCycle(0);
  for (std::uint32_t k = 1; k <= 40; ++k) {
    Sync(k);
    PutAll(k, 1);
    EXPECT_FALSE(Receive());
    EXPECT_EQ(seen().age[1], static_cast<int>(k));
    EXPECT_EQ(seen().age[0], 0);
    EXPECT_EQ(seen().OldestJoint(), 1);
    EXPECT_NEAR(seen().theta[1], Position(1, 0), 1e-7);
  }
}

TEST_F(ArmBusTest, ALateFrameIsUsedWithItsTrueAgeAndCounted) {
  GoodCycle(20);
  const bus::Frame late = Joint(1, 21, Position(1, 21));
  Sync(21);
  PutAll(21, 1);
  EXPECT_FALSE(Receive());
  Sync(22);
  Put(late);
  PutAll(22, 1);
  EXPECT_FALSE(Receive()) << "the answer to SYNC 21 is no answer to SYNC 22";
  EXPECT_EQ(seen().age[1], 1);
  EXPECT_NEAR(seen().theta[1], Position(1, 21), 1e-7);
  EXPECT_EQ(bus_.late_frames(), 1);
}

TEST_F(ArmBusTest, AFrameOlderThanWhatIsKnownIsNotUsed) {
  for (std::uint32_t k = 0; k < 3; ++k) GoodCycle(k);
  Sync(3);
  PutAll(3);
  Put(Joint(1, 0, 1.0));  // cycle_low4 says SYNC 0
  EXPECT_TRUE(Receive());
  EXPECT_NEAR(seen().theta[1], Position(1, 3), 1e-7);
  EXPECT_EQ(seen().age[1], 0);
}

TEST_F(ArmBusTest, TheCycleNumberWrapsInFourBitsWithoutANotch) {
  for (std::uint32_t k = 0; k < 40; ++k) {
    GoodCycle(k);
    EXPECT_EQ(seen().OldestAge(), 0);
  }
  EXPECT_EQ(bus_.late_frames(), 0);
}

TEST_F(ArmBusTest, ALostWrenchAgesWhileTheJointsStayFresh) {
  GoodCycle(0);
  for (std::uint32_t k = 1; k <= 30; ++k) {
    Sync(k);
    PutAll(k);
    EXPECT_TRUE(Receive());
    EXPECT_EQ(seen().wrench_age, static_cast<int>(k));
    EXPECT_EQ(seen().OldestAge(), 0);
    EXPECT_NEAR(seen().force.z(), 5.0, 1e-6);
  }
}

/// Whether the first wrench after a loss is seen by its own cycle or by the next is a race on a real bus.
TEST_F(ArmBusTest, TheFirstWrenchAfterALossMakesTheSameMeasurementsWhetherItIsSeenAtOnceOrACycleLater) {
  for (const bool at_once : {true, false}) {
    test::FakeWire wire;
    bus::FrameEncoder peer;
    bus::ReedControllerCodec codec;
    ArmBus<1> bus(wire.controller, codec);
    const auto put = [&](const bus::Frame& frame) { wire.plant.Send(std::span(&frame, 1)); };
    const auto joint = [&](std::uint32_t k) {
      return peer.JointState(0, {0.0, 0.0, 0.0, bus::DriveState::kReady, static_cast<std::uint8_t>(k)});
    };
    telemetry::Snapshot tap;
    std::vector<int> ages;
    std::vector<double> forces;
    for (std::uint32_t k = 0; k < 8; ++k) {
      const bool lost = k >= 2 && k < 5;
      bus.SendSync(k, tap);
      put(joint(k));
      if (!lost && (k != 5 || at_once)) put(peer.Wrench({k, {1.0 + k, 0.0, 0.0}, {}, false}));
      bus.Receive(0, tap);
      if (k == 5 && !at_once) put(peer.Wrench({k, {1.0 + k, 0.0, 0.0}, {}, false}));
      ages.push_back(bus.measurement().wrench_age);
      forces.push_back(bus.measurement().force.x());
    }
    EXPECT_EQ(ages, (std::vector<int>{0, 0, 1, 2, 3, 4, 0, 0})) << at_once;
    EXPECT_EQ(forces, (std::vector<double>{1, 2, 2, 2, 2, 2, 7, 8})) << at_once;
  }
}

TEST_F(ArmBusTest, AWrenchThatIsAlwaysOneCycleLateIsUsedWithAgeOne) {
  for (std::uint32_t k = 0; k < 10; ++k) {
    Sync(k);
    if (k > 0) Put(Wrench(k - 1, k));
    PutAll(k);
    EXPECT_TRUE(Receive());
    if (k > 1) {
      EXPECT_EQ(seen().wrench_age, 1) << k;
    }
  }
}

/// Some waits are in vain and take as long as they may.
class HeldUp final : public bus::Transport {
 public:
  HeldUp(bus::Transport& inner, int first_in_vain, int last_in_vain)
      : inner_(inner), first_(first_in_vain), last_(last_in_vain) {}
  int Receive(std::span<bus::Frame> out, int wanted, std::int64_t deadline_ns) noexcept override {
    ++waits;
    if (waits < first_ || waits > last_) return inner_.Receive(out, wanted, deadline_ns);
    rt::MonotonicClock{}.SleepUntil(deadline_ns);
    return 0;
  }
  int Send(std::span<const bus::Frame> frames) noexcept override { return inner_.Send(frames); }
  bool alive() const noexcept override { return true; }
  const bus::TransportCounters& counters() const noexcept override { return inner_.counters(); }
  std::string kind() const override { return "held up"; }
  std::string interface() const override { return ""; }

  int waits = 0;

 private:
  bus::Transport& inner_;
  int first_, last_;
};

/// A cycle that has a hundred seconds for its answers and begins so much later than now.
bool ReceiveIn(ArmBus<kN>& bus, telemetry::Snapshot& tap, std::int64_t begins_in_ns = 0) {
  tap.time_ns = rt::NowNs() + begins_in_ns;
  bus.SendSync(0, tap);
  return bus.Receive(tap.time_ns + 100 * rt::kNsPerSecond, tap);
}

TEST_F(ArmBusTest, JointsThatAreHeldUpAreWaitedForAndThenTheirWrench) {
  HeldUp transport(wire_.controller, 1, 2);
  bus::ReedControllerCodec codec;
  ArmBus<kN> bus(transport, codec);
  PutAll(0);
  Put(Wrench(0, 5.0));
  EXPECT_TRUE(ReceiveIn(bus, tap_));
  EXPECT_GE(rt::NowNs() - tap_.time_ns, rt::kNsPerSecond / 5);
  EXPECT_EQ(bus.measurement().wrench_age, 0);
}

TEST_F(ArmBusTest, AWrenchThatDoesNotComeWithTheJointsIsWaitedForOnce) {
  HeldUp transport(wire_.controller, 2, 100);
  bus::ReedControllerCodec codec;
  ArmBus<kN> bus(transport, codec);
  PutAll(0);
  EXPECT_TRUE(ReceiveIn(bus, tap_));
  EXPECT_EQ(transport.waits, 2);
}

TEST_F(ArmBusTest, ATransportThatGivesUpBeforeItsTimeIsNotAskedAgain) {
  HeldUp transport(wire_.controller, 0, 0);
  bus::ReedControllerCodec codec;
  ArmBus<kN> bus(transport, codec);
  EXPECT_FALSE(ReceiveIn(bus, tap_, rt::kNsPerSecond))
      << "later, so that no delay of the host fills the wait";
  EXPECT_EQ(transport.waits, 1);
}

TEST_F(ArmBusTest, TheTapHoldsEveryFrameInTheOrderInWhichItPassed) {
  GoodCycle(0);
  Eigen::Vector3d tau(1.0, -2.0, 3.0);
  bus_.SendCommand({DriveRequest::kEnable, tau}, 0, tap_);
  ASSERT_EQ(tap_.num_frames, kN + 3);
  std::vector<telemetry::RecordedFrame> frames;
  tap_.ForEachFrame([&](const telemetry::RecordedFrame& one) { frames.push_back(one); });
  EXPECT_EQ(frames[0].direction, telemetry::Direction::kSent);
  EXPECT_EQ(frames[0].frame.id, bus::layout::kSync.id);
  for (std::size_t i = 1; i <= kN + 1; ++i) EXPECT_EQ(frames[i].direction, telemetry::Direction::kReceived);
  EXPECT_EQ(frames[kN + 2].frame.id, bus::layout::kCommand.id);

  bus::Decoder decoder;
  const bus::Decoded command = decoder.Decode(frames[kN + 2].frame);
  EXPECT_EQ(command.command.request, bus::DriveRequest::kEnable);
  for (std::size_t i = 0; i < kN; ++i)
    EXPECT_EQ(command.command.torque_Nm[i], tau[static_cast<Eigen::Index>(i)]);
  for (std::size_t i = kN; i < command.command.torque_Nm.size(); ++i)
    EXPECT_EQ(command.command.torque_Nm[i], 0.0) << "a joint that is not there gets no torque";
}

TEST_F(ArmBusTest, AWrenchOfTheCycleBeforeTheNumberWrapsIsOneCycleLate) {
  constexpr std::uint32_t kLast = 0xFFFFFFFF;
  GoodCycle(kLast - 1);
  Sync(kLast);
  Put(Wrench(kLast - 1, 5.0));
  PutAll(kLast);
  Receive();
  Sync(0);
  Put(Wrench(kLast, 7.0));
  PutAll(0);
  EXPECT_TRUE(Receive());
  EXPECT_EQ(seen().wrench_age, 1);
  EXPECT_EQ(seen().force[2], 7.0);
  EXPECT_EQ(seen().OldestAge(), 0);
}

TEST_F(ArmBusTest, ATorqueBeyondWhatAFrameCarriesIsNamedByItsJoint) {
  Command<kN> command;
  command.request = DriveRequest::kEnable;
  Sync(0);
  EXPECT_EQ(bus_.SendCommand(command, 0, tap_), -1);
  for (const double beyond : {9000.0, -9000.0}) {
    command.torque.setConstant(1.0);
    command.torque[1] = beyond;
    EXPECT_EQ(bus_.SendCommand(command, 0, tap_), 1);
  }
}

}  // namespace
}  // namespace reed
