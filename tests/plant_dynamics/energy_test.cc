// (16)-(21): what goes in comes out, and nothing is lost or won on the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reed/tests/plant_dynamics/bench.h"

namespace reed::plant {
namespace {

using Eigen::VectorXd;

TEST(Energy, FreeFlexibleArmKeepsItsEnergyForTenSeconds) {
  PlantConfig scene = test::LosslessA5();
  scene.plant.max_step_s = 20e-6;
  ArmPlant plant(scene);
  plant.Reset(test::MidPose());
  const double start = test::TotalEnergy(plant.truth());
  const VectorXd no_torque = VectorXd::Zero(5);
  double exchanged = 0.0, drift = 0.0;
  for (int i = 0; i < 1000; ++i) {
    plant.Advance(no_torque, false, 10e-3);
    exchanged = std::max(exchanged, plant.truth().kinetic_J);
    drift = std::max(drift, std::abs(test::TotalEnergy(plant.truth()) - start));
  }
  EXPECT_GT(exchanged, 5.0);  // J: the arm falls and swings through
  EXPECT_LT(drift, 1e-6 * exchanged);
}

TEST(Energy, MotorPowerBecomesEnergyOfTheArm) {
  PlantConfig scene = test::LosslessA5();
  scene.plant.max_step_s = 20e-6;
  ArmPlant plant(scene);
  plant.Reset(test::MidPose());
  const double start = test::TotalEnergy(plant.truth());
  double work = 0.0, dt = 20e-6, peak = 0.0;
  VectorXd torque(5);
  for (int i = 0; i < 25000; ++i) {
    const double t = i * dt;
    torque << 4.0 * std::sin(9.0 * t), 12.0 * std::cos(5.0 * t), -3.0, 1.0 * std::sin(20.0 * t), 0.3;
    const VectorXd angle = plant.truth().motor_angle_rad;
    plant.Advance(torque, false, dt);
    work += torque.dot(plant.truth().motor_angle_rad - angle);
    peak = std::max(peak, std::abs(work));
  }
  EXPECT_GT(peak, 1.0);
  EXPECT_NEAR(test::TotalEnergy(plant.truth()) - start, work, 2e-6 * peak);
}

TEST(Energy, ViscousFrictionTakesItsPower) {
  PlantConfig scene = test::LosslessA5();
  scene.plant.friction_scale = 1.0;
  scene.arm.coulomb_Nm.clear();
  scene.plant.max_step_s = 20e-6;
  ArmPlant plant(scene);
  plant.Reset(test::MidPose());
  const double start = test::TotalEnergy(plant.truth());
  const VectorXd viscous =
      0.12 * (VectorXd(5) << 1.0, 1.0, 0.8, 0.5, 0.3).finished();  // bv times its weights
  double lost = 0.0;
  const auto power = [&] { return plant.truth().motor_speed_radps.cwiseAbs2().dot(viscous); };
  for (int i = 0; i < 50000; ++i) {
    const double before = power();
    plant.Advance(VectorXd::Zero(5), false, 20e-6);
    lost += 0.5 * 20e-6 * (before + power());
  }
  EXPECT_GT(lost, 0.1);
  EXPECT_NEAR(start - test::TotalEnergy(plant.truth()), lost, 1e-5 * lost);
}

TEST(Energy, StructuralDampingOnlyTakesEnergy) {
  PlantConfig scene = test::LosslessA5();
  scene.plant.damping_ratio = 0.02;
  scene.plant.max_step_s = 50e-6;
  ArmPlant plant(scene);
  plant.Reset(test::MidPose());
  double last = test::TotalEnergy(plant.truth());
  const double start = last;
  for (int i = 0; i < 1000; ++i) {
    plant.Advance(VectorXd::Zero(5), false, 1e-3);
    EXPECT_LT(test::TotalEnergy(plant.truth()), last + 1e-9);
    last = test::TotalEnergy(plant.truth());
  }
  EXPECT_LT(last, start - 1e-4);
}

}  // namespace
}  // namespace reed::plant
