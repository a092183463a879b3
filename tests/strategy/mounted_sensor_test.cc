// The force sensor where it is mounted: turned, with a tool behind it, tared in one pose and used in another.
#include "reed/core/contact/mounted_sensor.h"

#include <gtest/gtest.h>

#include <random>

#include "reed/core/contact/normal_force.h"
#include "reed/tests/support/arms.h"
#include "reed/tests/support/model_arm.h"

namespace reed::strategy {
namespace {

using Eigen::Vector3d;
using model::Vec;

constexpr int N = 5, P = 6;

ArmDescription ArmWithSensor() {
  ArmDescription arm = test::ArmA5();
  arm.base.rpy_rad = {0.3, -0.2, 0.5};
  arm.force_sensor.rpy_rad = {0.4, -1.1, 2.0};
  arm.force_sensor.xyz_m = {0.02, -0.01, -0.07};
  arm.force_sensor.tool_mass_kg = 0.6;
  arm.force_sensor.tool_com_m = {0.01, 0.03, 0.05};
  return arm;
}

class MountedSensorTest : public testing::Test {
 protected:
  model::Kinematics<N> At(const Vec<N>& q) const {
    model::Kinematics<N> kin;
    model::ForwardKinematics<N, P>(arm_, q, Vec<N>::Zero(), kin);
    return kin;
  }
  /// In the world, from points and forces alone, then axis by axis: projections on the sensor's axes, and its bias.
  model::Wrench Reading(const model::Kinematics<N>& kin, const model::Wrench& contact) const {
    const Eigen::Matrix3d in_world = kin.R[N - 1] * description_.force_sensor.rotation();
    const Vector3d origin = kin.p[N - 1] + kin.R[N - 1] * description_.force_sensor.xyz_m;
    const Vector3d weight = 0.6 * description_.gravity_mps2;
    const Vector3d com = origin + 0.01 * in_world.col(0) + 0.03 * in_world.col(1) + 0.05 * in_world.col(2);
    const Vector3d force = contact.F + weight;
    const Vector3d moment = contact.n + (kin.tip - origin).cross(contact.F) + (com - origin).cross(weight);
    model::Wrench read = bias_;
    for (int axis = 0; axis < 3; ++axis) {
      read.F[axis] += in_world.col(axis).dot(force);
      read.n[axis] += in_world.col(axis).dot(moment);
    }
    return read;
  }

  const ArmDescription description_ = ArmWithSensor();
  const test::ModelArm<N, P> arm_{description_};
  const model::Wrench bias_{{2.0, -1.0, 3.0}, {0.3, 0.2, -0.1}};
  const Vector3d normal_ = Vector3d(1.0, 2.0, 3.0).normalized();
  std::mt19937 engine_{3};
  Vec<N> Draw() {
    std::uniform_real_distribution<double> uniform(-2.0, 2.0);
    Vec<N> q;
    for (int i = 0; i < N; ++i) q(i) = uniform(engine_);
    return q;
  }
};

TEST_F(MountedSensorTest, TaredInAnyPoseItMeasuresTheContactInEveryOther) {
  for (int n = 0; n < 20; ++n) {
    NormalForce force(normal_, 1.0, 1e-3);
    MountedSensor sensor;
    const model::Kinematics<N> still = At(Draw());
    sensor.Turn(arm_, still);
    for (int k = 0; k < 64; ++k) force.Tare(sensor.WithoutWeight(Reading(still, {})), true);
    EXPECT_NEAR(force.ZeroOffset(), bias_.F.norm(), 1e-12) << "the weight is no part of the zero";

    const model::Kinematics<N> there = At(Draw());
    sensor.Turn(arm_, there);
    const model::Wrench contact{8.0 * normal_ + Vector3d(0.5, -0.3, 0.1), {0.2, 0.4, -0.3}};
    const model::Wrench read = Reading(there, contact);
    EXPECT_NEAR(force.Step(ForceSource::kKnown, sensor.Read(read.F, normal_), Vector3d::Zero(), true),
                normal_.dot(contact.F), 1e-12);
    const model::Wrench felt = sensor.AtTool(force.Felt(sensor.WithoutWeight(read)));
    EXPECT_LT((felt.F - contact.F).norm(), 1e-12);
    EXPECT_LT((felt.n - contact.n).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace reed::strategy
