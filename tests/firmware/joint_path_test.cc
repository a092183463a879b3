// What the arm shall do over time: blends and paths against closed forms and finite differences.
#include "reed/core/reference/joint_path.h"

#include <gtest/gtest.h>

#include <random>

#include "reed/core/reference/force_profile.h"

namespace reed::reference {
namespace {

TEST(MinimumJerk, IsTheQuinticThatStartsAndEndsAtRest) {
  constexpr double kT = 0.8;
  EXPECT_DOUBLE_EQ(MinimumJerk(0.5 * kT, kT).s, 0.5);
  EXPECT_DOUBLE_EQ(MinimumJerk(0.5 * kT, kT).s_dot, 1.875 / kT);  // the largest speed
  EXPECT_NEAR(MinimumJerk(0.5 * kT, kT).s_ddot, 0.0, 1e-14);
  EXPECT_NEAR(MinimumJerk((0.5 - std::sqrt(3.0) / 6.0) * kT, kT).s_ddot, 10.0 / std::sqrt(3.0) / (kT * kT),
              1e-12);
  for (const double t : {-1.0, 0.0, kT, 2.0 * kT}) {
    const Blend at = MinimumJerk(t, kT);
    EXPECT_EQ(at.s, t > 0.5 * kT ? 1.0 : 0.0);
    EXPECT_EQ(at.s_dot, 0.0);
    EXPECT_EQ(at.s_ddot, 0.0);
  }
}

TEST(MinimumJerk, RatesAreTheDerivatives) {
  constexpr double kT = 0.7, kH = 1e-5;
  for (double t = 0.05; t < kT - 0.05; t += 0.0371) {
    const Blend before = MinimumJerk(t - kH, kT), at = MinimumJerk(t, kT), after = MinimumJerk(t + kH, kT);
    EXPECT_NEAR((after.s - before.s) / (2.0 * kH), at.s_dot, 1e-8);
    EXPECT_NEAR((after.s_dot - before.s_dot) / (2.0 * kH), at.s_ddot, 1e-7);
  }
}

using Path = JointPath<2>;
using Vec2 = Vec<2>;

/// Any quintic and its derivatives.
struct Quintic {
  double c[6] = {0.3, -1.2, 0.7, 2.1, -1.6, 0.45};
  double q(double t) const { return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5])))); }
  double qd(double t) const { return c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5]))); }
  double qdd(double t) const { return 2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5])); }
};

TEST(JointPath, BetweenKnotsOfAQuinticItIsThatQuintic) {
  const Quintic f;
  constexpr double kH = 0.25;
  std::vector<Path::Knot> knots;
  for (int k = 0; k <= 4; ++k) {
    const double t = kH * k;
    knots.push_back(
        {Vec2(f.q(t), -2.0 * f.q(t)), Vec2(f.qd(t), -2.0 * f.qd(t)), Vec2(f.qdd(t), -2.0 * f.qdd(t))});
  }
  const Path path(knots, kH);
  for (double t = 0.01; t < 1.0; t += 0.0173) {
    const control::Reference<2> at = path.At(t);
    EXPECT_NEAR(at.theta_d[0], f.q(t), 1e-13);
    EXPECT_NEAR(at.theta_d_dot[1], -2.0 * f.qd(t), 1e-11);
    EXPECT_NEAR(at.theta_d_ddot[0], f.qdd(t), 1e-10);
  }
}

TEST(JointPath, ValueSpeedAndAccelerationAreContinuousAtEveryKnot) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  constexpr double kH = 0.01, kTiny = 1e-9;
  std::vector<Path::Knot> knots;
  const auto draw = [&] { return Vec2(any(random), any(random)); };
  for (int k = 0; k <= 20; ++k) knots.push_back({draw(), draw(), draw()});
  const Path path(knots, kH);
  for (std::size_t k = 1; k < 20; ++k) {
    const double t = kH * static_cast<double>(k);
    for (const double side : {-kTiny, kTiny}) {
      const control::Reference<2> at = path.At(t + side);
      EXPECT_LT((at.theta_d - knots[k].q).norm(), 1e-6);
      EXPECT_LT((at.theta_d_dot - knots[k].q_dot).norm(), 1e-3);
      EXPECT_LT((at.theta_d_ddot - knots[k].q_ddot).norm(), 0.5);  // jerk 1e8 rad/s³ over 1 ns
    }
  }
}

TEST(JointPath, RestsBeforeItsStartAndAfterItsEnd) {
  const std::vector<Path::Knot> knots{{Vec2(1, 2), Vec2(3, 4), Vec2(5, 6)},
                                      {Vec2(7, 8), Vec2(9, 1), Vec2(2, 3)}};
  const Path path(knots, 0.1);
  EXPECT_DOUBLE_EQ(path.duration_s(), 0.1);
  EXPECT_EQ(path.At(-1.0).theta_d, Vec2(1, 2));
  EXPECT_EQ(path.At(0.0).theta_d, Vec2(1, 2));
  EXPECT_EQ(path.At(0.2).theta_d, Vec2(7, 8));
  for (const double t : {-1.0, 0.0, 0.2}) {
    EXPECT_EQ(path.At(t).theta_d_dot, Vec2::Zero());
    EXPECT_EQ(path.At(t).theta_d_ddot, Vec2::Zero());
  }
}

TEST(ForceProfile, RampsUpFromTheLaterOfStartAndContactAndDownAtItsEnd) {
  const ForceProfile profile{8.0, 0.3, 0.5, 2.0};
  EXPECT_EQ(profile.At(0.3, 0.1), 0.0);
  EXPECT_NEAR(profile.At(0.55, 0.1), 4.0, 1e-12);
  EXPECT_NEAR(profile.At(0.55, 0.5), 8.0 * MinimumJerk(0.05, 0.5).s, 1e-12) << "contact came later";
  EXPECT_NEAR(profile.At(1.5, 0.5), 8.0, 1e-12);
  EXPECT_NEAR(profile.At(2.25, 0.5), 4.0, 1e-12);
  EXPECT_EQ(profile.At(2.5, 0.5), 0.0);
  EXPECT_FALSE(profile.Wanted(0.29));
  EXPECT_TRUE(profile.Wanted(2.49));
  EXPECT_FALSE(profile.Wanted(2.5));
}

}  // namespace
}  // namespace reed::reference
