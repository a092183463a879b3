// Seeded states and arms for the tests of the model.
#pragma once

#include <random>

#include "reed/tests/support/arms.h"
#include "reed/tests/support/model_arm.h"

namespace reed::test {

using model::Vec;

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double Number(double range) { return std::uniform_real_distribution<double>(-range, range)(engine_); }
  template <int N>
  Vec<N> Vector(double range) {
    Vec<N> x;
    for (int i = 0; i < N; ++i) x(i) = Number(range);
    return x;
  }

 private:
  std::mt19937 engine_;
};

/// Six joints with odd twists, links that have both d and a, a negative length, a link without any, a shifted
/// tool, gravity that is not vertical, and parameters that share bodies.
inline ArmDescription SkewArm() {
  ArmDescription arm;
  arm.name = "skew6";
  arm.joints = JointsOf({{0.3, 0.0, 0.25},
                         {-1.2, 0.1, -0.05},
                         {0.7, 0.3, 0.0},
                         {1.5, -0.08, 0.28},
                         {-0.9, 0.0, 0.0},
                         {0.4, 0.0, 0.1}});
  arm.gravity_mps2 = Vector3d(1.0, -2.0, -9.5);
  arm.tool.xyz_m = Vector3d(0.02, -0.03, 0.11);
  for (int i = 0; i < 6; ++i) {
    const double m = 2.5 - 0.35 * i;
    arm.bodies.push_back({m, Vector3d(0.02 * i, -0.03, 0.05 - 0.01 * i),
                          m * Symmetric(0.004, 0.0003, -0.0002, 0.005, 0.0004, 0.0035)});
    arm.joint_stiffness_Nmprad.push_back(9000.0 - 1000.0 * i);
    arm.rotor_inertia_kgm2.push_back(0.2 - 0.02 * i);
  }
  for (const double length : {0.25, 0.1, 0.05, 0.3, 0.08, 0.28, 0.1}) {
    arm.sections.push_back({length, 1.0e7, 900.0, 700.0, 0.4});
  }
  const InertialBody rod{1.0, Vector3d(0.03, 0.01, 0.02), Symmetric(0.002, 0.0, 0.0001, 0.003, 0.0, 0.002)};
  arm.parameters.push_back({"two links", 0.4, 0.2, 0.0, 1.0, {{1, rod}, {4, rod}}, {}});
  arm.parameters.push_back({"friction", 0.2, 0.1, 0.0, 1.0, {}, {1.0, 0.9, 0.8, 0.7, 0.6, 0.5}});
  arm.parameters.push_back(
      {"load and its seal", 0.6, 0.0, 0.0, 1.0, {{5, rod}}, {0.0, 0.0, 0.0, 0.0, 0.0, 0.3}});
  return arm;
}

}  // namespace reed::test
