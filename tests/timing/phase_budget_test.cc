// Part 1 of the timing budget, in virtual time: what a phase that is too long leads to. No real waiting.
#include <gtest/gtest.h>

#include <reed/event_t.hpp>
#include <string>

#include "reed/firmware/record/encode.h"
#include "reed/tests/timing/realtime_loop_rig.h"

namespace reed {
namespace {

/// Compute takes 301 µs of 300 in cycles 4, 5 and 6.
void SlowCompute(Rig& rig) {
  rig.cycle.cost = [](std::uint32_t k) {
    test::CycleCost cost;
    if (k >= 4 && k <= 6) cost.compute = 301'000;
    return cost;
  };
}

TEST(PhaseBudget, CountOnlyCountsAndTellsOnceWithTheLastThreeCycles) {
  Rig rig(12);
  SlowCompute(rig);
  rig.Run();
  for (const CycleState& state : rig.cycle.seen) {
    EXPECT_FALSE(state.hold);
    EXPECT_FALSE(state.degrade);
  }
  const auto recorded = rig.Recorded();
  EXPECT_EQ(recorded.back().timing.compute_over, 3);
  EXPECT_EQ(recorded.back().timing.rx_over, 0);
  ASSERT_EQ(Events(recorded, protect::Reason::kPhaseBudget), 1);
  ASSERT_EQ(recorded[4].num_events, 1);
  EXPECT_EQ(recorded[4].events[0].value, 1.0) << "compute";
  const rt::PhaseHistory expected{
      {{100'000, 50'000, 10'000}, {100'000, 50'000, 10'000}, {100'000, 301'000, 10'000}}};
  EXPECT_EQ(recorded[4].phase_history, expected);
}

TEST(PhaseBudget, TheEventsTextTellsTheLastThreeCyclesPhaseTimes) {
  Rig rig(12);
  SlowCompute(rig);
  rig.Run();
  telemetry::MessageEncoder encoder;
  const telemetry::Bytes bytes = encoder.Event(rig.Recorded()[4], 0, "a phase was too long", 0);
  reed::event_t event;
  ASSERT_GT(event.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
  EXPECT_EQ(event.text.rfind("a phase was too long", 0), 0U);
  std::size_t at = 0;
  for (const char* phase : {"100", "50", "10", "100", "50", "10", "100", "301", "10"}) {
    at = event.text.find(phase, at);
    ASSERT_NE(at, std::string::npos) << phase << " is not told in its place: " << event.text;
    at += std::string(phase).size();
  }
}

TEST(PhaseBudget, ExactlyTheBudgetIsWithinIt) {
  Rig rig(12);
  rig.cycle.cost = [](std::uint32_t) { return test::CycleCost{400'000, 300'000, 300'000 - 1, 0}; };
  rig.Run();
  const auto recorded = rig.Recorded();
  EXPECT_EQ(recorded.back().timing.rx_over + recorded.back().timing.compute_over, 0);
}

TEST(PhaseBudget, HoldAndDegradeLastAsLongAsTheBreachAndOneCycle) {
  for (const rt::PhaseAction action : {rt::PhaseAction::kHold, rt::PhaseAction::kDegrade}) {
    Rig rig(12);
    rig.options.phases.action = action;
    SlowCompute(rig);
    rig.Run();
    for (std::size_t k = 0; k < 12; ++k) {
      const bool expected = k >= 5 && k <= 7;
      EXPECT_EQ(rig.cycle.seen[k].hold, expected && action == rt::PhaseAction::kHold) << k;
      EXPECT_EQ(rig.cycle.seen[k].degrade, expected && action == rt::PhaseAction::kDegrade) << k;
    }
  }
}

TEST(PhaseBudget, FaultComesAfterSoManyInARowAndNotBefore) {
  Rig rig(12);
  rig.options.phases.action = rt::PhaseAction::kFault;
  rig.options.phases.max_in_row = 3;
  SlowCompute(rig);
  rig.Run();
  EXPECT_EQ(rig.cycle.stopped_at, -1);

  Rig strict(12);
  strict.options.phases.action = rt::PhaseAction::kFault;
  strict.options.phases.max_in_row = 2;
  SlowCompute(strict);
  strict.Run();
  EXPECT_EQ(strict.cycle.stopped_at, 7) << "the cycle after the third";
}

/// A controller that waits for its arm breaks the receive budget all the time.
TEST(PhaseBudget, AFaultOfATimeInWhichNothingWasActiveIsForgotten) {
  Rig rig(12);
  rig.options.phases.action = rt::PhaseAction::kFault;
  rig.options.phases.max_in_row = 2;
  rig.cycle.active = false;
  SlowCompute(rig);
  rig.Run();
  for (std::size_t k = 0; k < 12; ++k) EXPECT_EQ(rig.cycle.seen[k].phase_budget_exceeded, k == 7) << k;
}

}  // namespace
}  // namespace reed
