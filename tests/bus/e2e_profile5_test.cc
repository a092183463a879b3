#include "reed/bus/codec/e2e_profile5.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string_view>
#include <vector>

namespace reed::bus {
namespace {

constexpr std::uint16_t kDataId = 0x1234;
using Bytes = std::vector<std::uint8_t>;

/// The polynomial division itself, bit by bit, as the standard defines it.
std::uint16_t Crc16BitByBit(const Bytes& bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    for (int bit = 7; bit >= 0; --bit) {
      const unsigned top = (crc >> 15) ^ (static_cast<unsigned>(byte >> bit) & 1U);
      crc = (crc << 1) & 0xFFFFU;
      if (top != 0) crc ^= 0x1021U;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

Bytes FrameWithCounter(int counter) {
  Bytes frame(8, 0);
  E2eSender sender;
  for (int i = 0; i <= counter; ++i) sender.Protect(frame, kDataId);
  return frame;
}

TEST(E2eProfile5, CheckValueOfTheCatalogue) {
  const std::string_view text = "123456789";
  EXPECT_EQ(Crc16(Bytes(text.begin(), text.end())), 0x29B1);
}

TEST(E2eProfile5, TableAgreesWithPolynomialDivision) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    Bytes bytes(random() % 65);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    ASSERT_EQ(Crc16(bytes), Crc16BitByBit(bytes));
  }
}

TEST(E2eProfile5, SendsTheVectorsOfTheStandard) {
  EXPECT_EQ(FrameWithCounter(0), (Bytes{0x1C, 0xCA, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(FrameWithCounter(1), (Bytes{0xCF, 0x8D, 1, 0, 0, 0, 0, 0}));
}

TEST(E2eProfile5, FirstFrameIsOkWhateverItsCounter) {
  E2eReceiver receiver;
  EXPECT_EQ(receiver.Check(FrameWithCounter(200), kDataId).state, E2eState::kOk);
}

TEST(E2eProfile5, EveryCounterDeltaGetsItsState) {
  for (int start : {0, 100, 250}) {  // 250: the counter wraps in between
    for (int delta = 0; delta < 256; ++delta) {
      E2eReceiver receiver;
      receiver.Check(FrameWithCounter(start), kDataId);
      const E2eCheck check = receiver.Check(FrameWithCounter(start + delta), kDataId);
      const E2eState expected = delta == 0    ? E2eState::kRepeated
                                : delta == 1  ? E2eState::kOk
                                : delta <= 20 ? E2eState::kOkSomeLost
                                              : E2eState::kWrongSequence;
      ASSERT_EQ(check.state, expected) << "start " << start << " delta " << delta;
      ASSERT_EQ(check.lost, expected == E2eState::kOkSomeLost ? delta - 1 : 0);
    }
  }
}

TEST(E2eProfile5, FollowsAgainAfterAWrongSequence) {
  E2eReceiver receiver;
  receiver.Check(FrameWithCounter(0), kDataId);
  ASSERT_EQ(receiver.Check(FrameWithCounter(100), kDataId).state, E2eState::kWrongSequence);
  EXPECT_EQ(receiver.Check(FrameWithCounter(101), kDataId).state, E2eState::kOk);
}

TEST(E2eProfile5, AnyFlippedBitIsACrcErrorAndDoesNotMoveTheCounter) {
  E2eReceiver receiver;
  receiver.Check(FrameWithCounter(4), kDataId);
  for (std::size_t bit = 0; bit < 64; ++bit) {
    Bytes frame = FrameWithCounter(5);
    frame[bit / 8] = static_cast<std::uint8_t>(frame[bit / 8] ^ (1U << (bit % 8)));
    ASSERT_EQ(receiver.Check(frame, kDataId).state, E2eState::kCrcError) << "bit " << bit;
  }
  EXPECT_EQ(receiver.Check(FrameWithCounter(5), kDataId).state, E2eState::kOk);
}

TEST(E2eProfile5, AnotherFramesDataIdIsACrcError) {
  E2eReceiver receiver;
  EXPECT_EQ(receiver.Check(FrameWithCounter(0), kDataId + 1).state, E2eState::kCrcError);
}

TEST(E2eProfile5, FrameWithoutRoomForTheHeaderIsACrcError) {
  E2eReceiver receiver;
  EXPECT_EQ(receiver.Check(Bytes{0xFF, 0xFF}, kDataId).state, E2eState::kCrcError);
  EXPECT_EQ(receiver.Check(Bytes{}, kDataId).state, E2eState::kCrcError);
}

}  // namespace
}  // namespace reed::bus
