#include "reed/plant/drive/torque_excitation.h"

#include <numbers>

#include "reed/math/sine.h"

namespace reed::plant {

TorqueExcitation::TorqueExcitation(const DriveConfig& config)
    : joint_(config.excitation_joint - 1), amplitude_Nm_(config.excitation_Nm) {
  const auto K = static_cast<double>(config.excitation_hz.size());
  double k = 1.0;
  for (const double f : config.excitation_hz) {
    lines_.push_back({2.0 * std::numbers::pi * f, -std::numbers::pi * k * (k - 1.0) / K});
    k += 1.0;
  }
}

double TorqueExcitation::At(double time_s) const noexcept {
  double sum = 0.0;
  for (const Line& line : lines_) sum += math::Cos(line.omega_radps * time_s + line.phase_rad);
  return amplitude_Nm_ * sum;
}

}  // namespace reed::plant
