// Fixed-axis angles as URDF files state them. RT: set-up only.
#pragma once

#include <Eigen/Core>

#include "reed/math/sine.h"

namespace reed {

/// R = Rz(yaw) Ry(pitch) Rx(roll). Where angles are zero their sines and cosines leave no rounding.
inline Eigen::Matrix3d RollPitchYaw(const Eigen::Vector3d& rpy_rad) {
  const auto [s_r, c_r] = math::SinCos(rpy_rad.x());
  const auto [s_p, c_p] = math::SinCos(rpy_rad.y());
  const auto [s_y, c_y] = math::SinCos(rpy_rad.z());
  Eigen::Matrix3d R;
  // clang-format off
  R << c_y * c_p, c_y * s_p * s_r - s_y * c_r, c_y * s_p * c_r + s_y * s_r,
       s_y * c_p, s_y * s_p * s_r + c_y * c_r, s_y * s_p * c_r - c_y * s_r,
            -s_p,                   c_p * s_r,                   c_p * c_r;
  // clang-format on
  return R;
}

}  // namespace reed
