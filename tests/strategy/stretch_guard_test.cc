// Near a stretched arm the tip slows down in time, is held, and may go back.
#include "reed/core/contact/stretch_guard.h"

#include <gtest/gtest.h>

namespace reed::strategy {
namespace {

using Vec2 = control::Vec<2>;
using Guard = StretchGuard<2>;
constexpr double kReach = 0.9;

Guard MakeGuard() { return Guard(Vec2(4.0, 2.0), kReach); }
/// D with κ as asked.
Vec2 WithKappa(double kappa) { return kappa / kReach * Vec2(0.6, -0.8); }

TEST(StretchGuard, AsksNoJointForMoreThanAShareOfItsSpeed) {
  for (const double kappa : {1.0, 5.0, 19.0}) {
    Guard guard = MakeGuard();
    const NormalSpeedRange range = guard.Step(WithKappa(kappa), 0.0);
    EXPECT_NEAR(range.into * WithKappa(kappa).cwiseAbs()[1], 0.25 * 2.0, 1e-12);
    EXPECT_EQ(range.into, range.off);
    EXPECT_FALSE(range.held || range.lost);
  }
}

TEST(StretchGuard, SlowsDownInTheDirectionInWhichTheArmStretchesAndLeavesTheWayBack) {
  for (const double z : {0.01, -0.01}) {
    Guard guard = MakeGuard();
    double last = 1.0;
    for (double kappa = 10.0; kappa < 49.0; kappa += 1.0) {
      const NormalSpeedRange range = guard.Step(WithKappa(kappa), z);
      const double on = z > 0.0 ? range.into : range.off, back = z > 0.0 ? range.off : range.into;
      EXPECT_LT(on, last);
      EXPECT_GT(back, 0.005);
      last = on;
    }
    const NormalSpeedRange held = guard.Step(WithKappa(60.0), -z);
    EXPECT_EQ(z > 0.0 ? held.into : held.off, 0.0);
    EXPECT_TRUE(held.held);
    EXPECT_FALSE(held.lost);
    const NormalSpeedRange free = guard.Step(WithKappa(10.0), -z);
    EXPECT_EQ(free.into, free.off);
  }
}

TEST(StretchGuard, WithoutAWayAlongTheNormalThePressIsLost) {
  EXPECT_TRUE(MakeGuard().Step(WithKappa(101.0), 0.0).lost);
  EXPECT_TRUE(MakeGuard().Step(Vec2::Zero(), 0.0).lost);
}

}  // namespace
}  // namespace reed::strategy
