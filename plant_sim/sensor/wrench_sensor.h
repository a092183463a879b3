// Wrist wrench in the sensor's own axes: from what it feels to what it says. RT: safe.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "reed/config/plant/plant_config.h"
#include "reed/plant/sensor/random_stream.h"

namespace reed::plant {

struct WrenchReading {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_Nm = Eigen::Vector3d::Zero();
  bool saturated = false;  // an axis is at the end of its range
};

class WrenchSensor {
 public:
  WrenchSensor(const SensorConfig& config, std::int64_t seed);

  /// As after power-up with the same seed: the noise starts over.
  void Reset();

  /// truth + bias + noise, rounded to the quantum, then clamped to the range.
  WrenchReading Measure(const Eigen::Vector3d& force_N, const Eigen::Vector3d& moment_Nm) noexcept;

  bool fitted() const noexcept { return config_.wrench; }

 private:
  SensorConfig config_;
  std::int64_t seed_;
  RandomStream force_noise_;
  RandomStream moment_noise_;
};

}  // namespace reed::plant
