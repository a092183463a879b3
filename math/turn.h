// Rotations from angles and back, by the functions of this room. RT: safe.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "reed/math/plane.h"
#include "reed/math/sine.h"

namespace reed::math {

/// About x, angle in rad.
inline Eigen::Matrix3d TurnX(double angle) noexcept {
  const auto [s, c] = SinCos(angle);
  Eigen::Matrix3d R;
  R << 1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c;
  return R;
}

/// About y.
inline Eigen::Matrix3d TurnY(double angle) noexcept {
  const auto [s, c] = SinCos(angle);
  Eigen::Matrix3d R;
  R << c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c;
  return R;
}

/// About z.
inline Eigen::Matrix3d TurnZ(double angle) noexcept {
  const auto [s, c] = SinCos(angle);
  Eigen::Matrix3d R;
  R << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return R;
}

/// Axis times angle, angle in [0, pi].
inline Eigen::Vector3d RotationVector(const Eigen::Matrix3d& R) noexcept {
  const Eigen::Quaterniond q(R);
  const double sine = q.vec().norm();  // of half the angle
  if (sine == 0.0) return Eigen::Vector3d::Zero();
  const double angle = 2.0 * Atan2(sine, std::abs(q.w()));
  return (q.w() < 0.0 ? -angle : angle) / sine * q.vec();
}

}  // namespace reed::math
