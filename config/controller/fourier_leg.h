// A leg that is a Fourier series of the joint angles, one row of coefficients per harmonic k = 1, 2, …:
//   θ(t) = θ(0) + Σ_k [ s_k sin(k ω t) + c_k (cos(k ω t) − 1) ],   ω = 2π frequency_hz
// RT: set-up only.
#pragma once

#include <numbers>

#include "reed/config/controller/controller_config.h"
#include "reed/math/sine.h"

namespace reed {

/// θ(t) − θ(0) of one joint, rad.
inline double FourierOffset(const ReferenceLeg& leg, std::size_t joint, double t_s) {
  const double turn = 2.0 * std::numbers::pi * leg.frequency_hz * t_s;
  double offset = 0.0;
  for (std::size_t k = 0; k < leg.sine_rad.size(); ++k)
    offset += leg.sine_rad[k][joint] * math::Sin(static_cast<double>(k + 1) * turn);
  for (std::size_t k = 0; k < leg.cosine_rad.size(); ++k)
    offset += leg.cosine_rad[k][joint] * (math::Cos(static_cast<double>(k + 1) * turn) - 1.0);
  return offset;
}

struct FourierStart {
  double speed_radps, acceleration_radps2;
};

/// Of one joint, where every period begins.
inline FourierStart StartOf(const ReferenceLeg& leg, std::size_t joint) {
  const double omega = 2.0 * std::numbers::pi * leg.frequency_hz;
  FourierStart start{0.0, 0.0};
  for (std::size_t k = 0; k < leg.sine_rad.size(); ++k)
    start.speed_radps += static_cast<double>(k + 1) * omega * leg.sine_rad[k][joint];
  for (std::size_t k = 0; k < leg.cosine_rad.size(); ++k) {
    const double harmonic = static_cast<double>(k + 1) * omega;
    start.acceleration_radps2 -= harmonic * harmonic * leg.cosine_rad[k][joint];
  }
  return start;
}

}  // namespace reed
