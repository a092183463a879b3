// A compliant half-space that the tool point may press on.
//   normal    f = max(0, k δ + d δ') for a penetration δ > 0: a spring-damper that never pulls
//   friction  -μ f s(|v_t|/v_s) v_t/|v_t|, Coulomb, smoothed around rest: s(x) = x (2 - x) below 1 and 1 above
// E_p of the wall: 1/2 k δ². Forces act on the robot. n points from the wall to the robot. World frame.
// RT: safe.
#pragma once

#include <Eigen/Core>

#include "reed/config/plant/plant_config.h"

namespace reed::plant {

class Wall {
 public:
  struct Contact {
    double gap = 1e9;                                     // m, negative: penetration
    double normal_force = 0.0;                            // N
    Eigen::Vector3d force = Eigen::Vector3d::Zero();      // N, on the robot
    Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();  // -∂force/∂position
    Eigen::Matrix3d damping = Eigen::Matrix3d::Zero();    // -∂force/∂velocity, friction by its chord
  };

  explicit Wall(const WallConfig& config);

  Contact Touch(const Eigen::Vector3d& point, const Eigen::Vector3d& velocity) const;

 private:
  bool present_;
  Eigen::Vector3d normal_, surface_;
  double stiffness_, damping_, friction_, friction_speed_;
};

}  // namespace reed::plant
