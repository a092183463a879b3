// What is encoded is decoded: every signal, its bounds, and numbers that do not fit.
#include "reed/bus/codec/messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace reed::bus {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// What a 32-bit float makes of a number; the wire carries no more.
double Float32(double value) { return static_cast<double>(static_cast<float>(value)); }

/// The ranges of bus/reed.dbc, written down a second time.
constexpr double kPosition = 32, kVelocity = 64, kTorque = 2048, kForce = 4096, kMoment = 1024;

class Messages : public testing::Test {
 protected:
  double Within(double bound) { return std::uniform_real_distribution<double>(-bound, bound)(random_); }
  std::uint32_t Any32() { return static_cast<std::uint32_t>(random_()); }

  std::mt19937 random_{7};
  FrameEncoder encoder_;
  Decoder decoder_;
};

TEST_F(Messages, SyncSurvivesTheWire) {
  for (int i = 0; i < 300; ++i) {
    const SyncMessage sent{Any32(), static_cast<std::uint8_t>(random_())};
    const Decoded got = decoder_.Decode(encoder_.Sync(sent));
    ASSERT_EQ(got.reject, Reject::kNone);
    ASSERT_EQ(got.kind, MessageKind::kSync);
    ASSERT_EQ(got.sync.cycle, sent.cycle);
    ASSERT_EQ(got.sync.layout, sent.layout);
  }
}

TEST_F(Messages, SyncCarriesTheLayoutOfThisBuildUnlessToldOtherwise) {
  EXPECT_EQ(decoder_.Decode(encoder_.Sync({})).sync.layout, layout::kLayoutId);
  EXPECT_EQ(layout::kLayoutId, std::stoi(std::string(layout::kDbcSha256.substr(0, 2)), nullptr, 16));
}

TEST_F(Messages, JointStateSurvivesTheWireForEveryJointAndState) {
  for (int i = 0; i < 400; ++i) {
    const int joint = i % kMaxJoints;
    const JointStateMessage sent{Within(kPosition), Within(kVelocity), Within(kTorque),
                                 static_cast<DriveState>(i % 5), static_cast<std::uint8_t>(i % 16)};
    const Decoded got = decoder_.Decode(encoder_.JointState(joint, sent));
    ASSERT_EQ(got.reject, Reject::kNone);
    ASSERT_EQ(got.kind, MessageKind::kJointState);
    ASSERT_EQ(got.joint, joint);
    ASSERT_EQ(got.joint_state.position_rad, Float32(sent.position_rad));
    ASSERT_EQ(got.joint_state.velocity_radps, Float32(sent.velocity_radps));
    ASSERT_EQ(got.joint_state.torque_Nm, Float32(sent.torque_Nm));
    ASSERT_EQ(got.joint_state.state, sent.state);
    ASSERT_EQ(got.joint_state.cycle_low4, sent.cycle_low4);
  }
}

TEST_F(Messages, WrenchSurvivesTheWire) {
  for (int i = 0; i < 300; ++i) {
    const WrenchMessage sent{Any32(),
                             {Within(kForce), Within(kForce), Within(kForce)},
                             {Within(kMoment), Within(kMoment), Within(kMoment)},
                             i % 2 == 1};
    const Decoded got = decoder_.Decode(encoder_.Wrench(sent));
    ASSERT_EQ(got.reject, Reject::kNone);
    ASSERT_EQ(got.kind, MessageKind::kWrench);
    ASSERT_EQ(got.wrench.cycle, sent.cycle);
    ASSERT_EQ(got.wrench.saturated, sent.saturated);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(got.wrench.force_N[axis], Float32(sent.force_N[axis]));
      ASSERT_EQ(got.wrench.moment_Nm[axis], Float32(sent.moment_Nm[axis]));
    }
  }
}

