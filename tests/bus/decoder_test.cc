// Frames that must not be believed, one reason at a time, and the counters that say so.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "reed/bus/codec/messages.h"
#include "reed/bus/codec/reprotect.h"

namespace reed::bus {
namespace {

std::uint64_t Count(const Decoder& decoder, Reject reject) {
  return decoder.counters().rejected[static_cast<std::size_t>(reject)];
}

/// One frame of each kind with plausible content, all from one sender.
std::vector<Frame> OneOfEach(FrameEncoder& encoder) {
  std::vector<Frame> frames{encoder.Sync({17})};
  for (int joint = 0; joint < kMaxJoints; ++joint) {
    frames.push_back(encoder.JointState(joint, {0.5, -0.25, 3.0, DriveState::kEnabled, 1}));
  }
  frames.push_back(encoder.Wrench({17, {1, 2, 3}, {4, 5, 6}, false}));
  frames.push_back(encoder.Command({17, DriveRequest::kEnable, {1, 2, 3, 4, 5, 6, 7, 8}}));
  return frames;
}

TEST(Decoder, FramesHaveTheIdentifiersAndSizesOfTheContract) {
  FrameEncoder encoder;
  const std::vector<Frame> frames = OneOfEach(encoder);
  const std::vector<std::pair<unsigned, int>> contract{{0x080, 8},  {0x101, 16}, {0x102, 16}, {0x103, 16},
                                                       {0x104, 16}, {0x105, 16}, {0x106, 16}, {0x107, 16},
                                                       {0x108, 16}, {0x140, 32}, {0x200, 48}};
  ASSERT_EQ(frames.size(), contract.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].id, contract[i].first);
    EXPECT_EQ(frames[i].size, contract[i].second);
  }
}

TEST(Decoder, UnknownIdentifierIsRefusedAndCounted) {
  Decoder decoder;
  for (const std::uint32_t id : {0x000U, 0x07FU, 0x081U, 0x100U, 0x109U, 0x141U, 0x201U, 0x7FFU}) {
    Frame frame;
    frame.id = id;
    frame.size = 16;
    const Decoded got = decoder.Decode(frame);
    EXPECT_EQ(got.reject, Reject::kUnknownId);
    EXPECT_EQ(got.kind, MessageKind::kUnknown);
  }
  Frame other = FrameEncoder().Sync({1});
  other.extended = true;  // the number of SYNC with 29 bits is another identifier
  EXPECT_EQ(decoder.Decode(other).reject, Reject::kUnknownId);
  EXPECT_EQ(Count(decoder, Reject::kUnknownId), 9U);
  EXPECT_EQ(decoder.counters().accepted, 0U);
}

TEST(Decoder, WrongLengthIsRefusedForEveryFrameAndLeavesTheSequenceAlone) {
  FrameEncoder encoder;
  Decoder decoder;
  for (const Frame& good : OneOfEach(encoder)) {
    for (const int size : {0, 2, 7, 12, 24, 64}) {
      Frame frame = good;
      frame.size = static_cast<std::uint8_t>(size);
      ASSERT_EQ(decoder.Decode(frame).reject, Reject::kLength) << frame.id << " with " << size << " bytes";
    }
    EXPECT_EQ(decoder.Decode(good).reject, Reject::kNone);
  }
  EXPECT_EQ(Count(decoder, Reject::kLength), 66U);
}

TEST(Decoder, DamagedByteIsRefusedForEveryFrame) {
  FrameEncoder encoder;
  Decoder decoder;
  for (const Frame& good : OneOfEach(encoder)) {
    for (std::size_t byte = 0; byte < good.size; ++byte) {
      Frame frame = good;
      frame.data[byte] ^= 0x10;
      const Decoded got = decoder.Decode(frame);
      ASSERT_EQ(got.reject, Reject::kCrc);
      ASSERT_EQ(got.e2e, E2eState::kCrcError);
    }
  }
  EXPECT_EQ(Count(decoder, Reject::kCrc), 8U + 8U * 16U + 32U + 48U);
}

TEST(Decoder, FrameOfOneJointUnderTheIdentifierOfAnotherIsRefused) {
  FrameEncoder encoder;
  Decoder decoder;
  Frame frame = encoder.JointState(2, {});
  frame.id = layout::kJointState[3].id;
  EXPECT_EQ(decoder.Decode(frame).reject, Reject::kCrc);
}

TEST(Decoder, RepeatedFrameIsRefused) {
  FrameEncoder encoder;
  Decoder decoder;
  for (const Frame& frame : OneOfEach(encoder)) {
    EXPECT_EQ(decoder.Decode(frame).reject, Reject::kNone);
    EXPECT_EQ(decoder.Decode(frame).reject, Reject::kRepeated);
  }
  EXPECT_EQ(Count(decoder, Reject::kRepeated), 11U);
  EXPECT_EQ(decoder.counters().accepted, 11U);
}

