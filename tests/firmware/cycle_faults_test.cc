// The whole loop without a clock: what the arm does when its bus or its drives misbehave.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reed/tests/firmware/sil_rig.h"

namespace reed {
namespace {

using mode::Mode;
using protect::Reason;
using test::SilRig;

constexpr int kJoint = 1;  // 0-based, the one that misbehaves

Scenario PressKnown() { return LoadScenario("press_known"); }

bool IsJoint(const bus::Frame& frame, int joint) {
  return frame.id == bus::layout::kJointState[static_cast<std::size_t>(joint)].id;
}

/// Torque zero at once and for ever, brakes closed once the drives have heard of it.
void ExpectFault(SilRig& rig, Reason reason) {
  EXPECT_EQ(rig.mode(), Mode::kFault);
  EXPECT_EQ(rig.trip(), reason) << protect::Text(static_cast<int>(rig.trip()));
  EXPECT_TRUE(rig.TorqueIsZero());
  bool noted = false;
  for (int i = 0; i < rig.snapshot().num_events; ++i)
    noted = noted || rig.snapshot().events[static_cast<std::size_t>(i)].code == static_cast<int>(reason);
  EXPECT_TRUE(noted) << "the cause is among the events of its cycle";
  rig.Run();
  rig.Run();
  for (int i = 0; i < 20; ++i) {
    rig.Run();
    EXPECT_TRUE(rig.TorqueIsZero());
    EXPECT_TRUE(rig.drives().braked());
    EXPECT_TRUE(rig.truth().braked);
  }
  EXPECT_EQ(rig.mode(), Mode::kFault);
}

/// Runs on until the arm is no longer active; the cycles it took, or -1.
int CyclesUntilFault(SilRig& rig, int at_most) {
  for (int i = 1; i <= at_most; ++i) {
    rig.Run();
    if (rig.mode() != Mode::kActive) return i;
  }
  return -1;
}

TEST(Cycle, AFaultTouchesNoHeapEither) {
  SilRig rig(PressKnown());
  ASSERT_TRUE(rig.RunActive(0.1));
  rig.on_the_way = [](std::uint32_t, bus::Frame& frame) { return !IsJoint(frame, kJoint); };
  EXPECT_GT(CyclesUntilFault(rig, 40), 0);
  EXPECT_EQ(rig.heap_calls(), 0);
}

/// A joint's frames are lost for a number of cycles.
class LostJoint : public ::testing::TestWithParam<int> {};

TEST_P(LostJoint, TheReactionIsGradedByTheAge) {
  const int lost = GetParam();
  const Scenario scenario = PressKnown();
  const int hold = scenario.limits.hold_age_cycles, stop = scenario.limits.stop_age_cycles;
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(1.5));
  const std::uint32_t from = rig.cycle_number();
  rig.on_the_way = [&](std::uint32_t cycle, bus::Frame& frame) {
    return !IsJoint(frame, kJoint) || cycle >= from + static_cast<std::uint32_t>(lost);
  };
  for (int age = 1; age <= lost && age <= 2 * stop; ++age) {
    rig.Run();
    ASSERT_EQ(rig.mode(), Mode::kActive) << "age " << age;
    EXPECT_EQ(rig.snapshot().measured.age[kJoint], age);
    EXPECT_EQ(rig.LimitActs(Reason::kHeldMeasurement), age > hold && age <= stop) << "age " << age;
    EXPECT_EQ(rig.LimitActs(Reason::kRampDown), age > stop) << "age " << age;
    EXPECT_TRUE(age < 2 * stop || rig.TorqueIsZero()) << "the ramp has ended";
  }
  rig.Run();
  if (lost > 2 * stop) {
    ExpectFault(rig, Reason::kStaleMeasurement);
  } else {
    EXPECT_EQ(rig.mode(), Mode::kActive);
    EXPECT_EQ(rig.snapshot().measured.age[kJoint], 0);
    EXPECT_FALSE(rig.LimitActs(Reason::kHeldMeasurement) || rig.LimitActs(Reason::kRampDown));
  }
  EXPECT_EQ(rig.heap_calls(), 0);
}
INSTANTIATE_TEST_SUITE_P(Cycle, LostJoint, ::testing::Values(1, 2, 3, 10, 12, 40));

TEST(Cycle, DamagedFramesAreCountedAndRiddenOut) {
  SilRig rig(PressKnown());
  ASSERT_TRUE(rig.RunActive(0.5));
  const std::uint32_t from = rig.cycle_number();
  rig.on_the_way = [&](std::uint32_t cycle, bus::Frame& frame) {
    if (IsJoint(frame, kJoint) && cycle < from + 2) frame.data[6] ^= 0x5A;
    return true;
  };
  for (int i = 0; i < 50; ++i) rig.Run();
  EXPECT_EQ(rig.mode(), Mode::kActive);
  EXPECT_EQ(rig.snapshot().bus.crc_errors, 2);
}

TEST(Cycle, FramesThatStayDamagedStopTheArmLikeLostOnes) {
  SilRig rig(PressKnown());
  ASSERT_TRUE(rig.RunActive(0.5));
  rig.on_the_way = [&](std::uint32_t, bus::Frame& frame) {
    if (IsJoint(frame, kJoint)) frame.data[6] ^= 0x5A;
    return true;
  };
  EXPECT_EQ(CyclesUntilFault(rig, 100), 2 * PressKnown().limits.stop_age_cycles + 1);
  ExpectFault(rig, Reason::kStaleMeasurement);
}

TEST(Cycle, AnotherControllersCommandIsAFaultInTheSameCycle) {
  SilRig rig(PressKnown());
  ASSERT_TRUE(rig.RunActive(0.5));
  bus::FrameEncoder other;
  rig.injected = other.Command({0, bus::DriveRequest::kEnable, {}});
  rig.Run();
  ExpectFault(rig, Reason::kForeignController);
}

TEST(Cycle, AnotherControllerBeforeTheStartKeepsTheBrakesClosed) {
  SilRig rig(PressKnown());
  bus::FrameEncoder other;
  rig.injected = other.Sync({5});
  rig.Run();
  ExpectFault(rig, Reason::kForeignController);
}

TEST(Cycle, ADriveOfAJointThatTheArmDoesNotHaveIsAFault) {
  for (const bool active : {false, true}) {
    SilRig rig(PressKnown());
    if (active) {
      ASSERT_TRUE(rig.RunActive(0.1));
    }
    bus::FrameEncoder sixth;
    rig.injected = sixth.JointState(5, {});
    rig.Run();
    ExpectFault(rig, Reason::kUnexpectedJoint);
    EXPECT_EQ(rig.trip_place().joint, 5);
  }
}

TEST(Cycle, AnArmOfWhichAJointIsNeverHeardIsWaitedForForTwoSeconds) {
  SilRig rig(PressKnown());
  rig.on_the_way = [](std::uint32_t, bus::Frame& frame) { return !IsJoint(frame, kJoint); };
  for (int k = 0; k < 1990; ++k) rig.Run();
  EXPECT_EQ(rig.mode(), Mode::kOff);
  for (int k = 0; k < 20; ++k) rig.Run();
  EXPECT_EQ(rig.mode(), Mode::kFault);
  EXPECT_EQ(rig.trip(), Reason::kStaleMeasurement);
  EXPECT_EQ(rig.trip_place().joint, kJoint);

  SilRig watching(PressKnown(), false);
  watching.on_the_way = rig.on_the_way;
  for (int k = 0; k < 2100; ++k) watching.Run();
  EXPECT_EQ(watching.mode(), Mode::kOff) << "who only watches may go on";
}

/// The joint's frames again, with other contents but sound to every check.
class Rewriter {
 public:
  explicit Rewriter(SilRig& rig) {
    rig.on_the_way = [this](std::uint32_t, bus::Frame& frame) {
      if (!IsJoint(frame, kJoint)) return true;
      bus::JointStateMessage message = decoder_.Decode(frame).joint_state;
      if (change) change(message);
      frame = encoder_.JointState(kJoint, message);
      return true;
    };
  }
  std::function<void(bus::JointStateMessage&)> change;

