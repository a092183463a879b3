// (51), (52): the stiffness of a spring that is pressed and slid along, and what stays out of the estimate.
#include "reed/core/contact/wall_stiffness.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reed::strategy {
namespace {

constexpr double kT = 1e-3;

/// Presses a spring to 8 N within half a second, then wavers by 0.3 mm.
double EstimateOf(double k_e, double noise_N) {
  WallStiffness wall(10e3, kT);
  double estimate = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double t = kT * k;
    const double depth = 8.0 / k_e * std::min(1.0, t / 0.5) + 0.3e-3 * std::sin(6.0 * t);
    const double noise = noise_N * std::sin(1234.5 * k);
    estimate = wall.Step(k_e * depth + noise + 2.0, 0.156 - depth);
  }
  return estimate;
}

TEST(WallStiffness, FindsSoftAndStiffSpringsFromTheSameStart) {
  for (const double k_e : {1e3, 5e3, 10e3, 20e3}) EXPECT_NEAR(EstimateOf(k_e, 0.0), k_e, 0.01 * k_e) << k_e;
  EXPECT_NEAR(EstimateOf(5e3, 0.05), 5e3, 500.0) << "with the sensor's noise";
}

TEST(WallStiffness, AnArmThatStandsStillTeachesNothing) {
  WallStiffness wall(10e3, kT);
  for (int k = 0; k < 5000; ++k)
    wall.Step(8.0 + 0.1 * std::sin(777.0 * k), 0.156 + 2e-6 * std::sin(333.0 * k));
  EXPECT_EQ(wall.value(), 10e3);
}

TEST(WallStiffness, MotionWithoutContactTeachesNothing) {
  WallStiffness wall(10e3, kT);
  for (int k = 0; k < 2000; ++k) wall.Step(0.0, 0.156 + 0.01 * std::sin(0.01 * k));
  EXPECT_EQ(wall.value(), 10e3) << "else every bounce would read as a softer wall, and raise the gain";
}

TEST(WallStiffness, AnArmThatSwingsAgainstItsForceDoesNotReadAsASoftWall) {
  // Above the contact's resonance the force rises while the motors back out: 3 N at 0.3 mm is 10 kN/m,
  // whichever way the phase lies.
  for (const double phase : {0.0, 1.5, 3.1416}) {
    WallStiffness wall(5e3, kT);
    for (int k = 0; k < 2000; ++k)
      wall.Step(4.0 + 3.0 * std::sin(0.15 * k), 0.156 + 0.3e-3 * std::sin(0.15 * k + phase));
    EXPECT_NEAR(wall.value(), 10e3, 1500.0) << phase;
  }
}

}  // namespace
}  // namespace reed::strategy
