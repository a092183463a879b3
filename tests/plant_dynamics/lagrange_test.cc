// (17)-(20): the sweeps solve Lagrange's equations of the very energies that the plant reports.
#include <gtest/gtest.h>

#include <random>

#include "reed/plant/dynamics/equations_of_motion.h"
#include "reed/tests/plant_dynamics/bench.h"

namespace reed::plant {
namespace {

using Eigen::VectorXd;

/// a5 with mass in its first link too, so that M is regular, a tool offset, and springs that harden.
TrueArm RegularArm() {
  TrueArm arm = TrueOf(test::ArmA5());
  arm.bodies[0] = {2.0, {0.02, -0.01, -0.08}, Eigen::Vector3d(0.12, 0.13, 0.15).asDiagonal()};
  arm.bodies[3] = {0.2, {0.01, 0.0, 0.02}, 1e-3 * Eigen::Matrix3d::Identity()};
  arm.tool.xyz_m = {0.03, 0.01, 0.05};
  arm.joint_hardening_Nmprad3 = {2e6, 2e6, 1e6, 1e6, 1e6};
  arm.gravity_mps2 = {1.0, -2.0, -9.0};
  return arm;
}

class LagrangeTest : public testing::TestWithParam<int> {
 protected:
  LagrangeTest() {
    PlantModelConfig config;
    config.elements_per_link = 1 + GetParam() % 2;
    config.friction_scale = 0.0;
    config.stiffness_scale =
        1e-6;  // or deflections that matter would mean accelerations beyond finite differences
    chain_ = BuildChain(RegularArm(), config);
    equations_ = std::make_unique<EquationsOfMotion>(chain_, wall_);
    equations_->SetPayload(0.3);
    std::mt19937 engine(static_cast<unsigned>(100 + GetParam()));
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const int n = equations_->size(), joints = 2 * chain_.dof();
    x_ = x_dot_ = VectorXd::Zero(n);
    for (int i = 0; i < n; ++i) {
      // Deflections of centimetres and hundredths of a radian: far more than the arm ever bends.
      x_[i] = uniform(engine) * (i < joints ? 2.0 : 0.03);
      x_dot_[i] = uniform(engine) * (i < joints ? 3.0 : 0.5);
    }
    for (int i = 0; i < chain_.dof(); ++i) x_[chain_.dof() + i] = x_[i] + 0.02 * uniform(engine);
  }

  double Kinetic(const VectorXd& x, const VectorXd& x_dot) {
    equations_->SetState(x, x_dot);
    return equations_->KineticEnergy();
  }
  double Potential(const VectorXd& x) {
    equations_->SetState(x, VectorXd::Zero(x.size()));
    return equations_->GravityEnergy() + equations_->ElasticEnergy();
  }
  VectorXd Momentum(const VectorXd& x, const VectorXd& x_dot) {
    equations_->SetState(x, x_dot);
    return equations_->MassMatrix() * x_dot;
  }

