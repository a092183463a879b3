// The plant's rigid dynamics against the controller's model, which is Pinocchio's (tests/model): two routes, one arm with
// a turned base and skew transforms between its joints.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <memory>
#include <random>

#include "reed/core/model/static_deflection.h"
#include "reed/firmware/stiffness/direct_stiffness_arm.h"
#include "reed/plant/dynamics/equations_of_motion.h"
#include "reed/plant/dynamics/modes.h"
#include "reed/tests/support/model_arm.h"

namespace reed {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using model::Vec;

constexpr int N = 4, P = 1;

/// No sections: its links are rigid, its joints are springs.
ArmDescription SkewChain() {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto draw = [&](double range) -> Vector3d {
    return range * Vector3d(uniform(engine), uniform(engine), uniform(engine));
  };
  ArmDescription arm;
  arm.name = "skew";
  arm.base = {draw(1.0), draw(3.0)};
  arm.tool = {draw(0.3), draw(3.0)};
  arm.gravity_mps2 = {1.0, -2.0, -9.0};
  for (int i = 0; i < N; ++i) {
    Joint joint;
    joint.xyz_m = draw(0.4);
    joint.rpy_rad = draw(3.0);
    joint.offset_rad = uniform(engine);
    joint.d_m = 0.2 * uniform(engine);
    arm.joints.push_back(joint);
    const Vector3d along = draw(1.0);
    const Matrix3d inertia = 0.01 * (2.0 * Matrix3d::Identity() + 0.5 * along * along.transpose());
    arm.bodies.push_back({2.0 - 0.4 * i, draw(0.1), inertia});
    arm.rotor_inertia_kgm2.push_back(0.1);
    arm.joint_stiffness_Nmprad.push_back(5000.0);
  }
  return arm;
}

class RigidAgreement : public testing::TestWithParam<int> {
 protected:
  RigidAgreement()
      : description_(SkewChain()), arm_(description_), bodies_(model::BodiesFor(arm_, arm_.p_true)) {
    std::mt19937 engine(static_cast<unsigned>(GetParam()));
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int i = 0; i < N; ++i) {
      q_(i) = 3.0 * uniform(engine);
      qd_(i) = 2.0 * uniform(engine);
    }
    model::ForwardKinematics(arm_, q_, qd_, kin_);
    x_.resize(2 * N);
    x_dot_.resize(2 * N);
    x_ << q_, q_;  // the springs are at rest
    x_dot_ << qd_, qd_;
    chain_ = plant::BuildChain(TrueOf(description_), PlantModelConfig{});
    equations_ = std::make_unique<plant::EquationsOfMotion>(chain_, wall_);
    equations_->SetState(x_, x_dot_);
  }

  const ArmDescription description_;
  const test::ModelArm<N, P> arm_;
  const model::Bodies<N> bodies_;
  Vec<N> q_, qd_;
  model::Kinematics<N> kin_;
  VectorXd x_, x_dot_;
  plant::ArmChain chain_;
  plant::Wall wall_{WallConfig{}};
  std::unique_ptr<plant::EquationsOfMotion> equations_;
};

TEST_P(RigidAgreement, ToolPointAndItsVelocity) {
  EXPECT_LT((equations_->tool_position() - kin_.tip).norm(), 1e-12);
  EXPECT_LT((equations_->tool_velocity() - kin_.tip_velocity().head<3>()).norm(), 1e-12);
}

TEST_P(RigidAgreement, MassMatrixAndPotentialEnergy) {
  const model::Mat<N, N> M = equations_->MassMatrix().bottomRightCorner<N, N>();
  EXPECT_LT((M - model::MassMatrix(bodies_, kin_)).norm(), 1e-11 * M.norm());
  EXPECT_NEAR(equations_->GravityEnergy(), model::PotentialEnergy(bodies_, kin_, arm_.gravity), 1e-11);
}

TEST_P(RigidAgreement, FreeAcceleration) {  // M q̈ = -C q̇ - G while the springs are at rest
  plant::Load load;
  load.motor_torque = VectorXd::Zero(N);
  plant::Implicit explicit_;
  explicit_.y_d = explicit_.y_k = VectorXd::Zero(2 * N);
  VectorXd acceleration = VectorXd::Zero(2 * N);
  equations_->Solve(load, explicit_, acceleration);
  const Vec<N> free_torque =
      model::CoriolisTorque(bodies_, kin_) + model::GravityTorque(bodies_, kin_, arm_.gravity);
  const Vec<N> expected = -model::MassMatrix(bodies_, kin_).ldlt().solve(free_torque);
  EXPECT_LT((acceleration.tail<N>() - expected).norm(), 1e-9 * expected.norm());
}

TEST_P(RigidAgreement, JointsYieldAsTheDirectStiffnessMethodSays) {
  plant::ArmModes plant(TrueOf(description_), PlantModelConfig{}, q_);
  const Vector3d rest = plant.Load(Vector3d::Zero(), true);
  const Vector3d force(3.0, -2.0, 4.0), moved = plant.Load(force, true) - rest;
  model::StructuralLoads<N> loads;
  loads.tip.F = force;
  const model::ArmStructure structure = model::StructureOf(arm_, kin_, loads, model::JointModel::kElastic);
  const Vector3d expected = structure.matrix.Displacement(structure.tip, structure.matrix.Solve()).head<3>();
  EXPECT_LT((moved - expected).norm(), 0.03 * expected.norm());  // the plant's pose is the bent one
}

TEST_P(RigidAgreement, CompensationBringsThePlantsTipToThePlan) {
  const Vec<N> theta_d = q_ + model::CompensateDeflection(arm_, kin_, bodies_, model::Wrench{}).offset;
  plant::ArmModes plain(TrueOf(description_), PlantModelConfig{}, q_),
      compensated(TrueOf(description_), PlantModelConfig{}, theta_d);
  const double without = (plain.Load(Vector3d::Zero(), true) - kin_.tip).norm();
  const double with = (compensated.Load(Vector3d::Zero(), true) - kin_.tip).norm();
  EXPECT_LT(with, 0.03 * without);
}

INSTANTIATE_TEST_SUITE_P(States, RigidAgreement, testing::Range(0, 20));

}  // namespace
}  // namespace reed