 private:
  bus::Decoder decoder_;
  bus::FrameEncoder encoder_;
};

TEST(Cycle, ADriveThatReportsAFaultOrAClosedBrakeIsAFaultInTheSameCycle) {
  for (const bus::DriveState state : {bus::DriveState::kFault, bus::DriveState::kBraked}) {
    SilRig rig(PressKnown());
    Rewriter rewriter(rig);
    ASSERT_TRUE(rig.RunActive(0.5));
    rewriter.change = [state](bus::JointStateMessage& message) { message.state = state; };
    rig.Run();
    ExpectFault(rig, Reason::kDriveFault);
  }
}

TEST(Cycle, AnAbsurdPositionOrSpeedIsAFaultInTheSameCycle) {
  const std::pair<std::function<void(bus::JointStateMessage&)>, Reason> absurd[] = {
      {[](bus::JointStateMessage& m) { m.position_rad = 3.0; }, Reason::kJointPosition},
      {[](bus::JointStateMessage& m) { m.velocity_radps = -30.0; }, Reason::kJointSpeed}};
  for (const auto& [change, reason] : absurd) {
    SilRig rig(PressKnown());
    Rewriter rewriter(rig);
    ASSERT_TRUE(rig.RunActive(0.5));
    rewriter.change = change;
    rig.Run();
    ExpectFault(rig, reason);
  }
}

/// Until the controller asks the drives to be enabled and all have done so but one, whose brake stays closed.
void EnableAllButOne(SilRig& rig, Rewriter& rewriter) {
  rewriter.change = [](bus::JointStateMessage& message) {
    if (message.state == bus::DriveState::kEnabled) message.state = bus::DriveState::kReady;
  };
  for (int i = 0; i < 200 && rig.drives().state() != bus::DriveState::kEnabled; ++i) rig.Run();
  for (int i = 0; i < 10; ++i) rig.Run();
  ASSERT_EQ(rig.drives().state(), bus::DriveState::kEnabled);
  ASSERT_EQ(rig.mode(), Mode::kReady);
  ASSERT_FALSE(rig.TorqueIsZero());
}

TEST(Cycle, ADriveThatDoesNotGetEnabledIsWaitedForForASecond) {
  SilRig rig(PressKnown());
  Rewriter rewriter(rig);
  EnableAllButOne(rig, rewriter);
  int waited = 0;
  for (; waited < 2000 && rig.mode() == Mode::kReady; ++waited) rig.Run();
  EXPECT_NEAR(waited, 1000, 15);
  ExpectFault(rig, Reason::kDriveFault);
}

TEST(Cycle, WhileTheDrivesAreBeingEnabledTheLimitsHoldAlready) {
  const std::pair<std::function<void(bus::JointStateMessage&)>, Reason> wrong[] = {
      {[](bus::JointStateMessage& m) { m.position_rad = 3.0; }, Reason::kJointPosition},
      {[](bus::JointStateMessage& m) { m.velocity_radps = -30.0; }, Reason::kJointSpeed},
      {[](bus::JointStateMessage& m) { m.state = bus::DriveState::kFault; }, Reason::kDriveFault}};
  for (const auto& [change, reason] : wrong) {
    SilRig rig(PressKnown());
    Rewriter rewriter(rig);
    EnableAllButOne(rig, rewriter);
    rewriter.change = change;
    rig.Run();
    ExpectFault(rig, reason);
  }
}

TEST(Cycle, AMeasurementThatIsNoNumberIsNeverUsed) {
  SilRig rig(PressKnown());
  Rewriter rewriter(rig);
  ASSERT_TRUE(rig.RunActive(0.5));
  rewriter.change = [](bus::JointStateMessage& m) {
    m.position_rad = std::numeric_limits<double>::quiet_NaN();
  };
  EXPECT_EQ(CyclesUntilFault(rig, 100), 2 * PressKnown().limits.stop_age_cycles + 1);
  EXPECT_TRUE(std::isfinite(rig.snapshot().measured.position[kJoint]));
  EXPECT_GT(rig.snapshot().bus.out_of_range, 0);
  ExpectFault(rig, Reason::kStaleMeasurement);
}

TEST(Cycle, ALawThatTracksTheForceStopsWhenTheForceIsNoLongerMeasured) {
  SilRig rig(PressKnown());
  ASSERT_TRUE(rig.RunActive(1.5));
  rig.on_the_way = [](std::uint32_t, bus::Frame& frame) { return frame.id != bus::layout::kWrench.id; };
  EXPECT_EQ(CyclesUntilFault(rig, 100), 2 * PressKnown().limits.stop_age_cycles + 1);
  ExpectFault(rig, Reason::kStaleWrench);
}

TEST(Cycle, ACommandThatTheBusCutsIsAnEventOnceInARow) {
  Scenario scenario = PressKnown();
  for (double& limit : scenario.arm.torque_limit_Nm) limit = 9000.0;  // past the rules of the files
  for (double& gain : scenario.control.K_d) gain = 1e6;
  SilRig rig(scenario);
  int events = 0, cut = 0;
  double wanted = 0.0;
  for (int i = 0; i < 1000 && rig.mode() != Mode::kFault; ++i) {
    rig.Run();
    bool beyond = false;
    for (const double tau : rig.snapshot().control.tau) beyond = beyond || std::abs(tau) >= 2048.0;
    cut += beyond ? 1 : 0;
    for (int k = 0; k < rig.snapshot().num_events; ++k) {
      const telemetry::Event& event = rig.snapshot().events[static_cast<std::size_t>(k)];
      if (event.code != static_cast<int>(Reason::kCommandCut)) continue;
      EXPECT_TRUE(beyond);
      wanted = event.value;
      ++events;
    }
  }
  EXPECT_GT(std::abs(wanted), 2047.0) << "the value is what was wanted, not what the drive got";
  EXPECT_GE(events, 1);
  EXPECT_LE(events, cut);
}

TEST(Cycle, MissedCyclesInARowAreAFault) {
  SilRig rig(PressKnown());
  ASSERT_TRUE(rig.RunActive(0.1));
  CycleState loop;
  loop.missed_in_row_exceeded = true;
  loop.missed_in_row = 21;
  rig.Run(loop);
  ExpectFault(rig, Reason::kMissedCycles);
}

TEST(Cycle, AnAbsenceIsAFaultBeforeAnyAnswerAndKeepsItsName) {
  SilRig rig(PressKnown());
  ASSERT_TRUE(rig.RunActive(1.5));
  rig.on_the_way = [](std::uint32_t, bus::Frame&) { return false; };
  CycleState loop;
  loop.missed_in_row_exceeded = true;
  loop.missed_in_row = 4242;
  rig.Run(loop);  // back, but its bus is full of others' frames
  ExpectFault(rig, Reason::kMissedCycles);
  EXPECT_EQ(rig.trip_place().value, 4242.0);
}

}  // namespace
}  // namespace reed
