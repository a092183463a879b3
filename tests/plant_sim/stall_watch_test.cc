// The watch against a thread that really takes its core away, from above and from below.
#include "reed/plant/process/stall_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "reed/config/description/cores.h"
#include "reed/rt/monotonic.h"
#include "reed/rt/rights.h"

namespace reed::plant {
namespace {

constexpr int kWatch = 50;  // its priority
constexpr std::int64_t kMs = 1'000'000;

/// Keeps the last core busy for so long at this priority of SCHED_FIFO; false if that is not granted.
bool Hog(int priority, std::int64_t for_ns) {
  bool granted = false;
  std::thread([&] {
    granted = rt::PinTo(LoopCore({})) && rt::RaiseTo(priority);
    const std::int64_t end_ns = rt::NowNs() + for_ns;
    while (granted && rt::NowNs() < end_ns) {
    }
  }).join();
  return granted;
}

/// What a watch on the last core sees of such a thread, once it has seen so much; nothing where SCHED_FIFO is
/// not granted. The watch may itself be kept from telling at once.
std::optional<std::int64_t> Seen(int hog_priority, std::int64_t for_ns, std::int64_t at_least_ns) {
  std::optional<std::int64_t> seen;
  std::thread([&] {
    StallWatch watch;
    EXPECT_EQ(watch.Start(LoopCore({}), kWatch), "");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const std::int64_t before_ns = watch.stood_ns();
    if (!Hog(hog_priority, for_ns)) return;
    for (int i = 0; i < 1000 && (i == 0 || *seen < at_least_ns); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      seen = watch.stood_ns() - before_ns;
    }
  }).join();
  return seen;
}

TEST(StallWatch, SeesACoreThatIsTakenAwayToWithinABeat) {
  const std::optional<std::int64_t> seen_ns = Seen(kWatch + 1, 30 * kMs, 28 * kMs);
  if (!seen_ns) GTEST_SKIP() << "SCHED_FIFO is not granted here";
  EXPECT_GE(*seen_ns, 28 * kMs);
}

TEST(StallWatch, DoesNotTakeABusyControllerForTheMachine) {
  std::int64_t least_ns = 30 * kMs;  // of some: the machine may really be away in any of them
  for (int i = 0; i < 20 && least_ns > 0; ++i) {
    const std::optional<std::int64_t> seen_ns = Seen(kWatch - 1, 30 * kMs, 0);
    if (!seen_ns) GTEST_SKIP() << "SCHED_FIFO is not granted here";
    least_ns = std::min(least_ns, *seen_ns);
  }
  EXPECT_LT(least_ns, 10 * kMs);
}

TEST(StallWatch, NothingIsWatchedBeforeTheStart) { EXPECT_EQ(StallWatch().stood_ns(), 0); }

}  // namespace
}  // namespace reed::plant
