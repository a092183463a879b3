#include "reed/plant/dynamics/wall.h"

#include <algorithm>

namespace reed::plant {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Wall::Wall(const WallConfig& config)
    : present_(config.present),
      normal_(config.normal.normalized()),
      surface_(config.point_m + config.offset_m * normal_),
      stiffness_(config.stiffness_Npm),
      damping_(config.damping_Nspm),
      friction_(config.friction),
      friction_speed_(config.friction_speed_mps) {}

Wall::Contact Wall::Touch(const Vector3d& point, const Vector3d& velocity) const {
  Contact contact;
  if (!present_) return contact;
  contact.gap = normal_.dot(point - surface_);
  if (contact.gap >= 0.0) return contact;

  const double normal_speed = normal_.dot(velocity);
  contact.normal_force = std::max(0.0, -stiffness_ * contact.gap - damping_ * normal_speed);
  if (contact.normal_force == 0.0) return contact;
  const Matrix3d nn = normal_ * normal_.transpose();
  contact.stiffness = stiffness_ * nn;
  contact.damping = damping_ * nn;

  const Vector3d slip = velocity - normal_speed * normal_;
  const double x = slip.norm() / friction_speed_;
  const double chord =
      friction_ * contact.normal_force / friction_speed_ * (x < 1.0 ? 2.0 - x : 1.0 / x);  // N·s/m
  contact.force = contact.normal_force * normal_ - chord * slip;
  contact.damping += chord * (Matrix3d::Identity() - nn);
  return contact;
}

}  // namespace reed::plant