  ArmChain chain_;
  Wall wall_{WallConfig{}};
  std::unique_ptr<EquationsOfMotion> equations_;
  VectorXd x_, x_dot_;
};

TEST_P(LagrangeTest, KineticEnergyIsTheQuadraticFormOfTheMassMatrix) {
  const double energy = Kinetic(x_, x_dot_);
  EXPECT_NEAR(energy, 0.5 * x_dot_.dot(Momentum(x_, x_dot_)), 1e-12 * energy);
}

TEST_P(LagrangeTest, AccelerationSatisfiesLagrangesEquations) {
  const int n = equations_->size();
  Load load;
  load.motor_torque = VectorXd::LinSpaced(chain_.dof(), -3.0, 4.0);
  load.disturbance = {5.0, -7.0, 3.0};
  Implicit explicit_;
  explicit_.y_d = explicit_.y_k = VectorXd::Zero(n);
  VectorXd acceleration = VectorXd::Zero(n);
  equations_->SetState(x_, x_dot_);
  equations_->Solve(load, explicit_, acceleration);

  VectorXd Q = equations_->ToolJacobian().transpose() * load.disturbance;
  Q.head(chain_.dof()) += load.motor_torque;

  // d/dt ∂L/∂x' - ∂L/∂x = Q, by central differences along the motion and across it.
  const double dt = 1e-6;
  const VectorXd rate = (Momentum(x_ + dt * x_dot_, x_dot_ + dt * acceleration) -
                         Momentum(x_ - dt * x_dot_, x_dot_ - dt * acceleration)) /
                        (2.0 * dt);
  for (int i = 0; i < n; ++i) {
    const double h = 1e-6;
    const VectorXd ahead = x_ + h * VectorXd::Unit(n, i), behind = x_ - h * VectorXd::Unit(n, i);
    const double dT = (Kinetic(ahead, x_dot_) - Kinetic(behind, x_dot_)) / (2.0 * h);
    const double dV = (Potential(ahead) - Potential(behind)) / (2.0 * h);
    const double scale = 1.0 + std::abs(rate[i]) + std::abs(dT) + std::abs(dV);
    EXPECT_NEAR(rate[i] - dT + dV, Q[i], 1e-6 * scale) << "coordinate " << i;
  }
}

TEST_P(LagrangeTest, ImplicitSolutionIsTheDenseOne) {
  const int n = equations_->size();
  SetStructuralDamping(chain_, 2e-4);
  Load load;
  load.motor_torque = VectorXd::Zero(chain_.dof());
  Implicit plain, implicit;
  plain.y_d = plain.y_k = VectorXd::Zero(n);
  implicit.c_d = 3e-4;
  implicit.c_k = 1e-7;
  implicit.y_d = VectorXd::LinSpaced(n, 0.5, -0.3);
  implicit.y_k = VectorXd::LinSpaced(n, -2e-3, 1e-3);
  VectorXd acceleration = VectorXd::Zero(n), k = acceleration;
  equations_->SetState(x_, x_dot_);
  equations_->Solve(load, plain, acceleration);
  equations_->Solve(load, implicit, k);

  const Eigen::MatrixXd M = equations_->MassMatrix(), K = equations_->StiffnessMatrix();
  Eigen::MatrixXd D = 2e-4 * K;  // the joints' damping follows k_q, not the tangent of a spring that hardens
  for (int i = 0; i < chain_.dof(); ++i) {
    const int j = i + chain_.dof();
    const double d = chain_.drivetrains[static_cast<std::size_t>(i)].spring.d;
    D(i, i) = D(j, j) = d;
    D(i, j) = D(j, i) = -d;
  }
  const VectorXd F = M * acceleration;
  const Eigen::MatrixXd A = M + implicit.c_d * D + implicit.c_k * K;
  const VectorXd dense = A.ldlt().solve(F + D * implicit.y_d - K * implicit.y_k);
  EXPECT_LT((k - dense).norm(), 1e-8 * dense.norm());
  EXPECT_LT((equations_->tool_rate() - equations_->ToolJacobian() * k).norm(), 1e-9 * k.norm());
}

INSTANTIATE_TEST_SUITE_P(RandomStates, LagrangeTest, testing::Range(0, 10));

TEST(MassSplit, MembersAndRestAreTheWholeLink) {
  // The arm that bends, held straight, has the inertia of the rigid one.
  PlantModelConfig rigid, bending;
  rigid.flexible_links = false;
  const TrueArm arm = RegularArm();
  const ArmChain rigid_chain = BuildChain(arm, rigid), bending_chain = BuildChain(arm, bending);
  const Wall wall(WallConfig{});
  EquationsOfMotion stiff(rigid_chain, wall), soft(bending_chain, wall);
  VectorXd x = VectorXd::Zero(soft.size()), rest = x;
  x.head(10) << 0.1, -0.4, 0.7, 1.1, -0.2, 0.1, -0.4, 0.7, 1.1, -0.2;
  stiff.SetState(x.head(10), rest.head(10));
  soft.SetState(x, rest);
  EXPECT_LT((soft.MassMatrix().topLeftCorner(10, 10) - stiff.MassMatrix()).norm(), 1e-13);
  EXPECT_NEAR(soft.GravityEnergy(), stiff.GravityEnergy(), 1e-12);
  EXPECT_GT(bending_chain.members[1].inertia.mass(), 0.1);  // and the members did keep their own mass
}

}  // namespace
}  // namespace reed::plant
