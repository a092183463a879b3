// Part 2 of the timing budget, in virtual time: the grid, overrun policies, host pauses. No real waiting.
#include <gtest/gtest.h>

#include "reed/firmware/startup/loop_options.h"
#include "reed/tests/timing/realtime_loop_rig.h"

namespace reed {
namespace {

TEST(RealtimeLoop, PunctualCyclesStayOnTheGridAndNothingIsCounted) {
  Rig rig(50);
  const LoopResult result = rig.Run();
  EXPECT_EQ(result.cycles, 50);
  EXPECT_EQ(result.missed, 0);
  EXPECT_EQ(result.overruns, 0);
  for (std::size_t k = 0; k < 50; ++k)
    EXPECT_EQ(rig.cycle.started_ns[k], 7'000 + static_cast<std::int64_t>(k + 1) * kPeriod);
  EXPECT_EQ(Events(rig.Recorded(), protect::Reason::kPhaseBudget), 0);
}

TEST(RealtimeLoop, ADefaultLoopSurvivesADelayOfTenMilliseconds) {
  Rig rig(40);
  rig.DelayAt5(10 * kMs);
  const LoopResult result = rig.Run();
  EXPECT_EQ(rig.cycle.stopped_at, -1);
  EXPECT_EQ(result.cycles, 40);
  EXPECT_EQ(result.missed, 10);
  EXPECT_EQ(result.overruns, 1);
  EXPECT_EQ((rig.cycle.started_ns[6] - 7'000) % kPeriod, 0) << "the grid has kept its phase";
  const auto recorded = rig.Recorded();
  EXPECT_EQ(Events(recorded, protect::Reason::kCyclesMissed), 1);
  EXPECT_EQ(recorded[5].timing.missed, 10) << "recorded with the cycle that lost the time";
}

TEST(RealtimeLoop, ADefaultLoopStopsWithinTwentyMissedCycles) {
  Rig rig(40);
  rig.DelayAt5(20 * kMs);
  const LoopResult result = rig.Run();
  EXPECT_EQ(result.missed, 20);
  EXPECT_EQ(rig.cycle.stopped_at, 6);
}

TEST(RealtimeLoop, NineteenMissedCyclesAreStillSurvived) {
  Rig rig(40);
  rig.DelayAt5(19 * kMs);
  EXPECT_EQ(rig.Run().missed, 19);
  EXPECT_EQ(rig.cycle.stopped_at, -1);
}

TEST(RealtimeLoop, MissesAddUpWhileEachCycleTakesLongerThanItsPeriod) {
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

TEST(RealtimeLoop, LateCyclesThatThenTakeTheirTimeDoNotAddUp) {
  Rig rig(40);
  rig.clock.set_wake_delay_ns(8 * kMs);
  EXPECT_GE(rig.Run().missed, 300);
  EXPECT_EQ(rig.cycle.stopped_at, -1);
  Rig longer(40);
  longer.clock.set_wake_delay_ns(20 * kMs);
  longer.Run();
  EXPECT_EQ(longer.cycle.stopped_at, 1) << "one delay of twenty periods is too long whoever served before";
  EXPECT_EQ(longer.cycle.seen[1].missed_in_row, 20) << "the figure of the trip";
}

/// Cycle 5 is followed by a pause of 42 ms, at one of the places where it can come.
test::CycleCost PauseAt5(std::uint32_t k, bool in_sleep) {
  test::CycleCost cost;
  (in_sleep ? cost.pause_in_sleep : cost.pause) = k == 5 ? 42 * kMs : 0;
  return cost;
}

TEST(RealtimeLoop, WhatIsMissedInAHostPauseIsCountedAndStopsNothing) {
  for (const bool in_sleep : {false, true}) {
    Rig rig(40);
    rig.cycle.cost = [in_sleep](std::uint32_t k) { return PauseAt5(k, in_sleep); };
    const LoopResult result = rig.Run();
    EXPECT_NEAR(static_cast<double>(result.missed), 42, 1);
    EXPECT_EQ(result.missed_host_paused, result.missed);
    EXPECT_EQ(result.overruns, 1);
    EXPECT_EQ(rig.cycle.stopped_at, -1);
    for (const CycleState& seen : rig.cycle.seen) EXPECT_EQ(seen.missed_in_row, 0);
    EXPECT_EQ((rig.cycle.started_ns[8] - 7'000) % kPeriod, 0) << "the grid has kept its phase";
    const auto recorded = rig.Recorded();
    EXPECT_EQ(recorded.back().timing.missed_host_paused, result.missed);
    EXPECT_EQ(Events(recorded, protect::Reason::kCyclesMissed), 1);
  }
}

TEST(RealtimeLoop, OnRealDrivesAPauseIsTheControllersOwn) {
  for (const bool in_sleep : {false, true}) {
    Rig rig(40);
    rig.cycle.cost = [in_sleep](std::uint32_t k) { return PauseAt5(k, in_sleep); };
    const LoopResult result = rig.RunOnRealDrives();
    EXPECT_GT(rig.cycle.stopped_at, 5);
    EXPECT_EQ(result.missed_host_paused, 0);
  }
}

TEST(RealtimeLoop, AHostPauseExcusesNothingButItself) {
  Rig rig(40);
  rig.cycle.cost = [](std::uint32_t k) {
    test::CycleCost cost;
    if (k == 5) cost.pause = 42 * kMs;
    if (k == 7) cost.after = 42 * kMs;
    return cost;
  };
  rig.Run();
  EXPECT_EQ(rig.cycle.stopped_at, 8) << "the second delay is the loop's own";

  Rig mixed(40);
  mixed.cycle.cost = [](std::uint32_t k) {
    test::CycleCost cost;
    if (k == 5) cost.pause = 42 * kMs, cost.after = 20 * kMs;
    return cost;
  };
  EXPECT_EQ(mixed.Run().missed_host_paused, 42);
  EXPECT_EQ(mixed.cycle.stopped_at, 6) << "a long pause does not hide a late loop";
  EXPECT_EQ(mixed.cycle.seen[6].missed_in_row, 20);
}

TEST(RealtimeLoop, AShortDelayBesideAPauseIsJudgedByItsOwnLength) {
  Rig rig(40);
  rig.cycle.cost = [](std::uint32_t k) {
    test::CycleCost cost;
    if (k == 5) cost.pause = 8 * kMs, cost.after = 15 * kMs;
    return cost;
  };
  EXPECT_EQ(rig.Run().missed, 23);
  EXPECT_EQ(rig.cycle.stopped_at, -1);
}

TEST(RealtimeLoop, ASlowLoopStopsAtTheSameCycleHoweverOftenTheHostPauses) {
  const auto stopped_at = [](std::int64_t pause_ns) {
    Rig rig(100);
    rig.cycle.cost = [pause_ns](std::uint32_t k) {
      test::CycleCost cost;
      cost.after = 2 * kMs;  // two missed in each cycle
      cost.pause = k % 3 == 0 ? pause_ns : 0;
      return cost;
    };
    rig.Run();
    return rig.cycle.stopped_at;
  };
  EXPECT_EQ(stopped_at(0), 10);
  EXPECT_EQ(stopped_at(6 * kMs), 10);
  EXPECT_EQ(stopped_at(60 * kMs), 10);
}

TEST(RealtimeLoop, APauseLeadsToNoHoldNoSkipAndNoStop) {
  for (const auto policy : {rt::OverrunPolicy::kHold, rt::OverrunPolicy::kSkip, rt::OverrunPolicy::kStop}) {
    Rig rig(20);
    rig.options.overrun = policy;
    rig.cycle.cost = [](std::uint32_t k) { return PauseAt5(k, false); };
    EXPECT_EQ(rig.Run().missed, 42);
    EXPECT_EQ(rig.cycle.stopped_at, -1);
    for (const CycleState& seen : rig.cycle.seen) EXPECT_FALSE(seen.hold);
  }
}

TEST(RealtimeLoop, ABusIsNotLostByAHostPause) {
  Rig rig(40);
  rig.cycle.cost = [](std::uint32_t k) {
    test::CycleCost cost;
    if (k == 5) cost.pause = 3000 * kMs;
    return cost;
  };
  rig.cycle.silent_from = 5;
  rig.cycle.silent_to = 6;
  EXPECT_EQ(rig.Run().status, CycleStatus::kFinished);
}

TEST(RealtimeLoop, TheTripsFigureIsTheWholeRow) {
  Rig rig(40);
  rig.DelayAt5(60 * kMs);
  rig.Run();
  EXPECT_EQ(rig.cycle.seen[6].missed_in_row, 60);
}

TEST(RealtimeLoop, SkipLeavesOneMorePointFree) {
  Rig rig(20);
  rig.options.overrun = rt::OverrunPolicy::kSkip;
  rig.DelayAt5(kMs);
  EXPECT_EQ(rig.Run().missed, 2);
  EXPECT_EQ(rig.cycle.started_ns[6] - rig.cycle.started_ns[5], 3 * kPeriod);
}

TEST(RealtimeLoop, HoldRepeatsTheCommandForExactlyOneCycle) {
  Rig rig(20);
  rig.options.overrun = rt::OverrunPolicy::kHold;
  rig.DelayAt5(kMs);
  rig.Run();
  for (std::size_t k = 0; k < 20; ++k) EXPECT_EQ(rig.cycle.seen[k].hold, k == 6) << k;
}

TEST(RealtimeLoop, StopStopsAtTheFirstOverrun) {
  Rig rig(20);
  rig.options.overrun = rt::OverrunPolicy::kStop;
  rig.DelayAt5(kMs);
  rig.Run();
  EXPECT_EQ(rig.cycle.stopped_at, 6);
}

TEST(RealtimeLoop, TheReceivePhaseEndsOnItsBudgetHoweverLateTheWakeUp) {
  Rig rig(5);
  rig.clock.set_wake_delay_ns(250'000);
  rig.Run();
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(rig.cycle.rx_deadline[k], rig.cycle.started_ns[k] + 400'000);
  EXPECT_EQ(rig.Recorded()[3].timing.wake_ns, 250'000);
}

TEST(RealtimeLoop, TwoSecondsOfSilenceAreALostBus) {
  Rig rig(5000);
  rig.cycle.silent = true;
  const LoopResult result = rig.Run();
  EXPECT_EQ(result.status, CycleStatus::kBusLost);
  EXPECT_NEAR(static_cast<double>(result.cycles), 2001, 2);
}

TEST(RealtimeLoop, AFullRingCostsSnapshotsAndNeverACycle) {
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

TEST(RealtimeLoop, ACycleKnowsThatMoreThanAPeriodHasPassed) {
  Rig rig(12);
  rig.DelayAt5(3 * kMs);
  rig.Run();
  for (std::size_t k = 0; k < 12; ++k) EXPECT_EQ(rig.cycle.seen[k].gap, k == 6) << k;
}

TEST(LockstepLoop, ARingThatNobodyEmptiesDoesNotKeepARunThatShallStop) {
  test::PausingVirtualClock clock;
  test::FakeCycle cycle(clock, 100);
  telemetry::SnapshotRing ring(4);
  const std::atomic<bool> stop{true};
  const LoopResult result = RunLockstep(0, cycle, ring, stop);
  EXPECT_EQ(result.cycles, 100);
  EXPECT_EQ(result.dropped, 96);
  EXPECT_LT(result.wall_s, 30.0) << "the patience is for the whole run";
}

}  // namespace
}  // namespace reed
