// The watch against a thread that really takes its core away, from above and from below.
#include "reed/rt/host_pause_watch.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include "reed/rt/monotonic.h"
#include "reed/rt/rights.h"

namespace reed::rt {
namespace {

constexpr int kWatch = 50;  // its priority
constexpr std::int64_t kMs = 1'000'000;

int LastCore() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  sched_getaffinity(0, sizeof allowed, &allowed);
  int last = 0;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(static_cast<std::size_t>(core), &allowed)) last = core;
  return last;
}

/// Keeps the last core busy for so long at this priority of SCHED_FIFO; false if that is not granted.
bool Hog(int priority, std::int64_t for_ns) {
  bool granted = false;
  std::thread([&] {
    granted = PinTo(LastCore()) && RaiseTo(priority);
    const std::int64_t end_ns = NowNs() + for_ns;
    while (granted && NowNs() < end_ns) {
    }
  }).join();
  return granted;
}

/// What a watch on the last core sees of such a thread, once it has seen so much; nothing where SCHED_FIFO is
/// not granted. The watch may itself be kept from telling at once.
std::optional<std::int64_t> Seen(int hog_priority, std::int64_t for_ns, std::int64_t at_least_ns) {
  std::optional<std::int64_t> seen;
  std::thread([&] {
    HostPauseWatch watch;
    EXPECT_EQ(watch.Start(LastCore(), kWatch), "");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const std::int64_t before_ns = watch.paused_ns();
    if (!Hog(hog_priority, for_ns)) return;
    for (int i = 0; i < 1000 && (i == 0 || *seen < at_least_ns); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      seen = watch.paused_ns() - before_ns;
    }
  }).join();
  return seen;
}

TEST(HostPauseWatch, SeesACoreThatIsTakenAwayToWithinABeat) {
  const std::optional<std::int64_t> seen_ns = Seen(kWatch + 1, 30 * kMs, 28 * kMs);
  if (!seen_ns) GTEST_SKIP() << "SCHED_FIFO is not granted here";
  EXPECT_GE(*seen_ns, 28 * kMs);
}

TEST(HostPauseWatch, DoesNotTakeABusyControllerForTheHost) {
  std::int64_t least_ns = 30 * kMs;  // of some: the host may really pause in any of them
  for (int i = 0; i < 20 && least_ns > 0; ++i) {
    const std::optional<std::int64_t> seen_ns = Seen(kWatch - 1, 30 * kMs, 0);
    if (!seen_ns) GTEST_SKIP() << "SCHED_FIFO is not granted here";
    least_ns = std::min(least_ns, *seen_ns);
  }
  EXPECT_LT(least_ns, 10 * kMs);
}

TEST(HostPauseWatch, NothingIsWatchedBeforeTheStart) { EXPECT_EQ(HostPauseWatch().paused_ns(), 0); }

}  // namespace
}  // namespace reed::rt
