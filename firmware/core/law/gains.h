// Every gain of the laws, in fixed-size vectors. RT: reading is safe.
#pragma once

#include "reed/core/law/robust_update.h"
#include "reed/core/law/unknown_force.h"
#include "reed/core/model/arm_model.h"

namespace reed::strategy {

template <int N, int P>
struct Gains {
  model::Vec<N> K_d, Lambda;
  model::Vec<P> Gamma_known, Gamma_unknown;
  model::Vec<P> p_0, eta_0;
  control::SlidingGains<N> sliding;
  double sigma0_max, sigma1_max;
  double dead_zone, leak_p, leak_sigma;
  double K_o;
  model::Vec<N> Gamma_c_known, Gamma_c_unknown, kappa_0, kappa_max;  // Coulomb friction (48), (49)
  double friction_speed;                                             // v_s, rad/s
  bool subtract_observer;
};

}  // namespace reed::strategy
