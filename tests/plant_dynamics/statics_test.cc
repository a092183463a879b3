// Sag and tip stiffness against the principle of virtual work, with kinematics of its own.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "reed/plant/dynamics/modes.h"
#include "reed/tests/plant_dynamics/bench.h"

namespace reed::plant {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

struct Weight {
  Vector3d at, force;  // acts at `at` ...
  int member;          // ... and enters the structure at this member ...
  double l;            // ... this far from its base
};

/// a5 as lines and springs in space, undeformed. Only what a5 needs: one member per link 1, 2, 3 and 5.
struct Frame {
  explicit Frame(const VectorXd& q) {
    const TrueArm arm = TrueOf(test::ArmA5());
    Matrix3d R = Matrix3d::Identity();
    Vector3d p = Vector3d::Zero();
    std::size_t section = 0;
    for (std::size_t i = 0; i < 5; ++i) {
      R = R * Eigen::AngleAxisd(arm.joints[i].rpy_rad.x(), Vector3d::UnitX());
      R = R * Eigen::AngleAxisd(q[static_cast<Eigen::Index>(i)], Vector3d::UnitZ());
      joint_at.push_back(p);
      joint_axis.push_back(R.col(2));
      joint_first_member.push_back(static_cast<int>(section));
      const double d = arm.joints[i].d_m, a = i < 4 ? arm.joints[i + 1].xyz_m.x() : 0.0;
      if (d == 0.0 && a == 0.0) continue;
      const Vector3d along = d != 0.0 ? Vector3d(R.col(2)) : Vector3d(R.col(0));
      const BeamSection& s = arm.sections[section];
      const InertialBody& body = arm.bodies[i];
      if (body.mass_kg > 0.0) {
        // As much of it evenly along the member as leaves a rest that can exist: until the rest has shrunk,
        // along the member, to a point. Second moment times mass = first moment squared is quadratic in the
        // line's mass.
        const Matrix3d& I = body.inertia_com_kgm2;
        const Vector3d com = p + d * R.col(2) + R * body.com_m, local = R.transpose() * along;
        const double L = s.length_m, m = body.mass_kg, c = along.dot(com - p);
        const double mu1 = m * c, mu2 = 0.5 * I.trace() - local.dot(I * local) + m * c * c;
        const double A = L * L / 12.0, B = mu1 * L - mu2 - m * L * L / 3.0, C = mu2 * m - mu1 * mu1;
        const double line = (-B - std::sqrt(std::max(0.0, B * B - 4.0 * A * C))) / (2.0 * A), rest = m - line;
        if (rest > 1e-9) {
          const Vector3d rest_com = (m * com - line * (p + 0.5 * L * along)) / rest;
          weights.push_back({rest_com, rest * arm.gravity_mps2, static_cast<int>(section),
                             std::min(L, along.dot(rest_com - p))});
        }
        const int slices = 200;
        for (int k = 0; k < slices; ++k) {
          const double l = (k + 0.5) * s.length_m / slices;
          weights.push_back({p + l * along, line / slices * arm.gravity_mps2, static_cast<int>(section), l});
        }
      }
      base.push_back(p);
      direction.push_back(along);
      sections.push_back(s);
      p += s.length_m * along;
      ++section;
    }
    tool = p;
  }

  /// Work of `unit` at the tool on the displacement that `tip_force` at the tool and the weights cause:
  /// ∫ (M·m/EI across, M·m/GJ and N n/EA along) dl + Σ τ t/k.
  double Displacement(const Vector3d& unit, const Vector3d& tip_force, bool gravity) const {
    double sum = 0.0;
    const int slices = 400;
    for (std::size_t m = 0; m < base.size(); ++m) {
      const double dl = sections[m].length_m / slices;
      for (int k = 0; k < slices; ++k) {
        const double l = (k + 0.5) * dl;
        const Vector3d cut = base[m] + l * direction[m];
        Vector3d N = tip_force, M = (tool - cut).cross(tip_force);
        if (gravity) Gather(static_cast<int>(m), l, cut, N, M);
        const Vector3d mu = (tool - cut).cross(unit);
        const double M_along = M.dot(direction[m]), mu_along = mu.dot(direction[m]);
        const double across = M.dot(mu) - M_along * mu_along;
        sum += dl * (across / sections[m].EI_Nm2 + M_along * mu_along / sections[m].GJ_Nm2 +
                     N.dot(direction[m]) * unit.dot(direction[m]) / sections[m].EA_N);
      }
    }
    const TrueArm arm = TrueOf(test::ArmA5());
    for (std::size_t i = 0; i < joint_at.size(); ++i) {
      Vector3d N = tip_force, M = (tool - joint_at[i]).cross(tip_force);
      if (gravity) Gather(joint_first_member[i], -1.0, joint_at[i], N, M);
      sum += M.dot(joint_axis[i]) * (tool - joint_at[i]).cross(unit).dot(joint_axis[i]) /
             arm.joint_stiffness_Nmprad[i];
    }
    return sum;
  }

  void Gather(int member, double l, const Vector3d& cut, Vector3d& N, Vector3d& M) const {
    for (const Weight& w : weights)
      if (w.member > member || (w.member == member && w.l > l)) {
        N += w.force;
        M += (w.at - cut).cross(w.force);
      }
  }

