#include "reed/plant/sensor/wrench_sensor.h"

#include <algorithm>
#include <cmath>

namespace reed::plant {
namespace {

double Quantize(double value, double quantum) noexcept {
  return quantum > 0.0 ? std::nearbyint(value / quantum) * quantum : value;
}

}  // namespace

WrenchSensor::WrenchSensor(const SensorConfig& config, std::int64_t seed)
    : config_(config),
      seed_(seed),
      force_noise_(seed, stream::kForce),
      moment_noise_(seed, stream::kMoment) {}

void WrenchSensor::Reset() {
  force_noise_ = RandomStream(seed_, stream::kForce);
  moment_noise_ = RandomStream(seed_, stream::kMoment);
}

WrenchReading WrenchSensor::Measure(const Eigen::Vector3d& force_N,
                                    const Eigen::Vector3d& moment_Nm) noexcept {
  WrenchReading reading;
  for (int axis = 0; axis < 3; ++axis) {
    const double raw_N =
        force_N[axis] + config_.force_bias_N[axis] + config_.force_noise_N * force_noise_.Normal();
    const double rounded_N = Quantize(raw_N, config_.force_quantum_N);
    reading.force_N[axis] = std::clamp(rounded_N, -config_.force_range_N, config_.force_range_N);
    reading.saturated |= std::abs(rounded_N) > config_.force_range_N;

    const double raw_Nm =
        moment_Nm[axis] + config_.moment_bias_Nm[axis] + config_.moment_noise_Nm * moment_noise_.Normal();
    const double rounded_Nm = Quantize(raw_Nm, config_.moment_quantum_Nm);
    reading.moment_Nm[axis] = std::clamp(rounded_Nm, -config_.moment_range_Nm, config_.moment_range_Nm);
    reading.saturated |= std::abs(rounded_Nm) > config_.moment_range_Nm;
  }
  return reading;
}

}  // namespace reed::plant
