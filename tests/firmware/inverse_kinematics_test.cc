// Inverse kinematics against the forward kinematics of three arms, refusals by name.
#include <gtest/gtest.h>

#include <random>

#include "reed/tests/firmware/reference_bench.h"

namespace reed::reference {
namespace {

template <int N>
double TurnedBy(const model::Kinematics<N>& a, const model::Kinematics<N>& b) {
  return RotationError(a.R_last(), b.R_last()).norm();
}

TEST(InverseKinematics, SevenJointsReachTipAndOrientation) {
  const Bench<7> bench(test::ArmA7());
  const model::Kinematics<7> start = bench.At(PoseA7());
  for (const Eigen::Vector3d& by :
       {Eigen::Vector3d(0.05, 0, 0), Eigen::Vector3d(0, -0.08, 0.02), Eigen::Vector3d(-0.03, 0.04, -0.1)}) {
    const auto q = SolveInverseKinematics<7>(bench.pose_of(), start.tip + by, start.R_last(), PoseA7());
    EXPECT_LT((bench.At(q).tip - start.tip - by).norm(), 1e-12);
    EXPECT_LT(TurnedBy<7>(start, bench.At(q)), 1e-5);
  }
}

TEST(InverseKinematics, FiveJointsReachTheTipAndKeepTheHandPointingWhereItPointed) {
  const Bench<5> bench(test::ArmA5());
  const model::Kinematics<5> start = bench.At(PoseA5());
  for (const Eigen::Vector3d& by :
       {Eigen::Vector3d(0.03, 0, 0), Eigen::Vector3d(0, 0.03, 0.01), Eigen::Vector3d(0, 0, -0.03)}) {
    const auto q = SolveInverseKinematics<5>(bench.pose_of(), start.tip + by, start.R_last(), PoseA5());
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
  const auto q = SolveInverseKinematics<2>(bench.pose_of(), goal, bench.At(q_0).R_last(), q_0);
  EXPECT_LT((bench.At(q).tip - goal).norm(), 1e-12);
}

TEST(InverseKinematics, AStretchedArmIsBentToReachAPointNearerToItsBase) {
  const Bench<2> bench(test::ArmP2());
  const model::Kinematics<2> start = bench.At(model::Vec<2>::Zero());
  for (const double nearer : {1e-9, 1e-6, 0.001, 0.1}) {
    const Eigen::Vector3d goal = start.tip - nearer * start.tip.normalized();
    const auto q = SolveInverseKinematics<2>(bench.pose_of(), goal, start.R_last(), model::Vec<2>::Zero());
    EXPECT_LT((bench.At(q).tip - goal).norm(), 1e-9) << nearer;
  }
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

}  // namespace
}  // namespace reed::reference
