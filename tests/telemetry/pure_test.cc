// The parts of telemetry that are arithmetic: time, rate limit, the snapshot's lists.
#include <gtest/gtest.h>
#include <time.h>

#include <vector>

#include "reed/firmware/record/time_base.h"
#include "reed/firmware/snapshot/snapshot.h"
#include "reed/telemetry/rate_limit.h"

namespace reed::telemetry {
namespace {

TEST(TimeBase, LockstepTimeIsTheCycleNumberToTheNearestMicrosecond) {
  const TimeBase at_3khz = TimeBase::Lockstep(3000.0);
  EXPECT_EQ(at_3khz.Utime(0, 77), 0);
  EXPECT_EQ(at_3khz.Utime(1, 77), 333);
  EXPECT_EQ(at_3khz.Utime(2, 77), 667) << "rounded, not truncated, and the machine's stamp plays no part";
  EXPECT_EQ(at_3khz.Utime(3'000'000'000, 77), 1'000'000'000'000) << "after 11 days exact still";
}

TEST(TimeBase, WallTimeIsTheStampPlusTheOffset) {
  const TimeBase wall = TimeBase::WallWithOffset(1'700'000'000'000'000'000);
  EXPECT_EQ(wall.Utime(5, 2'345'678), 1'700'000'000'002'345);
}

TEST(TimeBase, WallTimeIsTheTimeOfDay) {
  const auto microseconds = [](clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return std::int64_t{t.tv_sec} * 1'000'000 + t.tv_nsec / 1000;
  };
  const TimeBase wall = TimeBase::Wall();
  const std::int64_t before = microseconds(CLOCK_REALTIME);
  const std::int64_t utime = wall.Utime(0, microseconds(CLOCK_MONOTONIC) * 1000);
  const std::int64_t after = microseconds(CLOCK_REALTIME);
  EXPECT_GE(utime, before - 2000);
  EXPECT_LE(utime, after + 2000);
}

int Admitted(RateLimit& limit, std::int64_t from_ns, std::int64_t to_ns, std::int64_t every_ns) {
  int admitted = 0;
  for (std::int64_t t = from_ns; t < to_ns; t += every_ns) admitted += limit.Admit(t) ? 1 : 0;
  return admitted;
}

TEST(RateLimit, LetsAThousandPerSecondThroughUntouched) {
  RateLimit limit(1000, 50);
  EXPECT_EQ(Admitted(limit, 0, 10'000'000'000, 1'000'000), 10'000);
}

TEST(RateLimit, LetsBatchesOfTheSameRateThroughUntouched) {
  RateLimit limit(1000, 50);
  int admitted = 0;
  for (std::int64_t t = 0; t < 10'000'000'000; t += 20'000'000) {
    for (int i = 0; i < 20; ++i) admitted += limit.Admit(t) ? 1 : 0;
  }
  EXPECT_EQ(admitted, 10'000);
}

TEST(RateLimit, ThinsAFasterStreamToTheRatePlusOneBurst) {
  RateLimit limit(1000, 50);
  EXPECT_NEAR(Admitted(limit, 0, 10'000'000'000, 50'000), 10'050, 1);
}

TEST(RateLimit, APauseBuysOneBurstAndNoMore) {
  RateLimit limit(1000, 50);
  Admitted(limit, 0, 1'000'000'000, 50'000);
  EXPECT_EQ(Admitted(limit, 100'000'000'000, 100'000'001'000, 1), 50);
}

TEST(Snapshot, AFullListKeepsTheFirstEntriesAndCountsTheFramesLeftOut) {
  Snapshot snapshot;
  for (int i = 0; i < kMaxEvents + 3; ++i) snapshot.AddEvent({0, 0, 10 + i, -1, 0.0});
  std::uint32_t frames = 0;
  while (snapshot.frames_omitted < 5) snapshot.AddFrame({frames++, 16, {}}, Direction::kSent, 0);
  EXPECT_EQ(snapshot.num_events, kMaxEvents);
  EXPECT_EQ(snapshot.events[0].code, 10);
  EXPECT_GE(snapshot.num_frames, 96) << "as many states as a cycle takes from the bus";
  EXPECT_EQ(snapshot.num_frames + 5, static_cast<int>(frames));
  std::uint32_t next = 0;
  snapshot.ForEachFrame([&](const RecordedFrame& one) { EXPECT_EQ(one.frame.id, next++); });
  EXPECT_EQ(next, frames - 5);
  snapshot.ClearLists();
  EXPECT_EQ(snapshot.num_events + snapshot.num_frames + snapshot.frames_omitted, 0);
}

TEST(Snapshot, AFrameComesBackWithItsOwnBytesAndNoOthers) {
  Snapshot snapshot;
  for (std::uint8_t size : {std::uint8_t{64}, std::uint8_t{0}, std::uint8_t{3}, std::uint8_t{48}}) {
    bus::Frame frame{0x100u + size, size, {}};
    frame.data.fill(static_cast<std::uint8_t>(0xA0 + size));
    snapshot.AddFrame(frame, size == 3 ? Direction::kSent : Direction::kReceived, -size);
  }
  std::vector<RecordedFrame> found;
  snapshot.ForEachFrame([&](const RecordedFrame& one) { found.push_back(one); });
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[1].frame.data, bus::Frame{}.data);
  EXPECT_EQ(found[2].direction, Direction::kSent);
  EXPECT_EQ(found[2].offset_ns, -3);
  EXPECT_EQ(found[2].frame.id, 0x103U);
  EXPECT_EQ(found[2].frame.data[2], 0xA3);
  EXPECT_EQ(found[2].frame.data[3], 0) << "behind its size lies nothing of an older frame";
  EXPECT_EQ(found[3].frame.data[47], 0xD0);
}

}  // namespace
}  // namespace reed::telemetry
