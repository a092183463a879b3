// The control core on its own: codec, supervisor, kinematics, nodal compensation, regressor, both laws,
// adaptation rates, observer and the last gate, for the five-joint arm. No heap, no exceptions, no RTTI, no
// operating system: the same headers as the firmware's cycle, compiled for a Cortex-M7 and for the host.
#pragma once

#include <array>

#include "reed/bus/codec/messages.h"
#include "reed/core/estimate/observer.h"
#include "reed/core/model/arm_model.h"
#include "reed/core/safety/limits.h"
#include "reed/core/safety/supervisor.h"

namespace reed::embedded {

inline constexpr int N = 5, P = 7;
using Arm = model::ArmModel<N, P>;
using Vec = model::Vec<N>;

/// One reference case, plain doubles in the order of the generator (generate_cases.py).
struct Case {
  double q[N], dq[N], q_d[N], dq_d[N], ddq_d[N];
  double p_hat[6], eta_hat[6];
  double F_d, sigma_0, sigma_1, e_f, int_e_f, k_p, k_i;
};

/// What a step makes of it, plain doubles in this order.
struct Result {
  double J[6 * N];  // by columns
  double v[N], s[N];
  double Y[6 * N];  // by columns, one per parameter
  double U_known[N], U_unknown[N];
  double p_rate[6], eta_rate[6], sigma_0_rate, sigma_1_rate;
  double D[N], v_force[N];
  double nodal[N];     // offset of (22) under F_d
  double observed[N];  // r after one step
  double torque[N];    // as the command frame carries it, after codec, supervisor and limits
};

class Core {
 public:
  explicit Core(const Arm& arm) noexcept;
  void Step(const Case& in, Result& out) noexcept;

 private:
  Vec ThroughTheBus(const Vec& tau, const Case& in) noexcept;

  const Arm& arm_;
  control::MomentumObserver<N> observer_;
  mode::Supervisor supervisor_;
  protect::Limits<N> limits_;
  bus::Encoder encoder_;
  bus::Decoder decoder_;
};

}  // namespace reed::embedded
