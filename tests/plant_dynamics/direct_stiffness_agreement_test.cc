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

/// a5 with links of other shapes: an L of two pieces, one that is skew, flat and massless, one that is rigid for a part.
ArmDescription ArmOfMembers() {
  ArmDescription arm = test::ArmA5();
  arm.sections.clear();
  const auto add = [&](int link, const Vector3d& from, const Vector3d& to, const Vector3d& y, double EI_z,
                       double rhoA) {
    arm.members.push_back({link, from, to, y, 9.0e6, 900.0, EI_z, 600.0, rhoA});
  };
  add(1, {0.0, 0.0, 0.0}, {0.1, 0.0, 0.15}, {0.0, 0.0, 0.0}, 900.0, 0.4);
  add(1, {0.1, 0.0, 0.15}, {0.35, 0.0, 0.0}, {0.0, 1.0, 0.3}, 200.0, 0.8);
  add(2, {0.02, 0.0, 0.0}, {0.25, 0.05, -0.1}, {1.0, 0.0, 1.0}, 300.0, 0.0);
  add(4, {0.0, 0.0, -0.15}, {0.0, 0.0, -0.05}, {0.0, 0.0, 0.0}, 400.0, 0.3);
  return arm;
}

/// Slope at zero: central differences of two widths, so that terms of second to fourth order in the load leave.
template <typename Moved>
Vector3d Slope(Moved moved, double load) {
  const auto difference = [&](double width) -> Vector3d {
    return (moved(width) - moved(-width)) / (2.0 * width);
  };
  return (4.0 * difference(load) - difference(2.0 * load)) / 3.0;
}

TEST_P(AgreementTest, MembersInAnyDirectionYieldAsInTheDirectStiffnessMethod) {
  const ArmDescription description = ArmOfMembers();
  const test::ModelArm<5, 6> arm(description);
  const model::Mat6 C = model::LinkCompliance(arm, kin_) + model::JointCompliance(arm, kin_);
  plant::ArmModes plant(TrueOf(description), PlantModelConfig{}, q_);
  for (int axis = 0; axis < 3; ++axis) {
    const auto moved = [&](double load) { return plant.Load(load * Vector3d::Unit(axis), false); };
    const Vector3d expected = C.block<3, 1>(0, axis);
    EXPECT_LT((Slope(moved, 1.0) - expected).norm(), 1e-8 * expected.norm()) << axis;
  }
}

INSTANTIATE_TEST_SUITE_P(Poses, AgreementTest,
                         testing::Values(std::vector{0.2, 0.6, -0.9, 0.5, 0.3},
                                         std::vector{0.4, 0.9, -1.5, 0.3, -1.0},
                                         std::vector{-1.2, 1.3, -2.0, -0.6, 1.0}));

}  // namespace
}  // namespace reed
