// A force on the tool point: bias, sinusoids with seeded phases, one step. World frame.
// RT: safe after construction.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "reed/config/plant/plant_config.h"

namespace reed::plant {

class Disturbance {
 public:
  Disturbance(const DisturbanceConfig& config, std::int64_t seed);
  /// N. schedule_s: what the step counts, negative before it begins to.
  Eigen::Vector3d Force(double t_s, double schedule_s) const;
  /// It acts in front of the wrist sensor.
  bool sensed() const { return config_.where == DisturbanceConfig::Where::kTool; }

 private:
  struct Sinusoid {
    double angular_frequency;
    Eigen::Vector3d phase;  // one per axis
  };
  DisturbanceConfig config_;
  std::vector<Sinusoid> sinusoids_;
};

}  // namespace reed::plant
