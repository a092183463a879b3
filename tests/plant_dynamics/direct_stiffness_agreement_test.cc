// The bending plant at rest against the controller's direct stiffness method (4)-(6): two routes, one arm.
#include <gtest/gtest.h>

#include "reed/core/model/static_deflection.h"
#include "reed/firmware/setup/arm_model.h"
#include "reed/firmware/stiffness/direct_stiffness_arm.h"
#include "reed/plant/dynamics/modes.h"
#include "reed/tests/plant_dynamics/bench.h"
#include "reed/tests/support/model_arm.h"

namespace reed {
namespace {

using Eigen::Vector3d;
using model::Vec;

class AgreementTest : public testing::TestWithParam<std::vector<double>> {
 protected:
  AgreementTest() : arm_(test::ArmA5()), q_(Eigen::Map<const Vec<5>>(GetParam().data())) {
    model::ForwardKinematics<5>(arm_, q_, Vec<5>::Zero(), kin_);
  }

  /// Tip displacement by (5), (6) under the links' weight, where asked for, and a force at the tool point.
  Vector3d DirectStiffnessTip(bool weight, const Vector3d& force) const {
    model::StructuralLoads<5> loads;
    loads.tip.F = force;
    if (weight) model::AddBodyWeight(arm_, kin_, model::BodiesFor(arm_, arm_.p_true), loads);
    const model::ArmStructure structure = model::StructureOf(arm_, kin_, loads, model::JointModel::kElastic);
    return structure.matrix.Displacement(structure.tip, structure.matrix.Solve()).head<3>();
  }

  const test::ModelArm<5, 6> arm_;
  const Vec<5> q_;
  model::Kinematics<5> kin_;
};

TEST_P(AgreementTest, SagIsThatOfTheDirectStiffnessMethod) {
  plant::ArmModes plant(TrueOf(test::ArmA5()), PlantModelConfig{}, q_);
  const Vector3d sag = plant.Load(Vector3d::Zero(), true) - kin_.tip;
  const Vector3d expected = DirectStiffnessTip(true, Vector3d::Zero());
  EXPECT_GT(expected.norm(), 1e-4);
  EXPECT_LT((sag - expected).norm(), 0.01 * expected.norm());
}

TEST_P(AgreementTest, TipStiffnessIsThatOfTheDirectStiffnessMethod) {
  plant::ArmModes plant(TrueOf(test::ArmA5()), PlantModelConfig{}, q_);
  const Vector3d rest = plant.Load(Vector3d::Zero(), true);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d force = 5.0 * Vector3d::Unit(axis);
    const Vector3d moved = plant.Load(force, true) - rest, expected = DirectStiffnessTip(false, force);
    EXPECT_LT((moved - expected).norm(), 0.01 * expected.norm()) << axis;
  }
}

TEST_P(AgreementTest, NodalCompensationBringsThePlantsTipToThePlan) {
  const model::Bodies<5> bodies = model::BodiesFor(arm_, arm_.p_true);
  const Vec<5> theta_d = q_ + model::CompensateDeflection(arm_, kin_, bodies, model::Wrench{}).offset;
  plant::ArmModes plain(TrueOf(test::ArmA5()), PlantModelConfig{}, q_),
      compensated(TrueOf(test::ArmA5()), PlantModelConfig{}, theta_d);
  const double without = (plain.Load(Vector3d::Zero(), true) - kin_.tip).norm();
  const double with = (compensated.Load(Vector3d::Zero(), true) - kin_.tip).norm();
  EXPECT_LT(3.0 * with, without);
}

INSTANTIATE_TEST_SUITE_P(Poses, AgreementTest,
                         testing::Values(std::vector{0.2, 0.6, -0.9, 0.5, 0.3},
                                         std::vector{0.4, 0.9, -1.5, 0.3, -1.0},
                                         std::vector{-1.2, 1.3, -2.0, -0.6, 1.0}));

}  // namespace
}  // namespace reed
