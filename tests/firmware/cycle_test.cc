// The whole loop without a clock: press_known's limits, and how the arm starts and ends.
#include <gtest/gtest.h>

#include <cmath>

#include "reed/tests/firmware/sil_rig.h"

namespace reed {
namespace {

using mode::Mode;
using protect::Reason;
using test::SilRig;

Scenario PressKnown() { return LoadScenario("press_known"); }

struct Figures {
  double tangential_sum = 0.0, force_sum = 0.0, force_peak = 0.0;
  int joints = 0, cycles = 0;

  void Add(const SilRig& rig) {
    const telemetry::Snapshot& now = rig.snapshot();
    double DD = 0.0, De = 0.0;
    double e[kMaxJoints];
    for (std::size_t i = 0; i < static_cast<std::size_t>(now.dof); ++i) {
      e[i] = now.control.theta_plan[i] - now.measured.position[i];
      DD += now.control.D[i] * now.control.D[i];
      De += now.control.D[i] * e[i];
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(now.dof); ++i) {
      const double tangential = e[i] - now.control.D[i] * De / DD;
      tangential_sum += tangential * tangential;
      ++joints;
    }
    const double e_f = now.control.f_d - rig.truth().normal_force;
    force_sum += e_f * e_f;
    force_peak = std::max(force_peak, std::abs(e_f));
    ++cycles;
  }
  double tangential_rms_mrad() const { return 1e3 * std::sqrt(tangential_sum / joints); }
  double force_rms_N() const { return std::sqrt(force_sum / cycles); }
};

TEST(Cycle, PressesTheWallWithinTheScenariosLimitsAndTouchesNoHeap) {
  SilRig rig(PressKnown());
  double impact_N = 0.0;
  ASSERT_TRUE(rig.RunActive(0.001));
  while (rig.mode() == Mode::kActive && rig.snapshot().control.t_s < 2.0 - 1e-6) {
    rig.Run();
    impact_N = std::max(impact_N, rig.truth().normal_force);
  }
  Figures last_second;
  while (rig.mode() == Mode::kActive && rig.snapshot().control.t_s < 2.998) {
    rig.Run();
    last_second.Add(rig);
  }
  EXPECT_EQ(rig.mode(), Mode::kActive);
  EXPECT_GT(last_second.cycles, 990);
  EXPECT_LT(last_second.tangential_rms_mrad(), 0.8);
  EXPECT_LT(last_second.force_rms_N(), 0.03 * 8.0);
  EXPECT_LT(last_second.force_peak, 0.5);
  EXPECT_LT(impact_N, 10.0);
  EXPECT_GT(impact_N, 4.0) << "there was a wall";
  EXPECT_EQ(rig.heap_calls(), 0);
}

TEST(Cycle, WithoutTheWishTheArmIsOnlyWatched) {
  SilRig rig(PressKnown(), false);
  for (int i = 0; i < 500; ++i) {
    rig.Run();
    ASSERT_NE(rig.mode(), Mode::kActive);
    ASSERT_TRUE(rig.TorqueIsZero());
    ASSERT_TRUE(rig.truth().braked);
  }
  EXPECT_EQ(rig.mode(), Mode::kReady);
}

TEST(Cycle, DrivesThatBrakedOnTheWayToTheStartAreAskedAnew) {
  for (const int ready_for : {0, 1, 2}) {
    SilRig rig(PressKnown());
    for (int i = 0; i < 1000 && rig.drives().state() != bus::DriveState::kReady; ++i) rig.Run();
    for (int i = 0; i < ready_for; ++i) rig.Run();
    rig.commands_lost = true;
    for (int i = 0; i < 1000 && rig.drives().state() != bus::DriveState::kBraked; ++i) rig.Run();
    ASSERT_EQ(rig.drives().state(), bus::DriveState::kBraked);
    rig.commands_lost = false;
    EXPECT_TRUE(rig.RunActive(0.1)) << ready_for;
  }
}

TEST(Cycle, TheOperatorsStopEndsAWatchedRunToo) {
  for (const bool enable : {false, true}) {
    SilRig rig(PressKnown(), enable);
    for (int i = 0; i < 300; ++i) rig.Run();
    EXPECT_EQ(rig.mode(), enable ? Mode::kActive : Mode::kReady);
    CycleState loop;
    loop.stop_wanted = true;
    int cycles = 0;
    while (rig.Run(loop) == CycleStatus::kRunning && cycles < 100) ++cycles;
    EXPECT_LT(cycles, 20) << enable;
    EXPECT_TRUE(rig.TorqueIsZero());
    EXPECT_TRUE(rig.drives().braked());
    EXPECT_EQ(rig.trip(), Reason::kNone);
  }
}

TEST(Cycle, TheRunEndsByItselfAfterItsDurationWithBrakesClosed) {
  Scenario scenario = PressKnown();
  scenario.duration_s = 0.2;
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(0.15));
  int cycles = 0;
  while (rig.Run() == CycleStatus::kRunning && cycles < 1000) ++cycles;
  EXPECT_LT(cycles, 80);
  EXPECT_EQ(rig.mode(), Mode::kOff);
  EXPECT_EQ(rig.drives().state(), bus::DriveState::kOff) << "not left to brake by themselves";
  EXPECT_EQ(rig.trip(), Reason::kNone);
}

TEST(Cycle, EqualRunsAreEqualBitByBit) {
  SilRig one(PressKnown()), two(PressKnown());
  for (int i = 0; i < 800; ++i) {
    one.Run();
    two.Run();
    ASSERT_EQ(one.snapshot().control.tau, two.snapshot().control.tau) << "cycle " << i;
    ASSERT_EQ(one.snapshot().measured.position, two.snapshot().measured.position) << "cycle " << i;
  }
}

}  // namespace
}  // namespace reed
