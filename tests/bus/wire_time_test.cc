#include "reed/bus/codec/wire_time.h"

#include <gtest/gtest.h>

#include <vector>

#include "reed_layout.h"

namespace reed::bus {
namespace {

TEST(WireTime, FrameTimesAreThePublishedWorstCases) {
  const struct {
    int size;
    double at_5_us, at_8_us;
  } table[] = {{8, 56.6, 48.1}, {16, 72.6, 58.1}, {32, 105.6, 78.7}, {48, 137.6, 98.8}, {64, 169.6, 118.8}};
  for (const auto& row : table) {
    EXPECT_NEAR(FrameTime_s(row.size) * 1e6, row.at_5_us, 1e-9) << row.size;
    EXPECT_NEAR(FrameTime_s(row.size, {1e6, 8e6}) * 1e6, row.at_8_us, 0.05) << row.size;  // printed to 0.1
  }
}

/// Stuffs the worst bit pattern literally: after five equal bits comes an opposite one, which itself starts
/// the next run, so that 1 + 4k bits are followed by k stuff bits.
int WorstStuffedLength(int bits) {
  int length = 0, run = 0;
  for (int i = 0; i < bits; ++i) {
    ++length;
    if (++run == 5) {
      ++length;
      run = 1;
    }
  }
  return length;
}

TEST(WireTime, StuffBitsAreThoseOfTheWorstPattern) {
  for (const int size : {0, 1, 8, 12, 16, 20, 24, 32, 48, 64}) {
    const int after_stuffing = size > 16 ? 4 + 21 + 7 : 4 + 17 + 6;
    // A run that began before the data phase may add its stuff bit here instead of there; each part alone is
    // bounded.
    EXPECT_EQ(DataBits(size), WorstStuffedLength(5 + 8 * size) + after_stuffing) << size;
  }
  EXPECT_EQ(NominalBits(), WorstStuffedLength(17) + 13);
}

TEST(WireTime, CycleIsTheSumOfItsFrames) {
  EXPECT_NEAR(CycleTime_s(5) * 1e6, 56.6 + 5 * 72.6 + 105.6 + 137.6, 1e-9);
  EXPECT_NEAR(WireLoad(5, 1000), 0.6628, 1e-12);
  EXPECT_NEAR(CycleTime_s(8) * 1e6, 880.6, 1e-9);
  EXPECT_NEAR(AnswerTime_s(5) * 1e6, 56.6 + 5 * 72.6 + 105.6, 1e-9);
  EXPECT_NEAR(CommandTime_s() * 1e6, 137.6, 1e-9);
}

TEST(WireTime, ScheduleIsRefusedExactlyAboveItsHighestRate) {
  for (int joints = 1; joints <= 8; ++joints) {
    EXPECT_TRUE(ScheduleFits(joints, MaxRate_hz(joints) * (1 - 1e-9)));
    EXPECT_FALSE(ScheduleFits(joints, MaxRate_hz(joints) * (1 + 1e-9)));
  }
  EXPECT_TRUE(ScheduleFits(8, 1000));
  EXPECT_FALSE(ScheduleFits(5, 2000));
  EXPECT_TRUE(ScheduleFits(5, 2000, {1e6, 12e6}) == (CycleTime_s(5, {1e6, 12e6}) <= 5e-4));
}

}  // namespace
}  // namespace reed::bus
