#include "reed/plant/dynamics/disturbance.h"

#include <numbers>
#include <random>

#include "reed/math/sine.h"

namespace reed::plant {

Disturbance::Disturbance(const DisturbanceConfig& config, std::int64_t seed) : config_(config) {
  std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
  // Not std::uniform_real_distribution: its result is the library's choice, and equal seeds must mean equal
  // runs.
  const auto phase = [&engine] {
    return 2.0 * std::numbers::pi * static_cast<double>(engine() >> 11) * 0x1p-53;
  };
  for (const double hz : config.frequencies_hz) {
    Sinusoid sinusoid{2.0 * std::numbers::pi * hz, Eigen::Vector3d::Zero()};
    for (double& angle : sinusoid.phase) angle = phase();
    sinusoids_.push_back(sinusoid);
  }
}

Eigen::Vector3d Disturbance::Force(double t_s, double schedule_s) const {
  Eigen::Vector3d force = config_.bias_N;
  for (const Sinusoid& s : sinusoids_) {
    for (int axis = 0; axis < 3; ++axis)
      force[axis] += config_.amplitude_N[axis] * math::Sin(s.angular_frequency * t_s + s.phase[axis]);
  }
  if (config_.step_s >= 0.0 && schedule_s >= config_.step_s) force += config_.step_N;
  return force;
}

}  // namespace reed::plant
