// The scenario's [control] section in fixed-size vectors. Built at set-up.
#pragma once

#include "config/schema/scenario.h"
#include "firmware/control/robust_update.h"
#include "firmware/control/unknown_force.h"
#include "firmware/model/arm_model.h"

namespace reed::strategy {

template <int N, int P>
struct Gains {
  model::Vec<N> K_d, Lambda;
  model::Vec<P> Gamma_known, Gamma_unknown;  // per parameter, in units of its box: box² × gain
  model::Vec<P> p_0;
  control::SlidingGains<N> sliding;
  double sigma0_max, sigma1_max;
  double dead_zone, leak_p, leak_sigma;
  double K_o;

  explicit Gains(const ControlConfig& c, const model::ArmModel<N, P>& arm) {
    K_d = Eigen::Map<const model::Vec<N>>(c.K_d.data());
    Lambda = Eigen::Map<const model::Vec<N>>(c.Lambda.data());
    Gamma_known.setZero();
    Gamma_unknown.setZero();
    p_0 = arm.p_nominal;
    for (int k = 0; k < arm.num_parameters; ++k) {
      Gamma_known[k] = c.Gamma_known;
      Gamma_unknown[k] = c.Gamma_unknown;
      if (!c.p_initial.empty()) p_0[k] = c.p_initial[static_cast<std::size_t>(k)];
    }
    sliding = {c.sigma0_gain, c.sigma1_gain, c.phi, K_d / 10.0};
    sigma0_max = c.sigma0_max;
    sigma1_max = c.sigma1_max;
    dead_zone = c.dead_zone_radps;
    leak_p = c.leak_p;
    leak_sigma = c.leak_sigma;
    K_o = c.observer_gain;
  }
};

}  // namespace reed::strategy
