// (22): the bent arm with its motors at θ_d against the plan of the rigid one.
#include <gtest/gtest.h>

#include "reed/core/model/static_deflection.h"
#include "reed/firmware/setup/arm_model.h"
#include "reed/tests/model/states.h"

namespace reed::model {
namespace {

/// Where the tool point of the bent arm comes to rest with its motors at theta: the joints lag by their
/// springs, the links bend, both at the angles that the joints really have.
Eigen::Vector3d BentTip(const test::ModelArm<5, 6>& arm, const Bodies<5>& bodies, const Wrench& tip,
                        const Vec<5>& theta) {
  Vec<5> q = theta;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  for (int k = 0; k < 30; ++k) {
    Kinematics<5> kin;
    ForwardKinematics<5>(arm, q, Vec<5>::Zero(), kin);
    StructuralLoads<5> loads;
    loads.tip = tip;
    AddBodyWeight(arm, kin, bodies, loads);
    const SerialDeflections<5> bent = DeflectSerially(arm, kin, loads);
    for (int i = 0; i < 5; ++i) {
      q(i) = theta(i) + SpringAngle(bent.torque(i), arm.joint_stiffness(i), arm.joint_hardening(i));
    }
    at = kin.tip + bent.tip_links.u;
  }
  return at;
}

struct TipErrors {
  double without, with;
};

TipErrors Compare(const test::ModelArm<5, 6>& arm, const Vec<5>& q, const Wrench& tip) {
  Kinematics<5> plan;
  ForwardKinematics<5>(arm, q, Vec<5>::Zero(), plan);
  const Bodies<5> bodies = BodiesFor(arm, arm.p_true);
  const Vec<5> theta_d = q + CompensateDeflection(arm, plan, bodies, tip).offset;
  return {(BentTip(arm, bodies, tip, q) - plan.tip).norm(),
          (BentTip(arm, bodies, tip, theta_d) - plan.tip).norm()};
}

/// Elbow bent and hand off the axis of the base: the arm can move its tip everywhere.
Vec<5> MidPose(test::Draw& draw) {
  return Vec<5>(draw.Number(3.0), 0.9 + draw.Number(0.3), -1.5 + draw.Number(0.4), draw.Number(0.5),
                draw.Number(3.0));
}

TEST(StaticDeflection, TheBentTipGoesWhereThePlannedTipIs) {
  const test::ModelArm<5, 6> arm(test::ArmA5());
  test::Draw draw(31);
  for (int n = 0; n < 200; ++n) {
    const TipErrors error = Compare(arm, MidPose(draw), Wrench{});
    EXPECT_GT(error.without, 1e-4);
    EXPECT_LT(error.with, 0.01 * error.without);
  }
}

TEST(StaticDeflection, CountsTheForceOfAContact) {
  const test::ModelArm<5, 6> arm(test::ArmA5());
  test::Draw draw(32);
  for (int n = 0; n < 200; ++n) {
    const TipErrors error = Compare(arm, MidPose(draw), {draw.Vector<3>(15.0), Eigen::Vector3d::Zero()});
    EXPECT_LT(error.with, 0.03 * error.without);
  }
}

TEST(StaticDeflection, FollowsSpringsThatHarden) {
  ArmDescription description = test::ArmA5();
  description.joint_hardening_Nmprad3 = std::vector<double>(5, 5e9);  // as stiff again at 1.3 mrad
  const test::ModelArm<5, 6> arm(description);
  test::Draw draw(33);
  for (int n = 0; n < 50; ++n) {
    const TipErrors error = Compare(arm, MidPose(draw), {draw.Vector<3>(15.0), Eigen::Vector3d::Zero()});
    EXPECT_LT(error.with, 0.05 * error.without);
  }
}

TEST(StaticDeflection, MotorLeadsJointByTorqueOverStiffness) {
  const test::ModelArm<5, 6> arm(test::ArmA5());
  const Bodies<5> bodies = BodiesFor(arm, arm.p_true);
  Kinematics<5> kin;
  ForwardKinematics<5>(arm, Vec<5>(0.2, 0.8, -1.4, 0.3, 0.1), Vec<5>::Zero(), kin);
  const Vec<5> xi = GravityTorque(bodies, kin, arm.gravity).cwiseQuotient(arm.joint_stiffness);
  EXPECT_NEAR((CompensateDeflection(arm, kin, bodies, Wrench{}).spring - xi).norm(), 0.0, 1e-15);
}

TEST(StaticDeflection, AStretchedArmGetsAFiniteAnswer) {
  const test::ModelArm<5, 6> arm(test::ArmA5());
  const Bodies<5> bodies = BodiesFor(arm, arm.p_true);
  Kinematics<5> kin;
  ForwardKinematics<5>(arm, Vec<5>(0.0, 1.5707963267948966, 0.0, -1.5707963267948966, 0.0), Vec<5>::Zero(),
                       kin);
  EXPECT_LT(CompensateDeflection(arm, kin, bodies, {Eigen::Vector3d(5.0, 5.0, 5.0), Eigen::Vector3d::Zero()})
                .offset.norm(),
            0.1);
}

TEST(SpringAngle, SolvesTheCubicFromBothSides) {  // (16): torque = k ξ + k₃ ξ³
  for (const double torque : {-30.0, -1.0, 0.0, 0.5, 40.0}) {
    const double k = 5000.0, k3 = 1e8, xi = SpringAngle(torque, k, k3);
    EXPECT_NEAR(k * xi + k3 * xi * xi * xi, torque, 1e-10 * (1.0 + std::abs(torque)));
    EXPECT_EQ(SpringAngle(torque, k, 0.0), torque / k);
  }
}

}  // namespace
}  // namespace reed::model
