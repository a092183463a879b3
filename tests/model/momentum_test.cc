// What the momentum observer is told: M q̇ and Cᵀ q̇ - G, in O(N) against the matrices.
#include <gtest/gtest.h>

#include "reed/core/model/dynamics.h"
#include "reed/firmware/setup/arm_model.h"
#include "reed/tests/model/states.h"

namespace reed::model {
namespace {

TEST(GeneralisedMomentum, IsMassTimesSpeedAndItsModelRateIsCTransposedMinusGravity) {
  const test::ModelArm<6, 4> arm(test::SkewArm());
  const Bodies<6> bodies = BodiesFor(arm, arm.p_nominal);
  test::Draw draw(3);
  for (int n = 0; n < 300; ++n) {
    Kinematics<6> kin;
    ForwardKinematics<6>(arm, draw.Vector<6>(3.0), draw.Vector<6>(3.0), kin);
    const MomentumModel<6> model = GeneralisedMomentum(bodies, kin, arm.gravity);
    const Vec<6> rate =
        CoriolisMatrix(bodies, kin).transpose() * kin.qd - GravityTorque(bodies, kin, arm.gravity);
    EXPECT_NEAR((model.momentum - MassMatrix(bodies, kin) * kin.qd).norm(), 0.0, 1e-11);
    EXPECT_NEAR((model.free_rate - rate).norm(), 0.0, 1e-11 * (1.0 + rate.norm()));
  }
}

TEST(GeneralisedMomentum, ChangesAsTheTorqueBehindItSays) {  // d/dt (M q̇) = τ + Cᵀ q̇ - G
  const test::ModelArm<6, 4> arm(test::SkewArm());
  const Bodies<6> bodies = BodiesFor(arm, arm.p_true);
  test::Draw draw(4);
  constexpr double h = 1e-6;
  for (int n = 0; n < 50; ++n) {
    const Vec<6> q = draw.Vector<6>(3.0), qd = draw.Vector<6>(2.0), qdd = draw.Vector<6>(5.0);
    const auto momentum_at = [&](double t) {
      Kinematics<6> kin;
      ForwardKinematics<6>(arm, q + t * qd + 0.5 * t * t * qdd, qd + t * qdd, kin);
      return GeneralisedMomentum(bodies, kin, arm.gravity).momentum;
    };
    Kinematics<6> kin;
    ForwardKinematics(arm, q, qd, kin);
    const Vec<6> rate = InverseDynamics(bodies, kin, qdd, arm.gravity) +
                        GeneralisedMomentum(bodies, kin, arm.gravity).free_rate;
    EXPECT_NEAR(((momentum_at(h) - momentum_at(-h)) / (2.0 * h) - rate).norm(), 0.0,
                1e-6 * (1.0 + rate.norm()));
  }
}

}  // namespace
}  // namespace reed::model
