#include "reed/rt/grid.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "reed/rt/overrun.h"
#include "reed/rt/virtual_clock.h"

namespace reed::rt {
namespace {

TEST(NextTick, EqualsWalkingTheGridPointByPoint) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    const std::int64_t period = std::uniform_int_distribution<std::int64_t>(1, 2000)(random);
    const std::int64_t previous = std::uniform_int_distribution<std::int64_t>(-5000, 5000)(random);
    const std::int64_t now = previous + std::uniform_int_distribution<std::int64_t>(-3000, 30'000)(random);

    std::int64_t point = previous + period, missed = 0;
    while (point <= now) {
      point += period;
      ++missed;
    }
    const Tick tick = NextTick(previous, period, now);
    ASSERT_EQ(tick.deadline_ns, point) << previous << " " << period << " " << now;
    ASSERT_EQ(tick.missed, missed);
  }
}

/// Runs a loop on the virtual clock; `work_ns[k]` is how long cycle k takes. Returns when each cycle woke up.
struct Ran {
  std::vector<std::int64_t> woke_ns;
  std::vector<CycleAction> action;
  std::int64_t missed = 0;
};
Ran RunLoop(OverrunPolicy policy, const std::vector<std::int64_t>& work_ns, std::int64_t wake_delay_ns = 0) {
  constexpr std::int64_t kStart = 123'456'789, kPeriod = 1'000'000;
  VirtualClock clock(kStart);
  clock.set_wake_delay_ns(wake_delay_ns);
  std::int64_t deadline = kStart;
  int in_row = 0;
  Ran ran;
  for (const std::int64_t work : work_ns) {
    const std::int64_t start = clock.NowNs();
    clock.Advance(work);
    const OverrunDecision decision =
        AfterCycle(policy, kPeriod, {deadline, start, clock.NowNs()}, in_row, 20);
    in_row = decision.missed_in_row;
    deadline = decision.next.deadline_ns;
    ran.missed += decision.next.missed;
    clock.SleepUntil(deadline);
    ran.woke_ns.push_back(clock.NowNs() - kStart);
    ran.action.push_back(decision.action);
    if (decision.action == CycleAction::kStop) break;
  }
  return ran;
}

constexpr std::int64_t kShort = 300'000, kLong = 2'700'000;
using Times = std::vector<std::int64_t>;

TEST(OverrunPolicy, KeepGridStaysOnPhaseAndCountsWhatItSleptThrough) {
  const Ran ran = RunLoop(OverrunPolicy::kKeepGrid, {kShort, kLong, kShort, kShort});
  EXPECT_EQ(ran.woke_ns, (Times{1'000'000, 4'000'000, 5'000'000, 6'000'000}));
  EXPECT_EQ(ran.missed, 2);
}

TEST(OverrunPolicy, LateWakeUpsDoNotMoveTheGrid) {
  const Ran ran = RunLoop(OverrunPolicy::kKeepGrid, {kShort, kShort, kShort}, /*wake_delay_ns=*/150'000);
  EXPECT_EQ(ran.woke_ns, (Times{1'150'000, 2'150'000, 3'150'000}));
  EXPECT_EQ(ran.missed, 0);
}

TEST(OverrunPolicy, SkipLeavesOneMorePointFree) {
  const Ran ran = RunLoop(OverrunPolicy::kSkip, {kShort, kLong, kShort});
  EXPECT_EQ(ran.woke_ns, (Times{1'000'000, 5'000'000, 6'000'000}));
  EXPECT_EQ(ran.missed, 3);
}

TEST(OverrunPolicy, HoldRepeatsTheCommandForExactlyOneCycle) {
  const Ran ran = RunLoop(OverrunPolicy::kHold, {kShort, kLong, kShort});
  EXPECT_EQ(ran.action, (std::vector{CycleAction::kRun, CycleAction::kHold, CycleAction::kRun}));
}

TEST(OverrunPolicy, StopEndsAtTheFirstOverrun) {
  const Ran ran = RunLoop(OverrunPolicy::kStop, {kShort, kLong, kShort});
  EXPECT_EQ(ran.action, (std::vector{CycleAction::kRun, CycleAction::kStop}));
}

TEST(OverrunPolicy, EveryPolicyButStopSurvivesADelayOfTenMilliseconds) {
  for (const auto policy : {OverrunPolicy::kKeepGrid, OverrunPolicy::kSkip, OverrunPolicy::kHold}) {
    EXPECT_EQ(RunLoop(policy, {kShort, 10'500'000, kShort}).action.size(), 3U);
  }
}

TEST(OverrunPolicy, MoreThanTheAllowedPointsInOneDelayStop) {
  EXPECT_NE(RunLoop(OverrunPolicy::kKeepGrid, {20'500'000}).action.back(), CycleAction::kStop);
  EXPECT_EQ(RunLoop(OverrunPolicy::kKeepGrid, {21'500'000}).action.back(), CycleAction::kStop);
}

TEST(OverrunPolicy, ShortOverrunsInARowAddUpAndOnePunctualCycleForgives) {
  const std::int64_t one_missed = 1'200'000;
  EXPECT_EQ(RunLoop(OverrunPolicy::kKeepGrid, Times(40, one_missed)).action.size(), 21U);
  Times forgiven(40, one_missed);
  forgiven[19] = kShort;
  EXPECT_EQ(RunLoop(OverrunPolicy::kKeepGrid, forgiven).action.size(), 40U);
}

}  // namespace
}  // namespace reed::rt
