// An instant on two clocks, with a pause at the worst place.
#include "reed/rt/host_clock.h"

#include <gtest/gtest.h>

#include "reed/rt/virtual_clock.h"

namespace reed::rt {
namespace {

constexpr std::int64_t kMs = 1'000'000;

/// The host pauses once, right after reading number `pause_after` of this clock.
class PausedWhileRead {
 public:
  explicit PausedWhileRead(int pause_after) : pause_after_(pause_after) {}
  std::int64_t NowNs() const noexcept { return Read(now_ns_); }
  void SleepUntil(std::int64_t deadline_ns) noexcept { now_ns_ = deadline_ns; }
  std::int64_t paused_ns() const noexcept { return Read(paused_ns_); }

 private:
  std::int64_t Read(const std::int64_t& value) const noexcept {
    const std::int64_t read = value;
    if (++readings_ == pause_after_) {
      now_ns_ += 40 * kMs;
      paused_ns_ += 40 * kMs;
    }
    return read;
  }
  int pause_after_;
  mutable int readings_ = 0;
  mutable std::int64_t now_ns_ = 100 * kMs, paused_ns_ = 7 * kMs;
};
static_assert(HostClock<PausedWhileRead>);

TEST(ReadInstant, OwnTimeLeavesThePausesOut) {
  const Instant at = ReadInstant(PausedWhileRead(0));
  EXPECT_EQ(at.now_ns, 100 * kMs);
  EXPECT_EQ(at.own_ns, 93 * kMs);
}

TEST(ReadInstant, APauseBetweenItsReadingsBelongsToBothClocksOrToNone) {
  for (int after = 1; after <= 4; ++after) {
    const Instant at = ReadInstant(PausedWhileRead(after));
    EXPECT_EQ(at.own_ns, 93 * kMs) << after;
    EXPECT_TRUE(at.now_ns == 100 * kMs || at.now_ns == 140 * kMs) << after;
  }
}

TEST(ReadInstant, AClockWithoutAHostHasOneTime) {
  const Instant at = ReadInstant(VirtualClock(5 * kMs));
  EXPECT_EQ(at.now_ns, 5 * kMs);
  EXPECT_EQ(at.own_ns, 5 * kMs);
}

}  // namespace
}  // namespace reed::rt
