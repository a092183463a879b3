// Limits for an arm near people: how fast its tool point is, what power its motors give to it, and what energy it has. RT: safe.
//
//   |J_v θ̇| <= tip_speed      m/s
//   Σ τ_i θ̇_i <= power        W, of what the drives report
//   ½ pᵀ θ̇ <= energy          J, of arm and rotors by the model
//
// 0: no limit.
#pragma once

#include "reed/core/measurement.h"
#include "reed/core/safety/limits.h"

namespace reed::protect {

struct PeopleLimitValues {
  double tip_speed = 0.0;  // m/s
  double power = 0.0;      // W
  double energy = 0.0;     // J
};

template <int N>
LimitCheck CheckNearPeople(const PeopleLimitValues& limit, const Measurement<N>& measured,
                           const Eigen::Matrix<double, 6, N>& J, double energy) noexcept {
  if (limit.tip_speed > 0.0) {
    const double speed = (J.template topRows<3>() * measured.theta_dot).norm();
    if (!(speed <= limit.tip_speed)) return {Reason::kTipSpeed, -1, speed, 0};
  }
  if (limit.power > 0.0) {
    const double power = measured.torque.dot(measured.theta_dot);
    if (!(power <= limit.power)) return {Reason::kPower, -1, power, 0};
  }
  if (limit.energy > 0.0 && !(energy <= limit.energy)) return {Reason::kEnergy, -1, energy, 0};
  return {};
}

}  // namespace reed::protect
