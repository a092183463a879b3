// Part 2 of the timing budget, in virtual time: the grid, overrun policies, stalls. No real waiting.
#include <gtest/gtest.h>

#include "reed/firmware/startup/loop_options.h"
#include "reed/tests/timing/wall_loop_rig.h"

namespace reed {
namespace {

TEST(WallLoop, PunctualCyclesStayOnTheGridAndNothingIsCounted) {
  Rig rig(50);
  const LoopResult result = rig.Run();
  EXPECT_EQ(result.cycles, 50);
  EXPECT_EQ(result.missed, 0);
  EXPECT_EQ(result.overruns, 0);
  for (std::size_t k = 0; k < 50; ++k)
    EXPECT_EQ(rig.cycle.started_ns[k], 7'000 + static_cast<std::int64_t>(k + 1) * kPeriod);
  EXPECT_EQ(Events(rig.Recorded(), protect::Reason::kPhaseBudget), 0);
}

TEST(WallLoop, ADefaultLoopSurvivesAStallOfTenMilliseconds) {
  Rig rig(40);
  rig.StallAt5(10 * kMs);
  const LoopResult result = rig.Run();
  EXPECT_EQ(rig.cycle.stopped_at, -1);
  EXPECT_EQ(result.cycles, 40);
  EXPECT_EQ(result.missed, 10);
  EXPECT_EQ(result.overruns, 1);
  EXPECT_EQ((rig.cycle.started_ns[6] - 7'000) % kPeriod, 0) << "the grid has kept its phase";
  const auto recorded = rig.Recorded();
  EXPECT_EQ(Events(recorded, protect::Reason::kStall), 1);
  EXPECT_EQ(recorded[5].timing.missed, 10) << "told with the cycle that lost the time";
}

TEST(WallLoop, ADefaultLoopStopsWithinTwentyMissedCycles) {
  Rig rig(40);
  rig.StallAt5(20 * kMs);
  const LoopResult result = rig.Run();
  EXPECT_EQ(result.missed, 20);
  EXPECT_EQ(rig.cycle.stopped_at, 6);
}

TEST(WallLoop, NineteenMissedCyclesAreStillSurvived) {
  Rig rig(40);
  rig.StallAt5(19 * kMs);
  EXPECT_EQ(rig.Run().missed, 19);
  EXPECT_EQ(rig.cycle.stopped_at, -1);
}

TEST(WallLoop, MissesAddUpWhileEachCycleTakesLongerThanItsPeriod) {
  Rig rig(40);
  rig.cycle.cost = [](std::uint32_t k) {
    test::CycleCost cost;
    cost.after = k >= 5 ? 2 * kMs : 0;  // two points missed in each cycle from the sixth on
    return cost;
  };
  const LoopResult result = rig.Run();
  EXPECT_EQ(rig.cycle.stopped_at, 15) << "ten such cycles are twenty misses";
  EXPECT_EQ(rig.cycle.seen[10].missed_in_row, 10);
  EXPECT_GE(result.missed, 20);
}

TEST(WallLoop, LateCyclesThatThenTakeTheirTimeDoNotAddUp) {
  Rig rig(40);
  rig.clock.set_wake_delay_ns(8 * kMs);
  EXPECT_GE(rig.Run().missed, 300);
  EXPECT_EQ(rig.cycle.stopped_at, -1);
  Rig longer(40);
  longer.clock.set_wake_delay_ns(20 * kMs);
  longer.Run();
  EXPECT_EQ(longer.cycle.stopped_at, 1) << "one stall of twenty periods is too long whoever served before";
  EXPECT_EQ(longer.cycle.seen[1].missed_in_row, 20) << "the figure of the trip";
}

TEST(WallLoop, WhatWasMissedWhileTheArmsClockStoodStillIsCountedAndStopsNothing) {
  Rig rig(40);
  rig.cycle.cost = [](std::uint32_t k) {
    test::CycleCost cost;
    cost.after = k == 5 || k == 9 ? 42 * kMs : 0;
    cost.clock_stood = k == 5;
    return cost;
  };
  EXPECT_EQ(rig.Run().missed, 84);
  EXPECT_FALSE(rig.cycle.seen[6].missed_in_row_exceeded);
  EXPECT_EQ(rig.cycle.seen[6].missed_in_row, 0);
  EXPECT_EQ(rig.cycle.stopped_at, 10) << "the second stall is the loop's own";
}

TEST(WallLoop, AStallBehindTheAnswerIsTakenBackByTheNextOne) {
  Rig rig(40);
  rig.cycle.cost = [](std::uint32_t k) {
    test::CycleCost cost;
    cost.after = k == 5 ? 15 * kMs : k == 6 ? 8 * kMs : 0;
    cost.clock_stood = k == 6;
    return cost;
  };
  EXPECT_EQ(rig.Run().missed, 23);
  EXPECT_EQ(rig.cycle.stopped_at, -1);
}

TEST(WallLoop, ASlowLoopStopsHoweverOftenTheMachineIsAway) {
  Rig rig(100);
  rig.cycle.cost = [](std::uint32_t k) {
    test::CycleCost cost;
    cost.after = k % 5 == 0 ? 6 * kMs : 2 * kMs;  // two missed in each cycle of its own, six in a stall
    cost.clock_stood = k % 5 == 0;
    return cost;
  };
  rig.Run();
  EXPECT_GT(rig.cycle.stopped_at, 10);
  EXPECT_LT(rig.cycle.stopped_at, 16) << "four of five cycles are its own";
}

TEST(WallLoop, TheTripsFigureIsTheWholeRow) {
  Rig rig(40);
  rig.StallAt5(60 * kMs);
  rig.Run();
  EXPECT_EQ(rig.cycle.seen[6].missed_in_row, 60);
}

TEST(WallLoop, SkipLeavesOneMorePointFree) {
  Rig rig(20);
  rig.options.overrun = rt::OverrunPolicy::kSkip;
  rig.StallAt5(kMs);
  EXPECT_EQ(rig.Run().missed, 2);
  EXPECT_EQ(rig.cycle.started_ns[6] - rig.cycle.started_ns[5], 3 * kPeriod);
}

TEST(WallLoop, HoldRepeatsTheCommandForExactlyOneCycle) {
  Rig rig(20);
  rig.options.overrun = rt::OverrunPolicy::kHold;
  rig.StallAt5(kMs);
  rig.Run();
  for (std::size_t k = 0; k < 20; ++k) EXPECT_EQ(rig.cycle.seen[k].hold, k == 6) << k;
}

TEST(WallLoop, StopStopsAtTheFirstOverrun) {
  Rig rig(20);
  rig.options.overrun = rt::OverrunPolicy::kStop;
  rig.StallAt5(kMs);
  rig.Run();
  EXPECT_EQ(rig.cycle.stopped_at, 6);
}

TEST(WallLoop, TheReceivePhaseEndsOnItsBudgetHoweverLateTheWakeUp) {
  Rig rig(5);
  rig.clock.set_wake_delay_ns(250'000);
  rig.Run();
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(rig.cycle.rx_deadline[k], rig.cycle.started_ns[k] + 400'000);
  EXPECT_EQ(rig.Recorded()[3].timing.wake_ns, 250'000);
}

TEST(WallLoop, TwoSecondsOfSilenceAreALostBus) {
  Rig rig(5000);
  rig.cycle.silent = true;
  const LoopResult result = rig.Run();
  EXPECT_EQ(result.status, CycleStatus::kBusLost);
  EXPECT_NEAR(static_cast<double>(result.cycles), 2001, 2);
}

TEST(WallLoop, AFullRingCostsSnapshotsAndNeverACycle) {
  Rig rig(300);  // the ring holds 256 and nobody reads
  const LoopResult result = rig.Run();
  EXPECT_EQ(result.cycles, 300);
  EXPECT_EQ(result.dropped, 300 - 256);
  EXPECT_EQ(result.missed, 0);
}

TEST(LoopOptions, FollowTheScenario) {
  TimingConfig timing;
  timing.rx_budget_us = 250.5;
  timing.overrun = TimingConfig::Overrun::kSkip;
  timing.phase_action = TimingConfig::PhaseAction::kDegrade;
  timing.max_broken_in_row = 7;
  const LoopOptions options = LoopOptionsFrom(timing);
  EXPECT_EQ(options.phases.budget_ns[0], 250'500);
  EXPECT_EQ(options.overrun, rt::OverrunPolicy::kSkip);
  EXPECT_EQ(options.phases.action, rt::PhaseAction::kDegrade);
  EXPECT_EQ(options.phases.max_in_row, 7);
}

TEST(WallLoop, ACycleKnowsThatMoreThanAPeriodHasPassed) {
  Rig rig(12);
  rig.StallAt5(3 * kMs);
  rig.Run();
  for (std::size_t k = 0; k < 12; ++k) EXPECT_EQ(rig.cycle.seen[k].gap, k == 6) << k;
}

TEST(LockstepLoop, ARingThatNobodyEmptiesDoesNotKeepARunThatShallStop) {
  rt::VirtualClock clock;
  test::FakeCycle cycle(clock, 100);
  telemetry::SnapshotRing ring(4);
  const std::atomic<bool> stop{true};
  const LoopResult result = RunLockstep(cycle, ring, stop);
  EXPECT_EQ(result.cycles, 100);
  EXPECT_EQ(result.dropped, 96);
  EXPECT_LT(result.wall_s, 30.0) << "the patience is for the whole run";
}

}  // namespace
}  // namespace reed
