// The separated strategy on the whole loop in virtual time: the real cycle, the bending arm, a wrist sensor
// whose frames are lost on the wire.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "reed/tests/firmware/sil_rig.h"

namespace reed {
namespace {

using mode::Mode;
using test::SilRig;

constexpr int kKnown = 1, kObserver = 3;

Scenario Press() {
  Scenario scenario = LoadScenario("press_sensor_loss");
  scenario.sensors.wrench_lost_from_s = -1.0;  // the test loses frames itself
  return scenario;
}

int Source(const SilRig& rig) { return rig.snapshot().control.force_source; }

/// Largest change of a commanded torque from one cycle to the next, in shares of the joint's limit.
class Steps {
 public:
  explicit Steps(const Scenario& scenario) : limit_(scenario.arm.torque_limit_Nm) {}
  double Next(const SilRig& rig) {
    double largest = 0.0;
    for (std::size_t i = 0; i < limit_.size(); ++i) {
      largest = std::max(largest, std::abs(rig.snapshot().control.tau[i] - before_[i]) / limit_[i]);
      before_[i] = rig.snapshot().control.tau[i];
    }
    return largest;
  }

 private:
  std::vector<double> limit_;
  std::array<double, kMaxJoints> before_{};
};

bool IsWrench(const bus::Frame& frame) { return frame.id == bus::layout::kWrench.id; }

TEST(Separation, LosingTheSensorInContactSwitchesWithinThreeCyclesWithoutAStepAndPressesOn) {
  const Scenario scenario = Press();
  SilRig rig(scenario);
  Steps steps(scenario);
  ASSERT_TRUE(rig.RunActive(1.4));
  double usual = 0.0;
  steps.Next(rig);
  for (int k = 0; k < 100; ++k) {
    rig.Run();
    usual = std::max(usual, steps.Next(rig));
  }
  ASSERT_EQ(Source(rig), kKnown);

  rig.on_the_way = [](std::uint32_t, bus::Frame& frame) { return !IsWrench(frame); };
  int cycles = 0;
  double at_switch = 0.0;
  while (Source(rig) == kKnown && cycles < 10) {
    rig.Run();
    at_switch = steps.Next(rig);
    ++cycles;
  }
  EXPECT_LE(cycles, 3);
  EXPECT_EQ(Source(rig), kObserver);
  EXPECT_LE(at_switch, usual) << "below what one cycle of normal control makes";
  EXPECT_LT(at_switch, 0.05);

  double largest = 0.0, least = 1e9;
  for (int k = 0; k < 500; ++k) {
    rig.Run();
    largest = std::max(largest, rig.truth().normal_force);
    least = std::min(least, rig.truth().normal_force);
  }
  EXPECT_EQ(rig.mode(), Mode::kActive);
  EXPECT_LT(largest, 16.0) << "twice the desired force";
  EXPECT_GT(least, 0.0) << "contact kept";

  // And back: not before a hundred sound frames, and again without a step.
  rig.on_the_way = nullptr;
  steps.Next(rig);
  int waited = 0;
  while (Source(rig) == kObserver && waited < 300) {
    rig.Run();
    at_switch = steps.Next(rig);
    ++waited;
  }
  EXPECT_GE(waited, 100);
  EXPECT_EQ(Source(rig), kKnown);
  EXPECT_LT(at_switch, 0.05);
  EXPECT_EQ(rig.heap_calls(), 0);
}

// The first frame after a gap is not used, so one that is missing makes two cycles without a reading.
TEST(Separation, AFrameThatIsMissingNowAndThenIsNoLoss) {
  SilRig rig(Press());
  ASSERT_TRUE(rig.RunActive(1.0));
  rig.on_the_way = [](std::uint32_t cycle, bus::Frame& frame) { return !IsWrench(frame) || cycle % 4 != 0; };
  for (int k = 0; k < 300; ++k) {
    rig.Run();
    ASSERT_EQ(Source(rig), kKnown);
  }
}

TEST(Separation, FramesThatReturnWhileTheArmMeetsTheWallDoNotMakeItsForceTheSensorsZero) {
  SilRig free(Press());
  ASSERT_TRUE(free.RunActive(0.1));
  while (free.truth().normal_force == 0.0 && free.mode() == Mode::kActive) free.Run();
  const double contact_s = free.snapshot().control.t_s;
  for (const double before_s : {0.004, 0.03, 0.05, 0.07}) {
    SilRig rig(Press());
    ASSERT_TRUE(rig.RunActive(contact_s - before_s));
    const std::uint32_t from = rig.cycle_number();
    rig.on_the_way = [from](std::uint32_t cycle, bus::Frame& frame) {
      return !IsWrench(frame) || cycle >= from + 4;
    };
    ASSERT_TRUE(rig.RunActive(contact_s + 1.0));
    EXPECT_EQ(Source(rig), kKnown);
    EXPECT_NEAR(rig.snapshot().control.f, rig.truth().normal_force, 0.2) << before_s;
  }
}

TEST(Separation, ASaturatedReadingIsNoLossButStopsTheArm) {
  Scenario scenario = Press();
  scenario.sensors.force_range_N = 6.0;
  scenario.force.desired_N = 6.3;
  SilRig rig(scenario);
  for (int k = 0; k < 2000 && rig.mode() != Mode::kFault; ++k) {
    rig.Run();
    if (rig.mode() == Mode::kActive) {
      ASSERT_EQ(Source(rig), kKnown);
    }
  }
  EXPECT_EQ(rig.mode(), Mode::kFault);
  EXPECT_EQ(rig.trip(), protect::Reason::kWrenchRange);
  EXPECT_EQ(rig.trip_place().value, 6.0);
}

TEST(Separation, AConstantReadingIsNoLoss) {
  Scenario scenario = Press();
  scenario.sensors.force_noise_N = 0.0;
  scenario.sensors.force_quantum_N = 10.0;
  scenario.force.start_s = 10.0;  // free all the time: the reading is 0 and never changes
  SilRig rig(scenario);
  ASSERT_TRUE(rig.RunActive(0.1));
  for (int k = 0; k < 500; ++k) {
    rig.Run();
    ASSERT_EQ(rig.snapshot().measured.force[2], 0.0);
    ASSERT_EQ(Source(rig), kKnown);
  }
}

TEST(Separation, NodalCompensationWithTrueParametersBringsTheBentTipAtLeastThreeTimesCloser) {
  const auto tip_error = [](bool compensate) {
    Scenario scenario = LoadScenario("free_motion");
    scenario.control.nodal_compensation = compensate;
    SilRig rig(scenario);
    EXPECT_TRUE(rig.RunActive(2.0));
    double sum = 0.0;
    for (int k = 0; k < 500; ++k) {
      rig.Run();
      for (std::size_t i = 0; i < 3; ++i)
        sum += std::pow(rig.truth().tip[i] - rig.snapshot().control.tip_plan[i], 2);
    }
    return std::sqrt(sum / 500.0);
  };
  EXPECT_LT(3.0 * tip_error(true), tip_error(false));
}

TEST(Separation, ThePrintedUnknownForceLawDivergesAndTheLimitsStopTheArm) {
  Scenario scenario = LoadScenario("fluctuating_unknown");
  scenario.control.law = "paper_printed";
  SilRig rig(scenario);
  EXPECT_FALSE(rig.RunActive(3.0));
  EXPECT_EQ(rig.mode(), Mode::kFault);
  EXPECT_TRUE(rig.trip() == protect::Reason::kJointSpeed || rig.trip() == protect::Reason::kJointPosition);
  EXPECT_TRUE(rig.TorqueIsZero());
}

}  // namespace
}  // namespace reed
