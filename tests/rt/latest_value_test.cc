#include "reed/rt/latest_value.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

namespace reed::rt {
namespace {

using Wide = std::array<std::uint64_t, 40>;

Wide All(std::uint64_t number) {
  Wide wide;
  wide.fill(number);
  return wide;
}

TEST(LatestValue, ReadsTheInitialValueBeforeAnyWrite) { EXPECT_EQ(LatestValue<int>(42).Read(), 42); }

TEST(LatestValue, ReadsTheNewestOfSeveralWritesAndThenKeepsIt) {
  LatestValue<int> latest;
  for (int last = 1; last < 8; ++last) {
    for (int i = 1; i <= last; ++i) latest.Write(100 * last + i);
    EXPECT_EQ(latest.Read(), 100 * last + last);
    EXPECT_EQ(latest.Read(), 100 * last + last);
  }
}

TEST(LatestValue, AReferenceStaysConstantWhileTheWriterGoesOn) {
  LatestValue<int> latest;
  latest.Write(1);
  const int& held = latest.Read();
  for (int i = 2; i < 50; ++i) latest.Write(i);
  EXPECT_EQ(held, 1);
  EXPECT_EQ(latest.Read(), 49);
}

TEST(LatestValue, TwoThreadsNeverSeeHalfAValueOrAnOlderOne) {
  constexpr std::uint64_t kWrites = 300'000, kNews = 100;
  LatestValue<Wide> latest(All(0));
  std::atomic<bool> done{false};
  std::atomic<std::uint64_t> news{0};
  std::uint64_t written = 0;
  std::thread writer([&] {
    while (written < kWrites || news < kNews) {  // on one core the reader would otherwise come too late
      latest.Write(All(++written));
      if (written % 1000 == 0) std::this_thread::yield();
    }
    done.store(true, std::memory_order_release);
  });

  std::uint64_t previous = 0, torn = 0, backwards = 0;
  const auto look = [&] {
    const Wide& value = latest.Read();
    for (const std::uint64_t word : value) torn += word != value[0] ? 1U : 0U;
    if (value[0] < previous) ++backwards;
    if (value[0] != previous) ++news;
    previous = value[0];
  };
  while (!done.load(std::memory_order_acquire)) look();
  writer.join();
  look();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(backwards, 0U);
  EXPECT_EQ(previous, written) << "the last write must be the one that is read";
}

}  // namespace
}  // namespace reed::rt
