// All adaptive states of the laws, and one step of them: robust for the robust law, plain for the paper's. RT: safe.
#pragma once

#include "reed/core/law/friction.h"
#include "reed/core/law/gains.h"
#include "reed/core/law/known_force.h"
#include "reed/core/law/robust_update.h"
#include "reed/core/law/unknown_force.h"

namespace reed::strategy {

template <int N, int P>
struct AdaptiveState {
  model::Vec<P> p_hat;      // (34)
  model::Vec<P> eta_hat;    // (39)
  double sigma_0 = 0.0;     // (40)
  double sigma_1 = 0.0;     // (41)
  model::Vec<N> kappa_hat;  // (49)

  explicit AdaptiveState(const Gains<N, P>& g) : p_hat(g.p_0), eta_hat(g.eta_0), kappa_hat(g.kappa_0) {}

  // s_dz: s beyond the dead zone.

  /// Gradient update of p̂ (34), then leak and box.
  void UpdateParameters(const Gains<N, P>& g, const model::Vec<P>& Gamma, const model::ArmModel<N, P>& arm,
                        const model::Mat<N, P>& Y, const model::Vec<N>& s_dz, double T) noexcept {
    const model::Vec<P> rate = control::KnownForceUpdate<N, P>(Gamma, Y, s_dz);
    p_hat = control::RobustStep<P>(p_hat, rate, g.p_0, g.leak_p, arm.p_lo, arm.p_hi, T);
  }

  /// Gains of the sliding term (40), (41), then leak and bound.
  void UpdateSliding(const Gains<N, P>& g, const model::Vec<N>& s_dz, double T) noexcept {
    sigma_0 = control::RobustStep(sigma_0, control::Sigma0Rate<N>(g.sliding.c_0, s_dz), g.leak_sigma,
                                  g.sigma0_max, T);
    sigma_1 = control::RobustStep(sigma_1, control::Sigma1Rate<N>(g.sliding.c_1, s_dz), g.leak_sigma,
                                  g.sigma1_max, T);
  }

  /// Coulomb friction (49), then leak toward what was known and box.
  void UpdateFriction(const Gains<N, P>& g, const model::Vec<N>& Gamma_c, const model::Vec<N>& v,
                      const model::Vec<N>& s_dz, double T) noexcept {
    const model::Vec<N> rate = control::CoulombUpdate<N>(Gamma_c, v, g.friction_speed, s_dz);
    const model::Vec<N> none = model::Vec<N>::Zero();
    kappa_hat = control::RobustStep<N>(kappa_hat, rate, g.kappa_0, g.leak_p, none, g.kappa_max, T);
  }
};

}  // namespace reed::strategy
