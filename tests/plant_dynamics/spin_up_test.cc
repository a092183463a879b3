// Geometric stiffening: the spin-up of a flexible beam from the literature (Kane, Ryan and Banerjee; Simo and
// Vu-Quoc).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reed/tests/plant_dynamics/bench.h"

namespace reed::plant {
namespace {

constexpr double kLength = 10.0;          // m
constexpr double kRhoA = 1.2;             // kg/m
constexpr double kImmovableRotor = 1e14;  // kg·m²: turns exactly as its torque says

/// A beam on a turntable. The second joint, at the tip, carries nothing; it is there because an arm's member
/// along x belongs to the row that follows it.
PlantConfig Turntable(int elements) {
  PlantConfig scene;
  scene.arm.name = "turntable";
  scene.arm.gravity_mps2.setZero();
  scene.arm.joints = JointsOf({{0.0, 0.0, 0.0}, {0.0, kLength, 0.0}});
  const double mass = kRhoA * kLength, inertia = mass * kLength * kLength / 12.0;
  scene.arm.bodies = {{mass, {0.5 * kLength, 0.0, 0.0}, Eigen::Vector3d(0.0, inertia, inertia).asDiagonal()},
                      {}};
  scene.arm.rotor_inertia_kgm2 = {kImmovableRotor, 1.0};
  scene.arm.joint_stiffness_Nmprad = {1e9, 1e3};
  scene.arm.sections = {{kLength, 2.8e7, 1.4e4, 1.4e4, kRhoA}};
  scene.plant.damping_ratio = 0.0;
  scene.plant.elements_per_link = elements;
  scene.plant.max_step_s = 2e-3;
  return scene;
}

/// d²/dt² of 6/15 [t²/2 + (15/2π)² (cos(2πt/15) - 1)], then of 6t - 45.
double Acceleration(double t) {
  return t < 15.0 ? 0.4 * (1.0 - std::cos(2.0 * std::numbers::pi * t / 15.0)) : 0.0;
}

class SpinUpTest : public testing::TestWithParam<int> {};

TEST_P(SpinUpTest, TipLagsAsInTheLiteratureAndComesBack) {
  ArmPlant plant(Turntable(GetParam()));
  plant.Reset(Eigen::VectorXd::Zero(2));
  const double dt = 4e-3;
  double largest = 0.0, at = 0.0, residual = 0.0;
  for (double t = 0.0; t < 20.0 - 0.5 * dt; t += dt) {
    Eigen::VectorXd torque(2);
    torque << kImmovableRotor * Acceleration(t + 0.5 * dt), 0.0;
    plant.Advance(torque, false, dt);
    const double angle = plant.truth().motor_angle_rad[0];
    const Eigen::Vector3d across(-std::sin(angle), std::cos(angle), 0.0);
    const double lag = -across.dot(plant.truth().tip_m);
    if (lag > largest) {
      largest = lag;
      at = t + dt;
    }
    if (t > 16.0) residual = std::max(residual, std::abs(lag));
  }
  const double angle_end = 6.0 * 20.0 - 45.0;
  EXPECT_NEAR(plant.truth().motor_angle_rad[0], angle_end, 1e-4);
  EXPECT_NEAR(largest, 0.574, 0.01 * 0.574);
  EXPECT_NEAR(at, 6.8, 0.3);
  EXPECT_LT(residual, 4e-3);
  EXPECT_GT(residual, 1e-5);  // an undamped beam does keep swinging
}

INSTANTIATE_TEST_SUITE_P(Elements, SpinUpTest, testing::Values(1, 2, 4));

}  // namespace
}  // namespace reed::plant
