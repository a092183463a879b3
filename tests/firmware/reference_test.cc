// What the arm shall do: blends and paths against closed forms and finite differences, inverse kinematics
// against the forward kinematics of three arms, refusals by name.
#include <gtest/gtest.h>

#include <random>

#include "firmware/reference/force_profile.h"
#include "firmware/reference/path_planner.h"
#include "tests/support/arms.h"

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
  const Path path({{Vec2(1, 2), Vec2(3, 4), Vec2(5, 6)}, {Vec2(7, 8), Vec2(9, 1), Vec2(2, 3)}}, 0.1);
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
  ForceConfig config;
  config.desired_N = 8.0;
  config.start_s = 0.3;
  config.ramp_s = 0.5;
  config.end_s = 2.0;
  const ForceProfile profile(config);
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

/// Forward kinematics of one arm, and a scenario with wide limits.
template <int N>
struct Bench {
  explicit Bench(const ArmDescription& arm) : model(arm) {
    scenario.arm = arm;
    scenario.arm.position_min_rad.assign(N, -3.0);
    scenario.arm.position_max_rad.assign(N, 3.0);
    scenario.arm.speed_limit_radps.assign(N, 10.0);
    scenario.duration_s = 2.0;
  }
  model::Kinematics<N> At(const model::Vec<N>& q) const {
    model::Kinematics<N> kin;
    model::ForwardKinematics<N, 12>(model, q, model::Vec<N>::Zero(), kin);
    return kin;
  }
  PoseOf<N> pose_of() const {
    return [this](const model::Vec<N>& q) { return At(q); };
  }
  JointPath<N> Plan(const model::Vec<N>& start, const std::vector<ReferenceLeg>& legs) {
    scenario.reference.start_rad.assign(start.data(), start.data() + N);
    scenario.reference.legs = legs;
    return PathPlanner<N>(pose_of(), scenario).Plan();
  }
  /// The line of a refusal.
  std::string Refusal(const model::Vec<N>& start, const std::vector<ReferenceLeg>& legs) {
    try {
      Plan(start, legs);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  }

  model::ArmModel<N, 12> model;
  Scenario scenario;
};

model::Vec<5> PoseA5() { return (model::Vec<5>() << 0.2, 1.0, -1.7, -2.4, 0.3).finished(); }
model::Vec<7> PoseA7() { return (model::Vec<7>() << 0.2, 0.6, -0.3, -1.4, 0.25, 0.9, -0.4).finished(); }

template <int N>
double TurnedBy(const model::Kinematics<N>& a, const model::Kinematics<N>& b) {
  return RotationError(a.R_tip(), b.R_tip()).norm();
}

TEST(InverseKinematics, SevenJointsReachTipAndOrientation) {
  const Bench<7> bench(test::ArmA7());
  const model::Kinematics<7> start = bench.At(PoseA7());
  for (const Eigen::Vector3d& by :
       {Eigen::Vector3d(0.05, 0, 0), Eigen::Vector3d(0, -0.08, 0.02), Eigen::Vector3d(-0.03, 0.04, -0.1)}) {
    const auto q = SolveInverseKinematics<7>(bench.pose_of(), start.tip + by, start.R_tip(), PoseA7());
    EXPECT_LT((bench.At(q).tip - start.tip - by).norm(), 1e-12);
    EXPECT_LT(TurnedBy<7>(start, bench.At(q)), 1e-5);
  }
}

TEST(InverseKinematics, FiveJointsReachTheTipAndKeepTheHandPointingWhereItPointed) {
  const Bench<5> bench(test::ArmA5());
  const model::Kinematics<5> start = bench.At(PoseA5());
  for (const Eigen::Vector3d& by :
       {Eigen::Vector3d(0.03, 0, 0), Eigen::Vector3d(0, 0.03, 0.01), Eigen::Vector3d(0, 0, -0.03)}) {
    const auto q = SolveInverseKinematics<5>(bench.pose_of(), start.tip + by, start.R_tip(), PoseA5());
    EXPECT_LT((bench.At(q).tip - start.tip - by).norm(), 1e-12);
    // Two axes stay in the plane through the base axis: the hand's own turn about that axis is not free. What
    // remains is at most the turn of that plane.
    const double plane =
        std::atan2(start.tip.y() + by.y(), start.tip.x() + by.x()) - std::atan2(start.tip.y(), start.tip.x());
    EXPECT_LE(TurnedBy<5>(start, bench.At(q)), std::abs(plane) + 1e-5);
  }
}

TEST(InverseKinematics, TwoJointsInAPlaneReachTheTip) {
  const Bench<2> bench(test::ArmP2());
  const model::Vec<2> q_0(0.4, 1.1);
  const Eigen::Vector3d goal = bench.At(q_0).tip + Eigen::Vector3d(0.1, 0.0, -0.15);
  const auto q = SolveInverseKinematics<2>(bench.pose_of(), goal, bench.At(q_0).R_tip(), q_0);
  EXPECT_LT((bench.At(q).tip - goal).norm(), 1e-12);
}

TEST(InverseKinematics, APointBeyondTheReachIsRefusedWithThePoint) {
  const Bench<2> bench(test::ArmP2());
  try {
    SolveInverseKinematics<2>(bench.pose_of(), Eigen::Vector3d(1.5, 0, 0), Eigen::Matrix3d::Identity(),
                              {0.4, 1.1});
    FAIL() << "1.5 m with 0.9 m of arm";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("reach"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("1.5"), std::string::npos);
  }
}

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
  const JointPath<5> path = bench.Plan(PoseA5(), {leg});
  const Eigen::Vector3d start = bench.At(PoseA5()).tip;
  for (double t = 0.0; t < 0.5; t += 0.0137) {
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
  const JointPath<5> path = bench.Plan(PoseA5(), {hold, leg});
  const Eigen::Vector3d start = bench.At(PoseA5()).tip;
  EXPECT_EQ(path.At(0.1).theta_d, PoseA5());
  for (double t = 1.3; t < 1.95; t += 0.0137)  // the fade-in of half a period is over
    EXPECT_LT(
        (bench.At(path.At(t).theta_d).tip - start - std::sin(3.14159265358979 * (t - 0.2)) * leg.amplitude_m)
            .norm(),
        1e-8);
}

TEST(PathPlanner, JointLegsFollowEachOtherWithoutAJump) {
  Bench<2> bench(test::ArmP2());
  ReferenceLeg move = Leg(ReferenceLeg::Kind::kJoint, 0.6);
  move.to_rad = {0.8, -0.5};
  ReferenceLeg sine = Leg(ReferenceLeg::Kind::kSine, 5.0);
  sine.amplitude_rad = {0.1, 0.2};
  sine.frequency_hz = 1.0;
  const model::Vec<2> start(0.4, 1.1);
  const JointPath<2> path = bench.Plan(start, {move, Leg(ReferenceLeg::Kind::kHold, 0.2), sine});
  EXPECT_LT((path.At(0.3).theta_d - 0.5 * (start + model::Vec<2>(0.8, -0.5))).norm(), 1e-12);
  EXPECT_LT((path.At(0.7).theta_d - model::Vec<2>(0.8, -0.5)).norm(), 1e-12);
  EXPECT_LT((path.At(1.55).theta_d - model::Vec<2>(0.8, -0.5) -
             std::sin(2.0 * 3.14159265358979 * 0.75) * model::Vec<2>(0.1, 0.2))
                .norm(),
            1e-9);
  control::Reference<2> before = path.At(0.0);
  for (double t = 1e-4; t < 2.0; t += 1e-4) {
    const control::Reference<2> at = path.At(t);
    EXPECT_LT((at.theta_d_dot - before.theta_d_dot).norm(), 0.02) << t;
    EXPECT_LT((0.5e-4 * (at.theta_d_dot + before.theta_d_dot) - (at.theta_d - before.theta_d)).norm(), 1e-8)
        << t;
    before = at;
  }
}

TEST(PathPlanner, TheKnotsHoldTheRunEvenWhenTheLegsAreShorterThanOneSpacing) {
  Bench<2> bench(test::ArmP2());
  const JointPath<2> path = bench.Plan({0.4, 1.1}, {Leg(ReferenceLeg::Kind::kHold, 1e-3)});
  EXPECT_EQ(path.At(0.01).theta_d, model::Vec<2>(0.4, 1.1));
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
