// What a cycle does when the loop tells it that time was short: hold, degrade, stop. The real cycle and
// plant, virtual time.
#include <gtest/gtest.h>

#include "reed/tests/firmware/sil_rig.h"

namespace reed {
namespace {

Scenario Pressing() {
  Scenario scenario = LoadScenario("press_known");
  scenario.duration_s = 2.0;
  return scenario;
}

/// One cycle in which the loop says `state`; the snapshot before it.
telemetry::Snapshot StepWith(test::SilRig& rig, const CycleState& state) {
  const telemetry::Snapshot before = rig.snapshot();
  rig.Run(state);
  return before;
}

TEST(CycleReactions, HoldRepeatsTheLastCommandAndTheNextCycleComputesAgain) {
  test::SilRig rig(Pressing());
  ASSERT_TRUE(rig.RunActive(0.3));
  CycleState hold;
  hold.hold = true;
  const telemetry::Snapshot before = StepWith(rig, hold);
  EXPECT_EQ(rig.snapshot().control.tau, before.control.tau);
  EXPECT_EQ(rig.snapshot().adaptation.p_hat, before.adaptation.p_hat)
      << "nothing is learnt from a held cycle";
  rig.Run();
  EXPECT_NE(rig.snapshot().control.tau, before.control.tau);
}

TEST(CycleReactions, TheObserverLearnsNothingAcrossAHeldCycleOrAGap) {
  CycleState hold, gap;
  hold.hold = true;
  gap.gap = true;
  for (const CycleState& state : {hold, gap}) {
    test::SilRig rig(Pressing());
    ASSERT_TRUE(rig.RunActive(0.2));  // the path is at full speed
    const telemetry::Snapshot before = StepWith(rig, state);
    if (state.hold) rig.Run();
    EXPECT_EQ(rig.snapshot().control.observer, before.control.observer);
    rig.Run();
    EXPECT_NE(rig.snapshot().control.observer, before.control.observer);
  }
}

TEST(CycleReactions, DegradeStopsLearningAndKeepsControlling) {
  test::SilRig rig(Pressing());
  ASSERT_TRUE(rig.RunActive(0.3));
  CycleState degrade;
  degrade.degrade = true;
  const telemetry::Snapshot before = StepWith(rig, degrade);
  EXPECT_EQ(rig.snapshot().adaptation.p_hat, before.adaptation.p_hat);
  EXPECT_EQ(rig.snapshot().adaptation.sigma1, before.adaptation.sigma1);
  EXPECT_NE(rig.snapshot().control.tau, before.control.tau);
  rig.Run();
  EXPECT_NE(rig.snapshot().adaptation.p_hat, before.adaptation.p_hat) << "the next full cycle learns again";
}

TEST(CycleReactions, TooManyBrokenBudgetsInARowStopTheArmInTheSameCycle) {
  test::SilRig rig(Pressing());
  ASSERT_TRUE(rig.RunActive(0.3));
  CycleState broken;
  broken.phase_budget_exceeded = true;
  broken.broken_in_row = 21;
  rig.Run(broken);
  EXPECT_EQ(rig.mode(), mode::Mode::kFault);
  EXPECT_EQ(rig.trip(), protect::Reason::kPhaseBudgetInRow);
  EXPECT_TRUE(rig.TorqueIsZero());
}

TEST(CycleReactions, TooManyMissesInARowStopTheArmInTheSameCycleWhetherItAnswersOrNot) {
  CycleState missed;
  missed.missed_in_row_exceeded = true;
  missed.missed_in_row = 42;
  for (const bool answers : {true, false}) {
    test::SilRig rig(Pressing());
    ASSERT_TRUE(rig.RunActive(0.3));
    if (!answers) rig.on_the_way = [](std::uint32_t, bus::Frame&) { return false; };
    rig.Run(missed);
    EXPECT_EQ(rig.mode(), mode::Mode::kFault);
    EXPECT_EQ(rig.trip(), protect::Reason::kMissedCycles);
    EXPECT_TRUE(rig.TorqueIsZero());
  }
}

}  // namespace
}  // namespace reed
