// Force mode against a spring wall in virtual time: seek, latch, track, and no wind-up behind the speed
// limit.
#include "reed/core/contact/force_mode.h"

#include <gtest/gtest.h>

namespace reed::strategy {
namespace {

constexpr double kT = 1e-3;

ForceModeConfig Config() {
  ForceModeConfig config;
  config.gains = {4e-3, 30e-3, 200.0};
  return config;
}

reference::ForceProfile Press(double newton) { return {newton, 0.0, 0.3, 1e9}; }

NormalMotion At(double x) { return {x, -1.0, {}}; }

/// A tip that moves exactly as asked (s = 0), in front of a wall of stiffness k_e at x = 0.
struct Tip {
  double x = 2e-3, k_e = 5e3;
  double force() const { return x < 0.0 ? -k_e * x : 0.0; }
  void Move(const ForceDemand& demand) { x -= kT * demand.z; }
};

TEST(ForceMode, SeeksTheWallLatchesOnceAndTracksOnWallsFromOneToFortyKilonewtonPerMetre) {
  for (const double k_e : {1e3, 5e3, 10e3, 20e3, 40e3}) {
    ForceModeConfig config = Config();
    config.schedule = true;
    config.bandwidth_radps = 40.0;
    ForceMode mode(config, Press(8.0), kT);
    Tip tip;
    tip.k_e = k_e;
    int latched = 0;
    double largest = 0.0;
    ForceDemand demand;
    for (int k = 0; k < 3000; ++k) {
      demand = mode.Step(kT * k, tip.force(), At(tip.x), 1.0);
      latched += demand.latched_now ? 1 : 0;
      tip.Move(demand);
      largest = std::max(largest, tip.force());
    }
    EXPECT_EQ(latched, 1) << k_e;
    EXPECT_NEAR(tip.force(), 8.0, 0.05) << k_e;
    EXPECT_LT(largest, 12.0) << k_e;
  }
}

TEST(ForceMode, StaysLatchedWhenTheTipBounces) {
  ForceMode mode(Config(), Press(8.0), kT);
  mode.Step(0.0, 5.0, At(0.0), 1.0);
  ASSERT_TRUE(mode.in_contact());
  const ForceDemand off = mode.Step(kT, 0.0, At(1e-3), 1.0);
  EXPECT_TRUE(mode.in_contact());
  EXPECT_FALSE(off.latched_now);
}

TEST(ForceMode, AWallMetBeforeItsTimeIsTouchedAndNotPushedThrough) {
  reference::ForceProfile late = Press(8.0);
  late.start_s = 0.3;
  ForceMode mode(Config(), late, kT), observed(Config(), late, kT);
  EXPECT_FALSE(mode.Step(0.1, 0.5, At(0.0), 1.0).active) << "noise is no contact";
  EXPECT_TRUE(mode.Step(0.101, 2.0, At(0.0), 1.0).latched_now);
  const ForceDemand touching = mode.Step(0.102, 2.0, At(0.0), 1.0);
  EXPECT_TRUE(touching.active);
  EXPECT_EQ(touching.f_d, 0.0);
  EXPECT_LT(touching.z_dot, 0.0) << "gives way";
  EXPECT_TRUE(mode.Step(0.103, 0.0, At(0.0), 1.0).active) << "latched";
  EXPECT_NEAR(mode.Step(0.7, 8.0, At(0.0), 1.0).f_d, 8.0, 1e-9) << "the ramp starts at its own time";
  EXPECT_FALSE(observed.Step(0.101, 2.0, At(0.0), 1.0, false).active)
      << "an observed force may be a wrong weight";
}

TEST(ForceMode, DoesNotWindUpBehindTheSpeedLimit) {
  // The wall is gone for two seconds: the limit acts. Once it is back, the overshoot is that of a short
  // absence.
  const auto largest_after = [](int absent_cycles) {
    ForceModeConfig config = Config();
    config.speed_limit_mps = 0.02;
    ForceMode mode(config, Press(8.0), kT);
    for (int k = 0; k < 300; ++k) mode.Step(0.001 * k, 8.0, At(0.0), 1.0);
    bool limited = false;
    for (int k = 0; k < absent_cycles; ++k) limited |= mode.Step(0.5, 0.0, At(0.0), 1.0).speed_limited;
    EXPECT_TRUE(limited);
    return mode.state().e_f_integral;
  };
  EXPECT_NEAR(largest_after(2000), largest_after(200), 1e-9);
}

TEST(ForceMode, ItsGainKeepsTheLoopsSpeedOnEveryWallAndTheStabilityRule) {
  ForceModeConfig config = Config();
  config.schedule = true;
  for (const double k_e : {1e3, 5e3, 20e3}) {
    ForceMode mode(config, Press(8.0), kT);
    for (int k = 0; k < 600; ++k) {
      const double depth = 8.0 / k_e * std::min(1.0, k / 300.0) + 1e-3 * std::sin(0.02 * k) * 5e3 / k_e;
      mode.Step(kT * k, k_e * depth + 1.5, At(-depth), 1.0);
    }
    const control::ForceGains g = mode.Gains(1.0);
    EXPECT_LE(g.k_p * k_e, 1.1 * config.bandwidth_radps);
    EXPECT_LT(g.k_i, g.a * g.k_p);
    EXPECT_NEAR(mode.Gains(0.5).k_p, 0.5 * g.k_p, 1e-12) << "slower where the force comes late";
  }
}

TEST(ForceMode, WithoutAWishAsksForNothing) {
  ForceMode mode(Config(), Press(0.0), kT);
  EXPECT_FALSE(mode.Step(1.0, 20.0, At(0.0), 1.0).active);
}

/// A press of 8 N that has ended at 1.3 s, on a path that leads this far off the wall.
ForceDemand AfterTheEnd(ForceMode& mode, double t_s, double f, double path_gap, double x = 0.0) {
  return mode.Step(t_s, f, {x, path_gap, {}}, 1.0);
}

TEST(ForceMode, AfterItsEndTheWallIsTouchedWithoutForceUntilThePathLeadsOffIt) {
  reference::ForceProfile press = Press(8.0);
  press.end_s = 1.0;
  ForceMode mode(Config(), press, kT);
  for (int k = 0; k < 1300; ++k) mode.Step(kT * k, 8.0, At(0.0), 1.0);
  const ForceDemand pushed = AfterTheEnd(mode, 1.4, 8.0, -2e-3);
  EXPECT_TRUE(pushed.active);
  EXPECT_EQ(pushed.f_d, 0.0);
  ForceDemand gives_way;
  for (int k = 0; k < 200; ++k) gives_way = AfterTheEnd(mode, 1.4, 8.0, -2e-3);
  EXPECT_LT(gives_way.z, -0.01);
  EXPECT_TRUE(AfterTheEnd(mode, 1.7, 0.0, 0.1e-3).active) << "beside the wall is not off it";
  EXPECT_FALSE(AfterTheEnd(mode, 1.8, 0.0, 0.3e-3).active);
  EXPECT_FALSE(mode.in_contact());
  EXPECT_TRUE(AfterTheEnd(mode, 1.9, 5.0, -2e-3).latched_now) << "a path that leads into it again";
}

TEST(ForceMode, AForceThatIsNoMoreThanTheSensorsOwnMovesNothingInTheEnd) {
  reference::ForceProfile press = Press(8.0);
  press.end_s = 1.0;
  ForceMode mode(Config(), press, kT);
  double f = 2.0;
  for (int k = 0; k < 1300; ++k) f = mode.Step(kT * k, k == 0 ? 2.0 : f, At(0.0), 1.0).f_d;
  double x = 0.0;
  for (int k = 0; k < 100'000; ++k) x -= kT * AfterTheEnd(mode, 1.4 + kT * k, 0.3, -2e-3, x).z;
  EXPECT_LT(std::abs(x), NormalAnchor::kMayDrift_m);
}

TEST(ForceMode, ATipThatDriftsWhileItSeeksIsBroughtBackWithinWhatItMay) {
  ForceMode mode(Config(), Press(8.0), kT);
  double x = 0.0, sought = 0.0;
  for (int k = 0; k < 3000; ++k) {
    x +=
        kT * (0.015 - mode.Step(kT * k, 0.0, At(x), 1.0).z);  // a torque error that is faster than the search
    if (k > 0) sought += kT * 0.01;
  }
  EXPECT_LT(x, -sought + 0.01 * 0.1 + 2.5 * NormalAnchor::kMayDrift_m);
}

TEST(ForceMode, MovesNoFasterThanTheArmMayInEitherDirection) {
  ForceMode mode(Config(), Press(8.0), kT);
  NormalMotion held{0.0, -1.0, {0.0, 5e-3, true, false}};
  ForceDemand demand = mode.Step(1.0, 0.0, held, 1.0);
  EXPECT_TRUE(demand.held_now);
  for (int k = 0; k < 500; ++k) demand = mode.Step(1.0, 0.0, held, 1.0);
  EXPECT_TRUE(demand.held);
  EXPECT_FALSE(demand.held_now) << "said once";
  EXPECT_EQ(demand.z, 0.0);
  for (int k = 0; k < 2000; ++k) demand = mode.Step(1.0, 60.0, held, 1.0);
  EXPECT_NEAR(demand.z, -5e-3, 1e-6);
}

}  // namespace
}  // namespace reed::strategy