TEST(Decoder, SkippedFramesAreCountedAsLostAndTheNextIsUsed) {
  FrameEncoder encoder;
  Decoder decoder;
  decoder.Decode(encoder.Sync({0}));
  for (std::uint32_t cycle = 1; cycle <= 19; ++cycle) (void)encoder.Sync({cycle});
  const Decoded got = decoder.Decode(encoder.Sync({20}));
  EXPECT_EQ(got.reject, Reject::kNone);
  EXPECT_EQ(got.e2e, E2eState::kOkSomeLost);
  EXPECT_EQ(got.lost, 19);
  EXPECT_EQ(got.sync.cycle, 20U);
  EXPECT_EQ(decoder.counters().lost, 19U);
}

TEST(Decoder, LongerGapIsRefusedOnceAndThenFollowed) {
  FrameEncoder encoder;
  Decoder decoder;
  decoder.Decode(encoder.Sync({0}));
  for (std::uint32_t cycle = 1; cycle <= 20; ++cycle) (void)encoder.Sync({cycle});
  EXPECT_EQ(decoder.Decode(encoder.Sync({21})).reject, Reject::kSequence);
  EXPECT_EQ(decoder.Decode(encoder.Sync({22})).reject, Reject::kNone);
  EXPECT_EQ(decoder.counters().lost, 0U);
}

TEST(Decoder, EachIdentifierHasItsOwnCounter) {
  FrameEncoder encoder;
  Decoder decoder;
  for (int round = 0; round < 3; ++round) {
    for (const Frame& frame : OneOfEach(encoder)) {
      const Decoded got = decoder.Decode(frame);
      EXPECT_EQ(got.e2e, E2eState::kOk);
      EXPECT_EQ(frame.data[2], round);
    }
  }
}

struct FloatSignal {
  std::size_t frame;  // index in OneOfEach
  std::size_t byte;   // where its four bytes begin
  float bound;
};

/// Every float signal of the DBC: position, velocity, torque of 8 joints; 3 forces, 3 moments; 8 torques.
std::vector<FloatSignal> FloatSignals() {
  std::vector<FloatSignal> out;
  for (std::size_t joint = 0; joint < 8; ++joint) {
    out.insert(out.end(), {{1 + joint, 4, 32.0F}, {1 + joint, 8, 64.0F}, {1 + joint, 12, 2048.0F}});
  }
  for (std::size_t axis = 0; axis < 6; ++axis) out.push_back({9, 4 + 4 * axis, axis < 3 ? 4096.0F : 1024.0F});
  for (std::size_t joint = 0; joint < 8; ++joint) out.push_back({10, 8 + 4 * joint, 2048.0F});
  return out;
}

TEST(Decoder, NanInfinityAndTheFirstFloatBeyondEachBoundAreRefusedForEverySignal) {
  const float inf = std::numeric_limits<float>::infinity();
  for (const FloatSignal& signal : FloatSignals()) {
    const float beyond = std::nextafter(signal.bound, inf);
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), inf, -inf, beyond, -beyond}) {
      FrameEncoder encoder;
      Decoder decoder;
      Frame frame = OneOfEach(encoder)[signal.frame];
      std::memcpy(&frame.data[signal.byte], &value, sizeof value);
      Reprotect(frame, 0);
      const Decoded got = decoder.Decode(frame);
      ASSERT_EQ(got.reject, Reject::kRange)
          << std::hex << frame.id << " byte " << signal.byte << " " << value;
      ASSERT_EQ(got.e2e, E2eState::kOk);
      ASSERT_EQ(got.joint_state.position_rad, 0.0) << "nothing of a refused frame comes through";
      ASSERT_EQ(got.command.torque_Nm[0], 0.0);
    }
    for (const float value : {signal.bound, -signal.bound}) {
      FrameEncoder encoder;
      Decoder decoder;
      Frame frame = OneOfEach(encoder)[signal.frame];
      std::memcpy(&frame.data[signal.byte], &value, sizeof value);
      Reprotect(frame, 0);
      ASSERT_EQ(decoder.Decode(frame).reject, Reject::kNone);
    }
  }
}

TEST(Decoder, StatesAndRequestsThatDoNotExistAreRefused) {
  for (unsigned state = 0; state < 8; ++state) {
    FrameEncoder encoder;
    Decoder decoder;
    Frame frame = encoder.JointState(0, {});
    frame.data[3] = static_cast<std::uint8_t>(state | 0xA0U);
    Reprotect(frame, 0);
    EXPECT_EQ(decoder.Decode(frame).reject, state <= 4 ? Reject::kNone : Reject::kRange) << state;
  }
  for (unsigned request = 0; request < 256; ++request) {
    FrameEncoder encoder;
    Decoder decoder;
    Frame frame = encoder.Command({});
    frame.data[3] = static_cast<std::uint8_t>(request);
    Reprotect(frame, 0);
    EXPECT_EQ(decoder.Decode(frame).reject, request <= 2 ? Reject::kNone : Reject::kRange) << request;
  }
}

TEST(Decoder, RefusedContentStillAdvancesTheSequence) {
  FrameEncoder encoder;
  Decoder decoder;
  Frame absurd = encoder.Command({});
  absurd.data[3] = 77;
  Reprotect(absurd, 0);
  EXPECT_EQ(decoder.Decode(absurd).reject, Reject::kRange);
  EXPECT_EQ(decoder.Decode(encoder.Command({})).e2e, E2eState::kOk);
}

}  // namespace
}  // namespace reed::bus
