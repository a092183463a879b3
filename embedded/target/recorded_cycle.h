// What the controller saw in one cycle of a recorded run, in plain numbers.
#pragma once

#include <cstdint>

#include "reed/core/measurement.h"
#include "reed/embedded/settings_image.h"

namespace reed::embedded {

struct RecordedCycle {
  double theta[N], theta_dot[N], torque[N];  // rad, rad/s, N·m
  double force[3], moment[3];                // N, N·m
  std::int32_t age[N], drive[N], wrench_age;
};

inline Measurement<N> MeasurementFrom(const RecordedCycle& r) noexcept {
  using Vec = Eigen::Map<const Eigen::Matrix<double, N, 1>>;
  Measurement<N> m;
  m.theta = Vec(r.theta);
  m.theta_dot = Vec(r.theta_dot);
  m.torque = Vec(r.torque);
  m.force = Eigen::Map<const Eigen::Vector3d>(r.force);
  m.moment = Eigen::Map<const Eigen::Vector3d>(r.moment);
  m.wrench_age = r.wrench_age;
  for (std::size_t i = 0; i < static_cast<std::size_t>(N); ++i) {
    m.age[i] = r.age[i];
    m.drive[i] = static_cast<DriveState>(r.drive[i]);
  }
  return m;
}

}  // namespace reed::embedded