  std::vector<Vector3d> joint_at, joint_axis, base, direction;
  std::vector<int> joint_first_member;  // the first member beyond the joint
  std::vector<BeamSection> sections;
  std::vector<Weight> weights;
  Vector3d tool;
};

class StaticsTest : public testing::TestWithParam<std::vector<double>> {
 protected:
  VectorXd q() const { return Eigen::Map<const VectorXd>(GetParam().data(), 5); }
};

TEST_P(StaticsTest, TipForceMovesTheTipAsVirtualWorkSays) {
  ArmModes arm(TrueOf(test::ArmA5()), PlantModelConfig{}, q());
  const Frame frame(q());
  const Vector3d rest = arm.Load(Vector3d::Zero(), false);
  EXPECT_LT((rest - frame.tool).norm(), 1e-12);
  const double newton = 1e-3;  // small: the closed form is linear
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d moved = (arm.Load(newton * Vector3d::Unit(axis), false) - rest) / newton;
    Vector3d expected;
    for (int e = 0; e < 3; ++e)
      expected[e] = frame.Displacement(Vector3d::Unit(e), Vector3d::Unit(axis), false);
    EXPECT_LT((moved - expected).norm(), 1e-5 * expected.norm()) << "force along " << axis;
  }
}

TEST_P(StaticsTest, SagUnderItsOwnWeightIsThatOfVirtualWork) {
  ArmModes arm(TrueOf(test::ArmA5()), PlantModelConfig{}, q());
  const Frame frame(q());
  const Vector3d sag = arm.Load(Vector3d::Zero(), true) - frame.tool;
  Vector3d expected;
  for (int e = 0; e < 3; ++e) expected[e] = frame.Displacement(Vector3d::Unit(e), Vector3d::Zero(), true);
  EXPECT_GT(expected.norm(), 1e-4);
  EXPECT_LT((sag - expected).norm(),
            0.005 * expected.norm());  // what remains is the load's own bending of the arm
}

INSTANTIATE_TEST_SUITE_P(Poses, StaticsTest,
                         testing::Values(std::vector{0.2, 0.6, -0.9, 0.5, 0.3},
                                         std::vector{0.0, 0.0, 0.0, 0.0, 0.0},
                                         std::vector{-1.2, 1.3, -2.0, -0.6, 1.0},
                                         std::vector{2.0, -0.3, 1.1, 1.4, -0.7}));

TEST(Statics, PlantStartsWhereTheStaticArmRests) {
  PlantConfig scene;
  scene.arm = TrueOf(test::ArmA5());
  ArmPlant plant(scene);
  plant.Reset(test::MidPose());
  ArmModes arm(scene.arm, scene.plant, test::MidPose());
  EXPECT_LT((plant.truth().tip_m - arm.Load(Vector3d::Zero(), true)).norm(), 1e-13);
  EXPECT_EQ(plant.truth().kinetic_J, 0.0);
  EXPECT_EQ(plant.num_coordinates(), 5 + 5 + 4 * 10);
}

TEST(Statics, MoreElementsFindTheSameSag) {
  const auto sag = [](int elements) {
    PlantModelConfig config;
    config.elements_per_link = elements;
    ArmModes arm(TrueOf(test::ArmA5()), config, test::MidPose());
    return Vector3d(arm.Load({3.0, -4.0, -5.0}, true) - arm.Undeformed().back());
  };
  EXPECT_LT((sag(1) - sag(4)).norm(), 1e-5 * sag(4).norm());
}

TEST(Statics, HardeningSpringGivesLess) {
  TrueArm arm = TrueOf(test::ArmA5());
  ArmModes linear(arm, PlantModelConfig{}, test::MidPose());
  arm.joint_hardening_Nmprad3.assign(5, 5e9);
  ArmModes hardening(arm, PlantModelConfig{}, test::MidPose());
  const Vector3d force(0.0, 0.0, -20.0);
  const double soft = linear.Load(force, false).z() - linear.Load(Vector3d::Zero(), false).z();
  const double hard = hardening.Load(force, false).z() - hardening.Load(Vector3d::Zero(), false).z();
  EXPECT_LT(std::abs(hard), 0.9 * std::abs(soft));
}

TEST(Statics, ModesOfTheArmAtMidPose) {
  ArmModes arm(TrueOf(test::ArmA5()), PlantModelConfig{}, test::MidPose());
  ArmModes fine(
      TrueOf(test::ArmA5()),
      [] {
        PlantModelConfig c;
        c.elements_per_link = 4;
        return c;
      }(),
      test::MidPose());
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(arm.frequency_hz()[i] / fine.frequency_hz()[i], 1.0, 2e-3) << i;
  EXPECT_GT(arm.frequency_hz()[0], 10.0);
  EXPECT_LT(arm.frequency_hz()[0], 16.0);
  const std::vector<Vector3d> shape = arm.ModeShape(0);
  double largest = 0.0;
  for (const Vector3d& point : shape) largest = std::max(largest, point.norm());
  EXPECT_DOUBLE_EQ(largest, 1.0);
  EXPECT_EQ(shape.size(), arm.Undeformed().size());
  EXPECT_EQ(shape.front().norm(), 0.0);
}

}  // namespace
}  // namespace reed::plant
