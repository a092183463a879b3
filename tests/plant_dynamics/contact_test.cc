// The wall, the disturbance and the brakes.
#include <gtest/gtest.h>

#include <cmath>

#include "reed/plant/dynamics/brake.h"
#include "reed/plant/dynamics/disturbance.h"
#include "reed/plant/dynamics/modes.h"
#include "reed/plant/dynamics/wall.h"
#include "reed/tests/plant_dynamics/bench.h"

namespace reed::plant {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

WallConfig Floor() {
  WallConfig wall;
  wall.present = true;
  wall.stiffness_Npm = 1e4;
  wall.damping_Nspm = 50.0;
  wall.friction = 0.3;
  return wall;
}

TEST(Wall, NeverPulls) {
  const Wall wall(Floor());
  EXPECT_EQ(wall.Touch({0.0, 0.0, 1e-6}, {0.0, 0.0, -1.0}).normal_force, 0.0);
  EXPECT_EQ(wall.Touch({0.0, 0.0, -1e-4}, {0.0, 0.0, 1.0}).force.norm(),
            0.0);  // leaves faster than it can follow
  EXPECT_DOUBLE_EQ(wall.Touch({0.0, 0.0, -1e-3}, {0.0, 0.0, -0.1}).normal_force, 10.0 + 5.0);
}

TEST(Wall, OffsetMovesTheSurfaceAlongTheNormalOfAnyLength) {
  WallConfig config = Floor();
  config.normal = {0.0, 3.0, 4.0};
  config.point_m = {0.1, 0.2, 0.3};
  config.offset_m = -1e-3;
  const Wall wall(config);
  EXPECT_NEAR(wall.Touch({0.1, 0.2, 0.3}, Vector3d::Zero()).gap, 1e-3, 1e-15);
  EXPECT_NEAR(
      wall.Touch(Vector3d(0.1, 0.2, 0.3) - 3e-3 * Vector3d(0.0, 0.6, 0.8), Vector3d::Zero()).normal_force,
      20.0, 1e-9);
}

TEST(Wall, FrictionStaysInItsConeAndReachesIt) {
  const Wall wall(Floor());
  const double v_s = Floor().friction_speed_mps;
  for (const double speed : {0.0, 0.1 * v_s, 0.5 * v_s, v_s, 3.0 * v_s, 1.0}) {
    const Wall::Contact contact = wall.Touch({0.0, 0.0, -1e-3}, {0.6 * speed, -0.8 * speed, 0.0});
    const Vector3d tangential(contact.force.x(), contact.force.y(), 0.0);
    EXPECT_LE(tangential.norm(), 0.3 * contact.normal_force * (1.0 + 1e-12));
    EXPECT_LE(tangential.dot(Vector3d(0.6, -0.8, 0.0)), 0.0);
    if (speed >= v_s) {
      EXPECT_NEAR(tangential.norm(), 0.3 * contact.normal_force, 1e-12);
    }
  }
}

TEST(Wall, ArmComesToRestWhereSpringsAndWallBalance) {
  // GIVEN the arm at rest and its motors held by the brakes, WHEN a wall stands 2 mm into where the tip is
  PlantConfig scene;
  scene.arm = TrueOf(test::ArmA5());
  scene.plant.damping_ratio = 0.05;
  ArmModes statics(scene.arm, scene.plant, test::MidPose());
  const Vector3d rest = statics.Load(Vector3d::Zero(), true);
  scene.wall = Floor();
  scene.wall.friction = 0.0;
  scene.wall.point_m = rest + Vector3d(0.0, 0.0, 2e-3);
  ArmPlant plant(scene);
  plant.Reset(test::MidPose());
  const double at_start = plant.truth().normal_force_N;
  for (int i = 0; i < 2000; ++i) plant.Advance(VectorXd::Zero(5), true, 1e-3);
  // THEN the wall's force is the one that bends the arm by what the wall does not give.
  const double force = plant.truth().normal_force_N;
  EXPECT_NEAR(force, -1e4 * plant.truth().gap_m, 1e-6);
  EXPECT_GT(force, 5.0);
  EXPECT_NEAR(at_start, force, 0.02 * force);  // Reset found it already, but for the grip of the brakes
  EXPECT_NEAR(statics.Load({0.0, 0.0, at_start}, true).z(), scene.wall.point_m.z() - at_start / 1e4, 1e-9);
}

TEST(Wall, SlidingTipFeelsCoulombFriction) {
  PlantConfig scene;
  scene.arm = TrueOf(test::ArmA5());
  ArmPlant probe(scene);
  probe.Reset(test::MidPose());
  scene.wall = Floor();
  scene.wall.point_m = probe.truth().tip_m + Vector3d(0.0, 0.0, 1e-3);
  ArmPlant plant(scene);
  plant.Reset(test::MidPose());
  VectorXd torque = VectorXd::Zero(5);
  torque[0] = 8.0;  // about the vertical: slides along the wall
  torque[1] = 5.0;
  double most = 0.0;
  for (int i = 0; i < 200; ++i) {
    plant.Advance(torque, false, 1e-3);
    const Truth& truth = plant.truth();
    const double tangential = truth.contact_force_N.head<2>().norm();
    EXPECT_LE(tangential, 0.3 * truth.normal_force_N + 1e-9);
    if (truth.tip_velocity_mps.head<2>().norm() > 2e-3 && truth.normal_force_N > 0.1) {
      EXPECT_NEAR(tangential, 0.3 * truth.normal_force_N, 1e-9);
      EXPECT_LT(truth.contact_force_N.head<2>().dot(truth.tip_velocity_mps.head<2>()), 0.0);
      most = std::max(most, tangential);
    }
  }
  EXPECT_GT(most, 0.5);
}

TEST(Brakes, HoldWithoutCreepUnderGravity) {
  PlantConfig scene;
  scene.arm = TrueOf(test::ArmA5());
  scene.plant.damping_ratio = 0.05;
  ArmPlant plant(scene);
  plant.Reset(test::MidPose());
  for (int i = 0; i < 5000; ++i)
    plant.Advance(VectorXd::Constant(5, 30.0), true, 1e-3);  // torque is cut by the brake
  const VectorXd settled = plant.truth().motor_angle_rad;
  EXPECT_LT((settled - test::MidPose()).cwiseAbs().maxCoeff(), 1e-3);
  for (int i = 0; i < 5000; ++i) plant.Advance(VectorXd::Zero(5), true, 1e-3);
  EXPECT_LT((plant.truth().motor_angle_rad - settled).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(Brakes, StopAMovingArm) {
  PlantConfig scene;
  scene.arm = TrueOf(test::ArmA5());
  ArmPlant plant(scene);
  plant.Reset(test::MidPose());
  VectorXd torque(5);
  torque << 10.0, 15.0, 5.0, 2.0, 1.0;
  for (int i = 0; i < 200; ++i) plant.Advance(torque, false, 1e-3);
  ASSERT_GT(plant.truth().motor_speed_radps.cwiseAbs().maxCoeff(), 1.0);
  for (int i = 0; i < 400; ++i) plant.Advance(torque, true, 1e-3);
  EXPECT_LT(plant.truth().motor_speed_radps.cwiseAbs().maxCoeff(), 0.05);
}

TEST(Brake, SlipsAtItsHoldingTorqueAndSticksWhereItStopped) {
  Brake brake(1e4, 0.0, 50.0);
  brake.Close(1.0);
  EXPECT_NEAR(brake.Torque(1.002, 0.0), -20.0, 1e-9);
  EXPECT_DOUBLE_EQ(brake.Torque(1.1, 0.0), -50.0);
  brake.Follow(1.1);
  EXPECT_NEAR(brake.Torque(1.095, 0.0), 0.0, 1e-9);
}

TEST(Disturbance, IsSeededAndMadeOfItsParts) {
  DisturbanceConfig config;
  config.bias_N = {1.0, 2.0, 3.0};
  config.amplitude_N = {0.5, 0.0, 0.25};
  config.frequencies_hz = {1.0, 2.5};
  config.step_N = {0.0, 0.0, -7.0};
  config.step_s = 1.0;
  const Disturbance a(config, 7), same(config, 7), other(config, 8);
  EXPECT_EQ(a.Force(0.3, 0.3), same.Force(0.3, 0.3));
  EXPECT_GT((a.Force(0.3, 0.3) - other.Force(0.3, 0.3)).norm(), 1e-3);
  // Both sinusoids repeat after 2 s; the step is all that differs.
  EXPECT_LT((a.Force(2.3, 1.0) - a.Force(0.3, 0.3) - config.step_N).norm(), 1e-12);
  double mean = 0.0, square = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double x = a.Force(i * 1e-3 * 0.999, -1.0).x() - 1.0;
    mean += x / 1000.0;
    square += x * x / 1000.0;
  }
  EXPECT_NEAR(square, 2.0 * 0.5 * 0.25, 0.15);  // two sinusoids of amplitude 1/2
}

TEST(Disturbance, PushesTheArm) {
  PlantConfig scene;
  scene.arm = TrueOf(test::ArmA5());
  scene.disturbance.step_N = {0.0, 5.0, 0.0};
  scene.disturbance.step_s = 0.05;
  ArmPlant plant(scene);
  plant.Reset(test::MidPose());
  for (int i = 0; i < 100; ++i) plant.Advance(VectorXd::Zero(5), true, 1e-3);
  plant.StartSchedule();
  const double before = plant.truth().tip_m.y();
  for (int i = 0; i < 40; ++i) plant.Advance(VectorXd::Zero(5), true, 1e-3);
  EXPECT_NEAR(plant.truth().tip_m.y(), before, 1e-4);
  for (int i = 0; i < 500; ++i) plant.Advance(VectorXd::Zero(5), true, 1e-3);
  EXPECT_GT(plant.truth().tip_m.y(), before + 3e-4);
  EXPECT_EQ(plant.truth().contact_force_N.y(), 5.0);
  EXPECT_NEAR(plant.truth().sensed_force_N.norm(), 5.0, 1e-12) << "in the axes of the sensor";
}

TEST(Disturbance, BehindTheSensorPushesTheArmAsMuchAndIsNotSensed) {
  PlantConfig scene;
  scene.arm = TrueOf(test::ArmA5());
  scene.disturbance.bias_N = {0.0, 5.0, 0.0};
  ArmPlant in_front(scene);
  scene.disturbance.where = DisturbanceConfig::Where::kArm;
  ArmPlant behind(scene);
  for (ArmPlant* plant : {&in_front, &behind}) {
    plant->Reset(test::MidPose());
    for (int i = 0; i < 100; ++i) plant->Advance(VectorXd::Zero(5), true, 1e-3);
  }
  EXPECT_EQ(in_front.truth().tip_m, behind.truth().tip_m);
  EXPECT_EQ(in_front.truth().contact_force_N, behind.truth().contact_force_N);
  EXPECT_NEAR(in_front.truth().sensed_force_N.norm(), 5.0, 1e-12);
  EXPECT_EQ(behind.truth().sensed_force_N.norm(), 0.0);
}

}  // namespace
}  // namespace reed::plant