TEST_F(Messages, CommandSurvivesTheWire) {
  for (int i = 0; i < 300; ++i) {
    CommandMessage sent{Any32(), static_cast<DriveRequest>(i % 3), {}};
    for (double& torque : sent.torque_Nm) torque = Within(kTorque);
    const Decoded got = decoder_.Decode(encoder_.Command(sent));
    ASSERT_EQ(got.reject, Reject::kNone);
    ASSERT_EQ(got.kind, MessageKind::kCommand);
    ASSERT_EQ(got.command.cycle, sent.cycle);
    ASSERT_EQ(got.command.request, sent.request);
    for (std::size_t j = 0; j < kMaxJoints; ++j)
      ASSERT_EQ(got.command.torque_Nm[j], Float32(sent.torque_Nm[j]));
  }
}

TEST_F(Messages, BoundsThemselvesAreAcceptedAndNotCounted) {
  for (const double sign : {-1.0, 1.0}) {
    const Decoded joint = decoder_.Decode(
        encoder_.JointState(0, {sign * kPosition, sign * kVelocity, sign * kTorque, DriveState::kReady, 15}));
    EXPECT_EQ(joint.reject, Reject::kNone);
    EXPECT_EQ(joint.joint_state.position_rad, sign * kPosition);
    const double f = sign * kForce, m = sign * kMoment;
    EXPECT_EQ(decoder_.Decode(encoder_.Wrench({0, {f, f, f}, {m, m, m}, false})).reject, Reject::kNone);
  }
  EXPECT_EQ(encoder_.counters().clamped, 0U);
}

TEST_F(Messages, NumbersBeyondTheRangeAreSentAsTheBoundAndCounted) {
  const Decoded joint =
      decoder_.Decode(encoder_.JointState(3, {32.001, -kInf, 1e300, DriveState::kEnabled, 0}));
  EXPECT_EQ(joint.reject, Reject::kNone);
  EXPECT_EQ(joint.joint_state.position_rad, kPosition);
  EXPECT_EQ(joint.joint_state.velocity_radps, -kVelocity);
  EXPECT_EQ(joint.joint_state.torque_Nm, kTorque);
  const Decoded wrench = decoder_.Decode(encoder_.Wrench({0, {kInf, 1, -5000}, {-1e9, 2, 1025}, true}));
  EXPECT_EQ(wrench.wrench.force_N, (std::array<double, 3>{kForce, 1, -kForce}));
  EXPECT_EQ(wrench.wrench.moment_Nm, (std::array<double, 3>{-kMoment, 2, kMoment}));
  CommandMessage command;
  command.torque_Nm.fill(-2049);
  const Decoded got = decoder_.Decode(encoder_.Command(command));
  for (const double torque : got.command.torque_Nm) EXPECT_EQ(torque, -kTorque);
  EXPECT_EQ(encoder_.counters().clamped, 3U + 4U + 8U);
  EXPECT_EQ(encoder_.counters().not_a_number, 0U);
}

TEST_F(Messages, NanTorqueCommandIsSentAsZeroAndCounted) {
  CommandMessage command;
  command.torque_Nm = {1, kNan, 3, 4, 5, 6, 7, kNan};
  const Decoded got = decoder_.Decode(encoder_.Command(command));
  EXPECT_EQ(got.reject, Reject::kNone);
  EXPECT_EQ(got.command.torque_Nm, (std::array<double, kMaxJoints>{1, 0, 3, 4, 5, 6, 7, 0}));
  EXPECT_EQ(encoder_.counters().not_a_number, 2U);
}

TEST_F(Messages, NanMeasurementIsRefusedByTheReceiverInsteadOfInvented) {
  EXPECT_EQ(decoder_.Decode(encoder_.JointState(1, {kNan, 0, 0, DriveState::kEnabled, 0})).reject,
            Reject::kRange);
  EXPECT_EQ(decoder_.Decode(encoder_.Wrench({0, {0, 0, 0}, {0, 0, kNan}, false})).reject, Reject::kRange);
  EXPECT_EQ(encoder_.counters().not_a_number, 2U);
}

}  // namespace
}  // namespace reed::bus
