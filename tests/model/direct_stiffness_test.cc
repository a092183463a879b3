// (5), (6) against closed forms: cantilever, L-frame, portal under spread load, springs, joints that pass no
// moment.
#include "reed/firmware/stiffness/direct_stiffness.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "reed/firmware/stiffness/semidefinite_solver.h"

namespace reed::model {
namespace {

using Eigen::Vector3d;
constexpr double kEA = 2.0e6, kEI = 800.0, kGJ = 600.0, kClosed = 1e-9;

Vec6 Load(const Vector3d& F, const Vector3d& n) {
  Vec6 both;
  both << F, n;
  return both;
}
Vec6 Force(const Vector3d& F) { return Load(F, Vector3d::Zero()); }

TEST(DirectStiffness, CantileverInThreeMembersEndsAsInOne) {
  DirectStiffness frame;
  int node = frame.AddSupport(Vector3d::Zero());
  for (int k = 1; k <= 3; ++k) {
    const int next = frame.AddFree(Vector3d(0.4 * k, 0.0, 0.0));
    frame.AddMember(node, next, kEA, kEI, kGJ, Vector3d::Zero());
    node = next;
  }
  frame.AddLoad(node, Load(Vector3d(5.0, 0.0, -3.0), Vector3d(2.0, 0.0, 0.7)));
  const auto solution = frame.Solve();
  ASSERT_TRUE(solution.determinate());
  const Vec6 end = frame.Displacement(node, solution);
  const double L = 1.2;
  EXPECT_NEAR(end(0), 5.0 * L / kEA, kClosed * std::abs(end(0)));
  EXPECT_NEAR(end(1), 0.7 * L * L / (2.0 * kEI), kClosed * std::abs(end(1)));
  EXPECT_NEAR(end(2), -3.0 * L * L * L / (3.0 * kEI), kClosed * std::abs(end(2)));
  EXPECT_NEAR(end(3), 2.0 * L / kGJ, kClosed * std::abs(end(3)));
  EXPECT_NEAR(end(4), 3.0 * L * L / (2.0 * kEI), kClosed * std::abs(end(4)));
  EXPECT_NEAR(end(5), 0.7 * L / kEI, kClosed * std::abs(end(5)));
}

TEST(DirectStiffness, LFrameBendsAndTwists) {
  // Out of its plane: δ = F a³/3EI + F b³/3EI + F b² a/GJ for legs a (clamped, along x) and b (along y).
  constexpr double a = 0.5, b = 0.3, F = 10.0;
  DirectStiffness frame;
  const int base = frame.AddSupport(Vector3d::Zero());
  const int corner = frame.AddFree(Vector3d(a, 0.0, 0.0)), end = frame.AddFree(Vector3d(a, b, 0.0));
  frame.AddMember(base, corner, kEA, kEI, kGJ, Vector3d::Zero());
  frame.AddMember(corner, end, kEA, kEI, kGJ, Vector3d::Zero());
  frame.AddLoad(end, Force(Vector3d(0.0, 0.0, F)));
  const Vec6 tip = frame.Displacement(end, frame.Solve());
  const double expected = F * (a * a * a + b * b * b) / (3.0 * kEI) + F * b * b * a / kGJ;
  EXPECT_NEAR(tip(2), expected, kClosed * expected);
}

TEST(DirectStiffness, LFrameInItsPlane) {
  // Force along x at the end of the second leg: axial in the first, bending of both: δ = F b³/3EI + F b² a/EI
  // + F a/EA.
  constexpr double a = 0.5, b = 0.3, F = 10.0;
  DirectStiffness frame;
  const int base = frame.AddSupport(Vector3d::Zero());
  const int corner = frame.AddFree(Vector3d(a, 0.0, 0.0)), end = frame.AddFree(Vector3d(a, b, 0.0));
  frame.AddMember(base, corner, kEA, kEI, kGJ, Vector3d::Zero());
  frame.AddMember(corner, end, kEA, kEI, kGJ, Vector3d::Zero());
  frame.AddLoad(end, Force(Vector3d(F, 0.0, 0.0)));
  const double expected = F * b * b * b / (3.0 * kEI) + F * b * b * a / kEI + F * a / kEA;
  EXPECT_NEAR(frame.Displacement(end, frame.Solve())(0), expected, kClosed * expected);
}

TEST(DirectStiffness, SelfWeightSagsByEighthAndSixth) {
  constexpr double L = 0.9, q = 12.0;
  DirectStiffness frame;
  const int base = frame.AddSupport(Vector3d::Zero()), end = frame.AddFree(Vector3d(0.0, L, 0.0));
  frame.AddMember(base, end, kEA, kEI, kGJ, Vector3d(0.0, 0.0, -q * L));
  const Vec6 tip = frame.Displacement(end, frame.Solve());
  EXPECT_NEAR(tip(2), -q * L * L * L * L / (8.0 * kEI), kClosed * std::abs(tip(2)));
  EXPECT_NEAR(tip(3), -q * L * L * L / (6.0 * kEI), kClosed * std::abs(tip(3)));
}

TEST(DirectStiffness, ElasticJointYieldsWhatItsTorqueAsks) {  // (6)
  constexpr double L = 0.4, k_q = 300.0, F = 2.0;
  DirectStiffness frame;
  const int base = frame.AddSupport(Vector3d::Zero());
  const int joint = frame.AddJoint(base, Vector3d::Zero(), Vector3d::UnitZ(), k_q);
  const int end = frame.AddFree(Vector3d(L, 0.0, 0.0));
  frame.AddMember(joint, end, kEA, kEI, kGJ, Vector3d::Zero());
  frame.AddLoad(end, Force(Vector3d(0.0, F, F)));
  const auto solution = frame.Solve();
  const double xi = F * L / k_q, bending = F * L * L * L / (3.0 * kEI);
  EXPECT_NEAR(frame.JointRotation(joint, solution), xi, kClosed * xi);
  EXPECT_NEAR(frame.Displacement(end, solution)(1), xi * L + bending, kClosed);
  EXPECT_NEAR(frame.Displacement(end, solution)(2), bending, kClosed);
}

TEST(DirectStiffness, RigidNodesMoveLikeOneBody) {  // (6)
  DirectStiffness frame;
  const int base = frame.AddSupport(Vector3d::Zero()), end = frame.AddFree(Vector3d(0.5, 0.0, 0.0));
  frame.AddMember(base, end, kEA, kEI, kGJ, Vector3d::Zero());
  const Vector3d arm(0.1, 0.2, -0.3), F(1.0, 2.0, 3.0);
  const int tool = frame.AddRigid(end, Vector3d(0.5, 0.0, 0.0) + arm);
  frame.AddLoad(tool, Force(F));
  const Vec6 loaded_at_tool = frame.Displacement(end, frame.Solve());
  DirectStiffness direct;
  const int base2 = direct.AddSupport(Vector3d::Zero()), end2 = direct.AddFree(Vector3d(0.5, 0.0, 0.0));
  direct.AddMember(base2, end2, kEA, kEI, kGJ, Vector3d::Zero());
  direct.AddLoad(end2, Load(F, arm.cross(F)));
  EXPECT_NEAR((loaded_at_tool - direct.Displacement(end2, direct.Solve())).norm(), 0.0, 1e-12);
  const Vec6 tool_moves = frame.Displacement(tool, frame.Solve());
  EXPECT_NEAR((tool_moves.head<3>() - loaded_at_tool.head<3>() - loaded_at_tool.tail<3>().cross(arm)).norm(),
              0.0, 1e-15);
}

TEST(DirectStiffness, StaticallyIndeterminateBeamOnTwoClamps) {
  constexpr double L = 1.0, F = 50.0;  // load in the middle: F L³/192EI
  DirectStiffness frame;
  const int left = frame.AddSupport(Vector3d::Zero()), right = frame.AddSupport(Vector3d(L, 0.0, 0.0));
  const int middle = frame.AddFree(Vector3d(L / 2.0, 0.0, 0.0));
  frame.AddMember(left, middle, kEA, kEI, kGJ, Vector3d::Zero());
  frame.AddMember(middle, right, kEA, kEI, kGJ, Vector3d::Zero());
  frame.AddLoad(middle, Force(Vector3d(0.0, 0.0, F)));
  const double expected = F * L * L * L / (192.0 * kEI);
  EXPECT_NEAR(frame.Displacement(middle, frame.Solve())(2), expected, kClosed * expected);
}

class JointWithoutMoment : public ::testing::Test {
 protected:
  JointWithoutMoment() {
    const int base = frame_.AddSupport(Vector3d::Zero());
    const int elbow = frame_.AddFree(Vector3d(0.4, 0.0, 0.0));
    const int hinge = frame_.AddJoint(elbow, Vector3d(0.4, 0.0, 0.0), Vector3d::UnitZ(), 0.0);
    end_ = frame_.AddFree(Vector3d(0.7, 0.0, 0.0));
    frame_.AddMember(base, elbow, kEA, kEI, kGJ, Vector3d::Zero());
    frame_.AddMember(hinge, end_, kEA, kEI, kGJ, Vector3d::Zero());
  }
  DirectStiffness frame_;
  int end_ = 0;
};

TEST_F(JointWithoutMoment, IsReportedAsARankAndNotAsAnError) {
  const auto solution = frame_.Solve();
  EXPECT_EQ(solution.rank, solution.coordinates - 1);
  EXPECT_EQ(frame_.CartesianStiffness(end_).rank, 5);
}

TEST_F(JointWithoutMoment, TheCartesianStiffnessIsBlindToSwingingAboutTheHinge) {
  Vec6 swing;
  swing << 0.0, 0.3, 0.0, 0.0, 0.0, 1.0;
  const Mat6 K = frame_.CartesianStiffness(end_).K;
  EXPECT_NEAR((K * swing).norm(), 0.0, 1e-9 * K.norm());
}

TEST_F(JointWithoutMoment, LoadsThatTheHingeCarriesAreAnsweredAsWithoutIt) {
  constexpr double F = 4.0, L = 0.7;
  frame_.AddLoad(end_, Force(Vector3d(F, 0.0, F)));
  const Vec6 tip = frame_.Displacement(end_, frame_.Solve());
  EXPECT_NEAR(tip(0), F * L / kEA, kClosed);
  EXPECT_NEAR(tip(2), F * L * L * L / (3.0 * kEI), kClosed);
  EXPECT_NEAR(tip(1), 0.0, kClosed);
}

TEST_F(JointWithoutMoment, LoadsThatItCannotCarryGiveAFiniteAnswer) {
  frame_.AddLoad(end_, Force(Vector3d(0.0, 1.0, 0.0)));
  EXPECT_TRUE(frame_.Displacement(end_, frame_.Solve()).allFinite());
}

TEST(DirectStiffness, CartesianStiffnessInvertsTheCompliance) {
  DirectStiffness frame;
  const int base = frame.AddSupport(Vector3d::Zero());
  const int joint = frame.AddJoint(base, Vector3d::Zero(), Vector3d::UnitY(), 500.0);
  const int corner = frame.AddFree(Vector3d(0.3, 0.1, 0.0)), end = frame.AddFree(Vector3d(0.5, 0.4, 0.2));
  frame.AddMember(joint, corner, kEA, kEI, kGJ, Vector3d::Zero());
  frame.AddMember(corner, end, kEA, kEI, kGJ, Vector3d::Zero());
  const auto stiffness = frame.CartesianStiffness(end);
  EXPECT_EQ(stiffness.rank, 6);
  for (int k = 0; k < 6; ++k) {
    DirectStiffness loaded = frame;
    loaded.AddLoad(end, Vec6::Unit(k));
    const Vec6 deflection = loaded.Displacement(end, loaded.Solve());
    EXPECT_NEAR((stiffness.K * deflection - Vec6::Unit(k)).norm(), 0.0, 1e-9);  // (4)
  }
}

TEST(DirectStiffness, RefusesAMemberWithoutLengthAndAMasterThatIsNotThere) {
  DirectStiffness frame;
  const int base = frame.AddSupport(Vector3d::Zero()), same = frame.AddFree(Vector3d::Zero());
  EXPECT_THROW(frame.AddMember(base, same, kEA, kEI, kGJ, Vector3d::Zero()), std::invalid_argument);
  EXPECT_THROW(frame.AddRigid(7, Vector3d::Zero()), std::invalid_argument);
}

TEST(SemidefiniteSolver, RowsOfRoundingDoNotCountAsRank) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3, 3);
  A.diagonal() << 2.0, 1e-34, 3e-9;
  EXPECT_EQ(SemidefiniteSolver(A).rank(), 2);
}

}  // namespace
}  // namespace reed::model
