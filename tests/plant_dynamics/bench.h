// Scenes that the plant's tests share.
#pragma once

#include "reed/config/schema/halves.h"
#include "reed/plant/dynamics/arm_plant.h"
#include "reed/tests/support/arms.h"

namespace reed::test {

/// a5 without friction and damping.
inline PlantConfig LosslessA5() {
  PlantConfig scene;
  scene.arm = TrueOf(ArmA5());
  scene.plant.friction_scale = 0.0;
  scene.plant.damping_ratio = 0.0;
  return scene;
}

inline Eigen::VectorXd MidPose() {
  Eigen::VectorXd q(5);
  q << 0.2, 0.6, -0.9, 0.5, 0.3;
  return q;
}

inline double TotalEnergy(const plant::Truth& truth) {
  return truth.kinetic_J + truth.elastic_J + truth.potential_J;
}

}  // namespace reed::test
