// Everything the laws learn, and one robust step of it. RT: safe.
#pragma once

#include "firmware/control/known_force.h"
#include "firmware/control/robust_update.h"
#include "firmware/control/unknown_force.h"
#include "firmware/strategy/gains.h"

namespace reed::strategy {

template <int N, int P>
struct AdaptiveState {
  model::Vec<P> p_hat;                            // (34)
  model::Vec<P> eta_hat = model::Vec<P>::Zero();  // (39)
  double sigma_0 = 0.0;                           // (40)
  double sigma_1 = 0.0;                           // (41)

  explicit AdaptiveState(const model::Vec<P>& p_0) : p_hat(p_0) {}

  /// Gradient update of p̂ (34), then leak and box.
  void UpdateParameters(const Gains<N, P>& g, const model::Vec<P>& Gamma, const model::ArmModel<N, P>& arm,
                        const model::Mat<N, P>& Y, const model::Vec<N>& s, double T) noexcept {
    const model::Vec<N> s_dz = control::DeadZone(s, g.dead_zone);
    const model::Vec<P> rate = control::KnownForceUpdate<N, P>(Gamma, Y, s_dz);
    p_hat = control::RobustStep<P>(p_hat, rate, g.p_0, g.leak_p, arm.p_lo, arm.p_hi, T);
  }

  /// Gains of the sliding term (40), (41), then leak and bound.
  void UpdateSliding(const Gains<N, P>& g, const model::Vec<N>& s, double T) noexcept {
    const model::Vec<N> s_dz = control::DeadZone(s, g.dead_zone);
    sigma_0 = control::RobustStep(sigma_0, control::Sigma0Rate<N>(g.sliding.c_0, s_dz), g.leak_sigma,
                                  g.sigma0_max, T);
    sigma_1 = control::RobustStep(sigma_1, control::Sigma1Rate<N>(g.sliding.c_1, s_dz), g.leak_sigma,
                                  g.sigma1_max, T);
  }
};

}  // namespace reed::strategy
