// D and the force estimate on poses of real arms: D moves the tip along n by one and not at all sideways.
#include <gtest/gtest.h>

#include <random>

#include "reed/config/schema/halves.h"
#include "reed/core/contact/force_loop.h"
#include "reed/core/contact/normal_direction.h"
#include "reed/core/estimate/force_estimate.h"
#include "reed/core/model/kinematics.h"
#include "reed/firmware/setup/arm_model.h"
#include "reed/tests/support/arms.h"

namespace reed {
namespace {

template <int N, int P>
void ExpectPureTranslation(const ArmDescription& description, double sideways) {
  const model::ArmModel<N, P> arm = model::ArmModelFrom<N, P>(NominalOf(description));
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> angle(0.3, 1.2), any(-1.0, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    model::Vec<N> q, qd;
    for (double& x : q) x = angle(engine);
    for (double& x : qd) x = any(engine);
    const Eigen::Vector3d n = Eigen::Vector3d(any(engine), any(engine), any(engine)).normalized();
    model::Kinematics<N> kin;
    model::ForwardKinematics<N, P>(arm, q, qd, kin);
    const auto normal = control::PureNormalTranslation<N>(kin.J, n);
    EXPECT_NEAR(normal.J_n.dot(normal.D), 1.0, 1e-9);
    const Eigen::Vector3d tip_rate = kin.J.template topRows<3>() * normal.D;
    EXPECT_LT((tip_rate - n).norm(), sideways) << "tip motion per unit along n";

    control::Auxiliary<N> aux;
    aux.v = qd;
    aux.v_dot = q;
    control::ReplaceNormal<N>(normal, 0.02, 0.3, aux);
    EXPECT_NEAR(normal.J_n.dot(aux.v), -0.02, 1e-9) << "(30): the normal speed belongs to the force";
    EXPECT_NEAR(normal.J_n.dot(aux.v_dot), -0.3, 1e-8);

    const Eigen::Vector3d F(3.0, -2.0, 8.0);
    const model::Vec<N> r = kin.J.template topRows<3>().transpose() * F;
    EXPECT_LT((control::EstimateTipForce<N>(kin.J, r) - F).norm(), 2e-3) << "(50) undoes Jᵀ";
  }
}

TEST(DirectionsOfArms, OfSevenJointsIsAPureTranslation) { ExpectPureTranslation<7, 8>(test::ArmA7(), 1e-6); }

// Five joints cannot always keep the hand's direction: D then is the least-squares compromise, J_n D = 1
// still.
TEST(DirectionsOfArms, OfFiveJointsMovesTheTipByOneAlongTheNormal) {
  const model::ArmModel<5, 6> arm = model::ArmModelFrom<5, 6>(NominalOf(test::ArmA5()));
  model::Kinematics<5> kin;
  model::Vec<5> q;
  q << 0.0, 1.057362, -1.764384, -2.43457, 0.0;
  model::ForwardKinematics<5, 6>(arm, q, model::Vec<5>::Zero(), kin);
  const auto normal = control::PureNormalTranslation<5>(kin.J, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(normal.J_n.dot(normal.D), 1.0, 1e-9);
  const model::Vec6 twist = kin.J * normal.D;
  model::Vec6 wanted = model::Vec6::Zero();
  wanted[2] = 1.0;
  EXPECT_LT((twist - wanted).norm(), 1e-6) << "in the plane of the arm a pure translation exists";
}

}  // namespace
}  // namespace reed
