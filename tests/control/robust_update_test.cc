// What keeps estimates where they belong: dead-zone, leak, box.
#include "reed/core/law/robust_update.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reed::control {
namespace {

TEST(DeadZone, LetsNothingThroughInsideAndTheRestOutside) {
  const Vec<3> s(0.002, -0.005, 0.1);
  const Vec<3> out = DeadZone<3>(s, 0.003);
  EXPECT_EQ(out[0], 0.0);
  EXPECT_NEAR(out[1], -0.002, 1e-15);
  EXPECT_NEAR(out[2], 0.097, 1e-15);
  EXPECT_EQ(DeadZone<3>(s, 0.0), s);
}

TEST(RobustStep, StopsAtTheBoxAndLeavesItAtOnceWhenTheRateTurns) {
  const Vec<2> lo(0.0, 0.0), hi(1.0, 0.4), start(0.4, 0.05);
  Vec<2> x = start;
  for (int k = 0; k < 10000; ++k) x = RobustStep<2>(x, Vec<2>(5.0, -5.0), start, 0.0, lo, hi, 1e-3);
  EXPECT_EQ(x, Vec<2>(1.0, 0.0));
  x = RobustStep<2>(x, Vec<2>(-5.0, 5.0), start, 0.0, lo, hi, 1e-3);
  EXPECT_NEAR(x[0], 0.995, 1e-12) << "nothing was wound up";
  EXPECT_NEAR(x[1], 0.005, 1e-12);
}

TEST(RobustStep, WithoutExcitationLeaksBackToItsStart) {
  const Vec<1> lo(0.0), hi(1.0), start(0.4);
  Vec<1> x(0.9);
  for (int k = 0; k < 20000; ++k) x = RobustStep<1>(x, Vec<1>(0.0), start, 0.05, lo, hi, 1e-3);
  EXPECT_NEAR(x[0], 0.4 + 0.5 * std::exp(-0.05 * 20.0), 1e-4);
}

TEST(RobustStep, AScalarGainStaysBetweenZeroAndItsBound) {
  double sigma = 0.0;
  for (int k = 0; k < 10000; ++k) sigma = RobustStep(sigma, 2.0, 0.2, 3.0, 1e-3);
  EXPECT_EQ(sigma, 3.0);
  for (int k = 0; k < 5000; ++k) sigma = RobustStep(sigma, 0.0, 0.2, 3.0, 1e-3);
  EXPECT_NEAR(sigma, 3.0 * std::exp(-1.0), 1e-3);
  EXPECT_EQ(RobustStep(0.001, -5.0, 0.2, 3.0, 1e-3), 0.0);
}

}  // namespace
}  // namespace reed::control
