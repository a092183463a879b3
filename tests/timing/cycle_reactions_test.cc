// What a cycle does when the loop tells it that time was short: hold, degrade, stop. The real cycle and
// plant, virtual time.
#include <gtest/gtest.h>

#include "tests/firmware/sil_rig.h"

namespace reed {
namespace {

Scenario Pressing() {
  Scenario scenario = LoadScenario("press_known");
  scenario.duration_s = 2.0;
  return scenario;
}

/// One cycle in which the loop says `state`; the snapshot before it.
telemetry::Snapshot StepWith(test::SilRig& rig, const LoopState& state) {
  const telemetry::Snapshot before = rig.snapshot();
  rig.Run(state);
  return before;
}

TEST(CycleReactions, HoldRepeatsTheLastCommandAndTheNextCycleComputesAgain) {
  test::SilRig rig(Pressing());
  ASSERT_TRUE(rig.RunActive(0.3));
  LoopState hold;
  hold.hold = true;
  const telemetry::Snapshot before = StepWith(rig, hold);
  EXPECT_EQ(rig.snapshot().control.tau, before.control.tau);
  EXPECT_EQ(rig.snapshot().adaptation.p_hat, before.adaptation.p_hat)
      << "nothing is learnt from a held cycle";
  rig.Run();
  EXPECT_NE(rig.snapshot().control.tau, before.control.tau);
}

TEST(CycleReactions, DegradeStopsLearningAndKeepsControlling) {
  test::SilRig rig(Pressing());
  ASSERT_TRUE(rig.RunActive(0.3));
  LoopState degrade;
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
  LoopState broken;
  broken.phase_budget_exceeded = true;
  broken.broken_in_row = 21;
  rig.Run(broken);
  EXPECT_EQ(rig.mode(), mode::Mode::kFault);
  EXPECT_EQ(rig.trip(), protect::Reason::kPhaseBudgetInRow);
  EXPECT_TRUE(rig.TorqueIsZero());
}

}  // namespace
}  // namespace reed
