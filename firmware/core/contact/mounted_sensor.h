// The force sensor as it is mounted: it turns with the last link, and the tool behind it hangs on it. RT: safe.
//
//   F_s = R_sᵀ (F + m g) + zero
//   M_s = R_sᵀ M + r_t x R_sᵀ F + c x R_sᵀ m g + zero      about the origin of the sensor
//
// F, M: environment on the tool, about the tool point r_t, world axes. m, c: mass and centre of mass of the tool, known.
// The tool's inertia force is no part of this: it is what the arm's own motion adds to the reading.
#pragma once

#include "reed/core/model/kinematics.h"

namespace reed::strategy {

/// What the sensor reads but for the tool's weight, and the wall's normal, both in the sensor's axes.
struct SensorReading {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // N, R_sᵀ F + zero
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

class MountedSensor {
 public:
  /// For the pose of `kin`.
  template <int N, int P>
  void Turn(const model::ArmModel<N, P>& arm, const model::Kinematics<N>& kin) noexcept {
    R_ = kin.R_last() * arm.sensor_rotation;
    to_tool_ = arm.sensor_to_tool;
    weight_.F = R_.transpose() * (arm.sensor_tool_mass * arm.gravity);
    weight_.n = arm.sensor_tool_com.cross(weight_.F);
  }

  /// as_read: about the origin of the sensor, its axes.
  model::Wrench WithoutWeight(const model::Wrench& as_read) const noexcept {
    return {as_read.F - weight_.F, as_read.n - weight_.n};
  }
  SensorReading Read(const Eigen::Vector3d& force, const Eigen::Vector3d& normal) const noexcept {
    return {force - weight_.F, R_.transpose() * normal};
  }

  /// tared: without weight and zero. The same about the tool point, world axes.
  model::Wrench AtTool(const model::Wrench& tared) const noexcept {
    return {R_ * tared.F, R_ * (tared.n - to_tool_.cross(tared.F))};
  }

 private:
  Eigen::Matrix3d R_ = Eigen::Matrix3d::Identity();    // columns: the sensor's axes, in the world
  Eigen::Vector3d to_tool_ = Eigen::Vector3d::Zero();  // r_t, m, sensor's frame
  model::Wrench weight_;  // of the tool, about the origin of the sensor, its axes
};

}  // namespace reed::strategy
