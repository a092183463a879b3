// The legs of a scenario as paths of three arms: lines, slides, joints without a jump; refusals by name.
#include <gtest/gtest.h>

#include <cmath>

#include "reed/tests/firmware/reference_bench.h"

namespace reed::reference {
namespace {

ReferenceLeg Leg(ReferenceLeg::Kind kind, double duration_s) {
  ReferenceLeg leg;
  leg.kind = kind;
  leg.duration_s = duration_s;
  return leg;
}

TEST(PathPlanner, ACartesianLegIsAStraightMinimumJerkLineOfTheTip) {
  Bench<5> bench(test::ArmA5());
  ReferenceLeg leg = Leg(ReferenceLeg::Kind::kCartesian, 0.5);
  leg.by_m = Eigen::Vector3d(0.02, -0.01, -0.03);
  const PlannedPath<5> planned = bench.Plan(PoseA5(), {leg});
  const JointPath<5> path = planned.View();
  const Eigen::Vector3d start = bench.At(PoseA5()).tip;
  for (int k = 0; k < 37; ++k) {
    const double t = 0.0137 * k;
    const control::Reference<5> at = path.At(t);
    const Blend blend = MinimumJerk(t, 0.5);
    const model::Kinematics<5> kin = bench.At(at.theta_d);
    EXPECT_LT((kin.tip - start - blend.s * leg.by_m).norm(), 2e-8) << t;
    EXPECT_LT((kin.J.topRows<3>() * at.theta_d_dot - blend.s_dot * leg.by_m).norm(), 2e-5) << t;
  }
  EXPECT_LT((bench.At(path.At(0.5).theta_d).tip - start - leg.by_m).norm(), 1e-11);
}

TEST(PathPlanner, ASlideIsASinusoidOfTheTipAboutTheStartOfItsLeg) {
  Bench<5> bench(test::ArmA5());
  ReferenceLeg hold = Leg(ReferenceLeg::Kind::kHold, 0.2);
  ReferenceLeg leg = Leg(ReferenceLeg::Kind::kSlide, 10.0);
  leg.amplitude_m = Eigen::Vector3d(0.02, 0.02, 0.0);
  leg.frequency_hz = 0.5;
  const PlannedPath<5> planned = bench.Plan(PoseA5(), {hold, leg});
  const JointPath<5> path = planned.View();
  const Eigen::Vector3d start = bench.At(PoseA5()).tip;
  EXPECT_EQ(path.At(0.1).theta_d, PoseA5());
  for (int k = 0; k < 48; ++k) {
    const double t = 1.3 + 0.0137 * k;  // the fade-in of half a period is over
    EXPECT_LT(
        (bench.At(path.At(t).theta_d).tip - start - std::sin(3.14159265358979 * (t - 0.2)) * leg.amplitude_m)
            .norm(),
        1e-8);
  }
}

TEST(PathPlanner, JointLegsFollowEachOtherWithoutAJump) {
  Bench<2> bench(test::ArmP2());
  ReferenceLeg move = Leg(ReferenceLeg::Kind::kJoint, 0.6);
  move.to_rad = {0.8, -0.5};
  ReferenceLeg sine = Leg(ReferenceLeg::Kind::kSine, 5.0);
  sine.amplitude_rad = {0.1, 0.2};
  sine.frequency_hz = 1.0;
  const model::Vec<2> start(0.4, 1.1);
  const PlannedPath<2> planned = bench.Plan(start, {move, Leg(ReferenceLeg::Kind::kHold, 0.2), sine});
  const JointPath<2> path = planned.View();
  EXPECT_LT((path.At(0.3).theta_d - 0.5 * (start + model::Vec<2>(0.8, -0.5))).norm(), 1e-12);
  EXPECT_LT((path.At(0.7).theta_d - model::Vec<2>(0.8, -0.5)).norm(), 1e-12);
  EXPECT_LT((path.At(1.55).theta_d - model::Vec<2>(0.8, -0.5) -
             std::sin(2.0 * 3.14159265358979 * 0.75) * model::Vec<2>(0.1, 0.2))
                .norm(),
            1e-9);
  control::Reference<2> before = path.At(0.0);
  for (int k = 1; k < 20'000; ++k) {
    const double t = 1e-4 * k;
    const control::Reference<2> at = path.At(t);
    EXPECT_LT((at.theta_d_dot - before.theta_d_dot).norm(), 0.02) << t;
    EXPECT_LT((0.5e-4 * (at.theta_d_dot + before.theta_d_dot) - (at.theta_d - before.theta_d)).norm(), 1e-8)
        << t;
    before = at;
  }
}

TEST(PathPlanner, ALegThatStillMovesWhenTheRunEndsDoesSoSmoothlyToTheLastCycle) {
  Bench<5> bench(test::ArmA5());
  ReferenceLeg swing = Leg(ReferenceLeg::Kind::kSine, bench.scenario.duration_s);
  swing.amplitude_rad.assign(5, 0.1);
  swing.frequency_hz = 0.6;
  const PlannedPath<5> planned = bench.Plan(PoseA5(), {swing});
  const JointPath<5> path = planned.View();
  const double w = 2.0 * 3.14159265358979 * swing.frequency_hz;
  for (int k = 0; k <= 50; ++k) {
    const double t = bench.scenario.duration_s - 0.05 + 1e-3 * k;
    const control::Reference<5> at = path.At(t);
    EXPECT_NEAR(at.theta_d_dot[0], 0.1 * w * std::cos(w * t), 1e-7) << t;
    EXPECT_NEAR(at.theta_d_ddot[0], -0.1 * w * w * std::sin(w * t), 1e-5) << t;
  }
}

TEST(PathPlanner, TheKnotsHoldTheRunEvenWhenTheLegsAreShorterThanOneSpacing) {
  Bench<2> bench(test::ArmP2());
  const PlannedPath<2> planned = bench.Plan({0.4, 1.1}, {Leg(ReferenceLeg::Kind::kHold, 1e-3)});
  const JointPath<2> path = planned.View();
  EXPECT_EQ(path.At(0.01).theta_d, model::Vec<2>(0.4, 1.1));
}

TEST(PathPlanner, ALegThatMovesIsRefusedWhereTheKnotsWouldMissIt) {
  Bench<2> bench(test::ArmP2());
  ReferenceLeg move = Leg(ReferenceLeg::Kind::kJoint, 9e-3);
  move.to_rad = {0.41, 1.1};
  for (const char* word : {"reference.legs[0].duration_s", "0.009", "0.05"})
    EXPECT_NE(bench.Refusal({0.4, 1.1}, {move}).find(word), std::string::npos) << word;
  ReferenceLeg sine = Leg(ReferenceLeg::Kind::kSine, 1.0);
  sine.amplitude_rad = {1e-3, 0.0};
  sine.frequency_hz = 21.0;
  EXPECT_NE(bench.Refusal({0.4, 1.1}, {sine}).find("reference.legs[0].frequency_hz"), std::string::npos);
  sine.frequency_hz = 20.0;
  EXPECT_EQ(bench.Refusal({0.4, 1.1}, {sine}), "accepted");
}

TEST(PathPlanner, LegsThatEndBetweenTwoKnotsReachTheirEnds) {
  Bench<2> bench(test::ArmP2());
  ReferenceLeg there = Leg(ReferenceLeg::Kind::kJoint, 0.0533), back = there;
  there.to_rad = {0.42, 1.1};
  back.to_rad = {0.4, 1.08};
  const ReferenceLeg hold = Leg(ReferenceLeg::Kind::kHold, 0.0411);
  const PlannedPath<2> planned = bench.Plan({0.4, 1.1}, {there, hold, back, hold});
  const JointPath<2> path = planned.View();
  EXPECT_LT((path.At(0.075).theta_d - model::Vec<2>(0.42, 1.1)).norm(), 1e-12);
  EXPECT_LT((path.At(0.18).theta_d - model::Vec<2>(0.4, 1.08)).norm(), 1e-12);
}

TEST(PathPlanner, ASineOrASlideThatEndsWithinTheRunEndsAtRest) {
  Bench<5> bench(test::ArmA5());
  ReferenceLeg sine = Leg(ReferenceLeg::Kind::kSine, 0.7);
  sine.amplitude_rad.assign(5, 0.1);
  sine.frequency_hz = 1.0;
  ReferenceLeg slide = Leg(ReferenceLeg::Kind::kSlide, 0.45);
  slide.amplitude_m = Eigen::Vector3d(0.02, 0.02, 0.0);
  slide.frequency_hz = 1.0;
  const PlannedPath<5> planned = bench.Plan(PoseA5(), {sine, slide, Leg(ReferenceLeg::Kind::kHold, 0.2)});
  const JointPath<5> path = planned.View();
  EXPECT_LT((path.At(0.7).theta_d - PoseA5()).norm(), 1e-9);
  control::Reference<5> before = path.At(0.0);
  for (int k = 1; k < 1300; ++k) {
    const control::Reference<5> at = path.At(1e-3 * k);
    EXPECT_LT((at.theta_d_dot - before.theta_d_dot).cwiseAbs().maxCoeff(), 0.03) << k;
    before = at;
  }
}

TEST(PathPlanner, AFourierLegIsItsSeriesAndEndsWhereItStarts) {
  Bench<2> bench(test::ArmP2());
  ReferenceLeg leg = Leg(ReferenceLeg::Kind::kFourier, 1.6);
  leg.frequency_hz = 0.625;
  leg.sine_rad = {{0.2, -0.1}, {-0.1, 0.05}};
  leg.cosine_rad = {{0.08, 0.12}, {-0.02, -0.03}};
  const model::Vec<2> start(0.4, 1.1);
  const PlannedPath<2> planned = bench.Plan(start, {leg, Leg(ReferenceLeg::Kind::kHold, 0.3)});
  const JointPath<2> path = planned.View();
  const double w = 2.0 * 3.14159265358979323846 * leg.frequency_hz;
  for (int k = 1; k < 150; ++k) {
    const double t = 0.0107 * k;
    const control::Reference<2> at = path.At(t);
    for (int i = 0; i < 2; ++i) {
      const std::size_t j = static_cast<std::size_t>(i);
      const double s1 = leg.sine_rad[0][j], s2 = leg.sine_rad[1][j];
      const double c1 = leg.cosine_rad[0][j], c2 = leg.cosine_rad[1][j];
      EXPECT_NEAR(at.theta_d[i] - start[i],
                  s1 * std::sin(w * t) + s2 * std::sin(2 * w * t) + c1 * (std::cos(w * t) - 1.0) +
                      c2 * (std::cos(2 * w * t) - 1.0),
                  1e-8)  // between the path's knots
          << t;
      EXPECT_NEAR(at.theta_d_dot[i],
                  w * (s1 * std::cos(w * t) + 2 * s2 * std::cos(2 * w * t) - c1 * std::sin(w * t) -
                       2 * c2 * std::sin(2 * w * t)),
                  1e-4)
          << t;
    }
  }
  EXPECT_LT((path.At(1.8).theta_d - start).norm(), 1e-12);
  EXPECT_LT(path.At(0.0).theta_d_dot.norm() + path.At(1.8).theta_d_dot.norm(), 1e-12);
}

TEST(PathPlanner, AHarmonicThatTheKnotsWouldMissIsRefused) {
  Bench<2> bench(test::ArmP2());
  ReferenceLeg leg = Leg(ReferenceLeg::Kind::kFourier, 1.0);
  leg.frequency_hz = 8.0;
  leg.sine_rad = {{1e-3, 0.0}, {-5e-4, 0.0}};
  EXPECT_EQ(bench.Refusal({0.4, 1.1}, {leg}), "accepted");
  leg.cosine_rad = {{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}};
  EXPECT_NE(bench.Refusal({0.4, 1.1}, {leg}).find("24.000000 Hz; allowed: up to 20"), std::string::npos);
}

TEST(PathPlanner, ALegThatLeavesTheJointRangeIsRefusedByJointTimeAndRange) {
  Bench<2> bench(test::ArmP2());
  ReferenceLeg move = Leg(ReferenceLeg::Kind::kJoint, 1.0);
  move.to_rad = {0.4, 2.99};  // 3.0 minus the margin 0.05 is less
  const std::string line = bench.Refusal({0.4, 1.1}, {move});
  for (const char* word : {"reference.legs", "joint 2", "beyond its limit", "2.95", " s"})
    EXPECT_NE(line.find(word), std::string::npos) << word << " is missing in: " << line;
}

TEST(PathPlanner, ALegThatIsTooFastIsRefusedByJointTimeAndSpeed) {
  Bench<2> bench(test::ArmP2());
  bench.scenario.arm.speed_limit_radps = {10.0, 1.5};
  ReferenceLeg move = Leg(ReferenceLeg::Kind::kJoint, 1.0);
  move.to_rad = {0.4, 0.2};  // peak 1.875 * 0.9 rad/s
  const std::string line = bench.Refusal({0.4, 1.1}, {move});
  for (const char* word : {"reference.legs", "joint 2", "too fast", "1.5", "rad/s"})
    EXPECT_NE(line.find(word), std::string::npos) << word << " is missing in: " << line;
  bench.scenario.arm.speed_limit_radps = {10.0, 1.7};
  EXPECT_EQ(bench.Refusal({0.4, 1.1}, {move}), "accepted");
}

TEST(PathPlanner, ALegBeyondTheReachIsRefused) {
  Bench<5> bench(test::ArmA5());
  ReferenceLeg leg = Leg(ReferenceLeg::Kind::kCartesian, 1.0);
  leg.by_m = Eigen::Vector3d(3.0, 0.0, 0.0);
  EXPECT_NE(bench.Refusal(PoseA5(), {leg}).find("reach"), std::string::npos);
}

}  // namespace
}  // namespace reed::reference
