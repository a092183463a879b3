// The wire in virtual time, against stuffing done by search and replace, arbitration by hand, and the schedule's worst case.
#include "reed/bus/wire/wire.h"

#include <gtest/gtest.h>

#include <bitset>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "reed/bus/codec/messages.h"

namespace reed::bus {
namespace {

std::string Bits(std::uint32_t value, std::size_t count) {
  return std::bitset<32>(value).to_string().substr(32 - count);
}

/// The whole frame up to its checksum as text, and stuffed as text: another way than the program's.
int StuffBitsOf(const Frame& frame, std::uint32_t dlc) {
  std::string text = "0" + Bits(frame.id, 11) + "00" + "101" + "0" + Bits(dlc, 4);
  for (int i = 0; i < frame.size; ++i) text += Bits(frame.data[static_cast<std::size_t>(i)], 8);
  int stuffed = 0;
  for (std::size_t from = 0;;) {
    const std::size_t zeros = text.find("00000", from), ones = text.find("11111", from);
    const std::size_t at = std::min(zeros, ones);
    if (at == std::string::npos || at + 5 == text.size()) return stuffed;
    text.insert(at + 5, 1, zeros < ones ? '1' : '0');
    ++stuffed;
    from = at + 5;
  }
}

Frame Filled(std::uint32_t id, std::uint8_t size, std::uint8_t byte) {
  Frame frame;
  frame.id = id;
  frame.size = size;
  frame.data.fill(byte);
  return frame;
}

TEST(FrameBits, AreThoseOfTheFrameWrittenOutAndStuffed) {
  std::mt19937_64 random(5);
  const struct {
    std::uint8_t size;
    std::uint32_t dlc;
  } sizes[] = {{0, 0}, {8, 8}, {12, 9}, {16, 10}, {20, 11}, {24, 12}, {32, 13}, {48, 14}, {64, 15}};
  for (int i = 0; i < 2000; ++i) {
    const auto& one = sizes[random() % std::size(sizes)];
    Frame frame = Filled(static_cast<std::uint32_t>(random() & 0x7FFU), one.size, 0);
    for (std::uint8_t& byte : frame.data)
      byte = random() % 2 == 0 ? static_cast<std::uint8_t>(random()) : (random() % 2 == 0 ? 0x00 : 0xFF);
    const FrameBits bits = BitsOf(frame);
    const int checked = one.size > 16 ? 25 : 21;
    EXPECT_EQ(bits.nominal + bits.data,
              17 + 13 + 5 + 8 * one.size + checked + 1 + checked / 4 + StuffBitsOf(frame, one.dlc));
    EXPECT_LE(bits.nominal, NominalBits());
    EXPECT_LE(bits.data, DataBits(one.size));
  }
}

TEST(FrameBits, AContentOfRunsIsTheWorstCaseButForOneBit) {
  // Behind the three zeros of the length come 00 1111 0000 1111 …: every four bits end a run that a stuff bit began.
  EXPECT_EQ(BitsOf(Filled(0x080, 8, 0x3C)).data, DataBits(8) - 1);
}

std::vector<std::uint32_t> Order(Wire& wire, std::int64_t horizon_ns) {
  std::vector<std::uint32_t> ids;
  while (const auto sent = wire.Next(horizon_ns)) ids.push_back(sent->frame.id);
  return ids;
}

TEST(Wire, TheLowestIdentifierGoesFirstAndNobodyIsInterrupted) {
  Wire wire;
  wire.Offer(Filled(0x300, 8, 0x55), 1000);  // alone when the wire is free
  wire.Offer(Filled(0x200, 8, 0x55), 2000);
  wire.Offer(Filled(0x100, 8, 0x55), 3000);
  wire.Offer(Filled(0x080, 8, 0x55), 10'000'000);
  EXPECT_EQ(Order(wire, 20'000'000), (std::vector<std::uint32_t>{0x300, 0x100, 0x200, 0x080}));
}

TEST(Wire, AFrameIsThroughAfterItsOwnTimeAndTheNextOneAfterTheIntermission) {
  Wire wire;
  const Frame one = Filled(0x101, 16, 0x55), two = Filled(0x102, 16, 0x55);
  wire.Offer(one, 5000);
  wire.Offer(two, 5000);
  const auto first = wire.Next(1'000'000), second = wire.Next(1'000'000);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->arrived_ns, 5000 + std::llround(1e9 * FrameTime_s(one)) - 3000);
  EXPECT_EQ(second->arrived_ns - first->arrived_ns, std::llround(1e9 * FrameTime_s(two)));
}

TEST(Wire, WhatStartsLaterThanTheHorizonIsNotDecided) {
  Wire wire;
  wire.Offer(Filled(0x200, 48, 0), 1000);
  EXPECT_FALSE(wire.Next(1000));
  wire.Offer(Filled(0x080, 8, 0), 1000);
  EXPECT_EQ(wire.Next(1001)->frame.id, 0x080U);
}

/// One cycle of an arm: SYNC, the answers that it asks for, the command. Returns the times of the last answer and of the command.
struct CycleTimes {
  double answers_s, command_s;
};
CycleTimes RunCycle(Wire& wire, FrameEncoder& encoder, int joints, std::int64_t start_ns,
                    std::mt19937_64& random) {
  const auto number = [&] { return (static_cast<double>(random() % 20001) - 1e4) * 1e-3; };
  wire.Offer(encoder.Sync({static_cast<std::uint32_t>(random()), layout::kLayoutId}), start_ns);
  const std::int64_t asked_ns = wire.Next(INT64_MAX)->arrived_ns;
  for (int j = 0; j < joints; ++j)
    wire.Offer(encoder.JointState(j, {number(), number(), number(), DriveState::kEnabled, 3}), asked_ns);
  wire.Offer(encoder.Wrench({7, {number(), number(), number()}, {number(), number(), number()}, false}),
             asked_ns);
  std::int64_t last_ns = 0;
  for (int j = 0; j < joints + 1; ++j) last_ns = wire.Next(INT64_MAX)->arrived_ns;
  CommandMessage command;
  for (double& torque : command.torque_Nm) torque = number();
  wire.Offer(encoder.Command(command), last_ns);
  const std::int64_t end_ns = wire.Next(INT64_MAX)->arrived_ns;
  return {1e-9 * static_cast<double>(last_ns - start_ns), 1e-9 * static_cast<double>(end_ns - last_ns)};
}

TEST(Wire, AnArmsCycleIsNeverLongerThanTheSchedulesWorstCaseAndNearIt) {
  std::mt19937_64 random(7);
  for (const int joints : {2, 5, 8}) {
    Wire wire;
    FrameEncoder encoder;
    double longest_s = 0.0, command_s = 0.0;
    for (std::int64_t k = 0; k < 1000; ++k) {
      const CycleTimes times = RunCycle(wire, encoder, joints, k * 2'000'000, random);
      longest_s = std::max(longest_s, times.answers_s);
      command_s = std::max(command_s, times.command_s);
    }
    EXPECT_LE(longest_s, AnswerTime_s(joints));
    EXPECT_LE(command_s, CommandTime_s());  // with the intermission behind the last answer, without its own
    EXPECT_GT(longest_s, 0.85 * AnswerTime_s(joints));
  }
}

TEST(Wire, OthersTakeTheShareTheyAreGivenAndDelayWithinTheBoundOfArbitration) {
  std::mt19937_64 random(8);
  for (const double load : {0.1, 0.3}) {
    Wire wire({load, 0x7FF, 9});  // lower in rank than all of ours: they only block
    FrameEncoder encoder;
    constexpr int kJoints = 5;
    double longest_s = 0.0;
    constexpr std::int64_t kCycles = 20000;
    for (std::int64_t k = 0; k < kCycles; ++k)
      longest_s = std::max(longest_s, RunCycle(wire, encoder, kJoints, k * 1'000'000, random).answers_s);
    EXPECT_NEAR(1e-9 * static_cast<double>(wire.foreign_ns()) / (1e-3 * static_cast<double>(kCycles)), load,
                0.05 * load);
    // One frame of theirs may have begun before SYNC; the answers are ready with SYNC's last bit and win from there on.
    EXPECT_LE(longest_s, AnswerTime_s(kJoints) + FrameTime_s(64));
    EXPECT_GT(longest_s, AnswerTime_s(kJoints)) << "with others it is longer than without";
  }
}

TEST(Wire, TheSameSeedIsTheSameTraffic) {
  std::mt19937_64 one(1), two(1);
  Wire first({0.4, -1, 3}), second({0.4, -1, 3});
  FrameEncoder a, b;
  for (std::int64_t k = 0; k < 100; ++k) {
    const CycleTimes x = RunCycle(first, a, 5, k * 2'000'000, one),
                     y = RunCycle(second, b, 5, k * 2'000'000, two);
    ASSERT_EQ(x.answers_s, y.answers_s);
    ASSERT_EQ(x.command_s, y.command_s);
  }
}

}  // namespace
}  // namespace reed::bus
