// Broken and forged frames between the real controller and the real arm: the torque that is asked for and applied stays within
// its limits, and a trip is for good.
#include <gtest/gtest.h>

#include <cmath>

#include "reed/tests/endurance/frame_mutants.h"
#include "reed/tests/endurance/how_long.h"
#include "reed/tests/firmware/sil_rig.h"

namespace reed {
namespace {

using test::SilRig;

void ExpectWithinLimits(const SilRig& rig, const Scenario& scenario) {
  const double scale = scenario.limits.torque_scale;
  for (std::size_t i = 0; i < scenario.arm.torque_limit_Nm.size(); ++i) {
    const double limit = scenario.arm.torque_limit_Nm[i];
    ASSERT_TRUE(std::abs(rig.snapshot().control.tau[i]) <= scale * limit);
    ASSERT_TRUE(std::abs(rig.drives().torque_Nm()[static_cast<Eigen::Index>(i)]) <= limit);
  }
  if (rig.mode() == mode::Mode::kFault) {
    ASSERT_TRUE(rig.TorqueIsZero());
  }
}

TEST(WholeLoopFuzz, NoTorqueBeyondItsLimitAndNoWayBackFromAFault) {
  const Scenario scenario = LoadScenario("press_known");
  test::FrameMutants mutants(4);
  const long trials = test::HowMany(10, 2000);
  int faults = 0;
  for (long trial = 0; trial < trials; ++trial) {
    SilRig rig(scenario);
    ASSERT_TRUE(rig.RunActive(0.01 + 0.001 * static_cast<double>(mutants.Below(30))));
    const std::uint64_t share = 1 + mutants.Below(100);  // of the frames, in percent
    rig.on_the_way = [&](std::uint32_t cycle, bus::Frame& frame) {
      mutants.cycle = cycle;
      if (mutants.Below(100) < share) frame = mutants.Next();
      return true;
    };
    for (int k = 0; k < 150; ++k) {
      if (mutants.Below(4) == 0) rig.injected = mutants.Next();
      rig.commands_lost = mutants.Below(50) == 0;
      const bool fault = rig.mode() == mode::Mode::kFault;
      rig.Run();
      ASSERT_NO_FATAL_FAILURE(ExpectWithinLimits(rig, scenario)) << "trial " << trial << ", cycle " << k;
      if (fault) {
        ASSERT_EQ(rig.mode(), mode::Mode::kFault);
      }
    }
    faults += rig.mode() == mode::Mode::kFault ? 1 : 0;
    EXPECT_EQ(rig.heap_calls(), 0);
  }
  EXPECT_GT(faults, trials / 2);
}

}  // namespace
}  // namespace reed
