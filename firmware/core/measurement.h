// The measurements of one cycle: every value with its age. Plain data, SI. RT: safe.
#pragma once

#include <Eigen/Core>
#include <array>

#include "reed/core/safety/drive_state.h"

namespace reed {

template <int N>
struct Measurement {
  Eigen::Matrix<double, N, 1> theta = Eigen::Matrix<double, N, 1>::Zero();      // rad, motor side
  Eigen::Matrix<double, N, 1> theta_dot = Eigen::Matrix<double, N, 1>::Zero();  // rad/s, motor side
  Eigen::Matrix<double, N, 1> torque = Eigen::Matrix<double, N, 1>::Zero();     // N·m, applied by the drives
  std::array<DriveState, static_cast<std::size_t>(N)> drive{};
  std::array<int, static_cast<std::size_t>(N)> age{};  // cycles, 0: of this cycle
  Eigen::Vector3d force =
      Eigen::Vector3d::Zero();  // N, of environment and tool weight on the tool, sensor's axes
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N·m, about the sensor's origin
  bool wrench_saturated = false;                     // an axis is at the end of the sensor's range
  int wrench_age = kNever;                           // cycles
  bool foreign_controller = false;                   // somebody else sends SYNC or COMMAND
  int unexpected_joint = -1;  // 0-based, of a state frame for a joint that the arm does not have

  static constexpr int kNever = 1'000'000;  // ages stop here

  int OldestJoint() const noexcept {
    int oldest = 0;
    for (int i = 1; i < N; ++i)
      if (age[static_cast<std::size_t>(i)] > age[static_cast<std::size_t>(oldest)]) oldest = i;
    return oldest;
  }
  int OldestAge() const noexcept { return age[static_cast<std::size_t>(OldestJoint())]; }
  int YoungestAge() const noexcept {
    int youngest = kNever;
    for (const int a : age) youngest = a < youngest ? a : youngest;
    return youngest;
  }
  bool AllDrives(DriveState state) const noexcept {
    for (const DriveState s : drive)
      if (s != state) return false;
    return true;
  }
  bool AnyDrive(DriveState state) const noexcept {
    for (const DriveState s : drive)
      if (s == state) return true;
    return false;
  }
};

}  // namespace reed
