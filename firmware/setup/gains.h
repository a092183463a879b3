// The scenario's [control] section -> the gains of the laws, and the paper's own gains for its laws. RT: set-up only.
#pragma once

#include <algorithm>
#include <array>

#include "reed/config/controller/controller_config.h"
#include "reed/core/law/gains.h"
#include "reed/core/law/law_bank.h"

namespace reed::strategy {

namespace internal {

/// Section 4.1 of the paper: K_d = 10, Λ = 5.
template <int N, int P>
void PaperFeedback(Gains<N, P>& g) {
  g.K_d.setConstant(10.0);
  g.Lambda.setConstant(5.0);
}

/// Section 4.1 of the paper: Γ = 0.05 and 0.015, ς = 0.015, η(0) = [.8 .2 .2 .8 .8 .8]. For another number
/// of parameters η(0) is the largest distance of p₀ to its box.
template <int N, int P>
void PaperAdaptation(const model::ArmModel<N, P>& arm, Gains<N, P>& g) {
  constexpr std::array<double, 6> kEta0{0.8, 0.2, 0.2, 0.8, 0.8, 0.8};
  for (int k = 0; k < arm.num_parameters; ++k) {
    g.Gamma_known[k] = 0.05;
    g.Gamma_unknown[k] = 0.015;
    g.eta_0[k] = arm.num_parameters == 6 ? kEta0[static_cast<std::size_t>(k)]
                                         : std::max(arm.p_hi[k] - g.p_0[k], g.p_0[k] - arm.p_lo[k]);
  }
  g.sliding.c_0 = g.sliding.c_1 = 0.015;
  g.sliding.scale.setOnes();
  g.subtract_observer = false;
}

template <int N, int P>
void Friction(const NominalArm& description, const ControlConfig& c, const model::ArmModel<N, P>& arm,
              Gains<N, P>& g) {
  constexpr double kBox = 0.05;      // of the torque limit, where the arm declares less
  constexpr double kDeclared = 1.5;  // of the declared friction, which wears and cools
  g.kappa_max = kBox * arm.torque_limit;
  g.kappa_0.setZero();
  if (!description.coulomb_Nm.empty())
    g.kappa_0 = Eigen::Map<const model::Vec<N>>(description.coulomb_Nm.data());
  if (!description.coulomb_declared_Nm.empty())
    g.kappa_max = g.kappa_max.cwiseMax(
        kDeclared * Eigen::Map<const model::Vec<N>>(description.coulomb_declared_Nm.data()));
  g.kappa_max = g.kappa_max.cwiseMax(g.kappa_0);  // the box holds the start
  g.Gamma_c_known = c.Gamma_friction * g.K_d;     // more damping: larger torques to adapt to
  g.Gamma_c_unknown =
      c.observer ? model::Vec<N>(model::Vec<N>::Zero()) : g.Gamma_c_known;  // else two integrators add up
  g.friction_speed = c.friction_speed_radps;
}

}  // namespace internal

template <int N, int P>
Gains<N, P> GainsFrom(const ControlConfig& c, const NominalArm& description, const model::ArmModel<N, P>& arm,
                      LawId law) {
  Gains<N, P> g;
  g.K_d = Eigen::Map<const model::Vec<N>>(c.K_d.data());
  g.Lambda = Eigen::Map<const model::Vec<N>>(c.Lambda.data());
  g.Gamma_known.setZero();
  g.Gamma_unknown.setZero();
  g.eta_0.setZero();
  g.p_0 = arm.p_nominal;
  for (int k = 0; k < arm.num_parameters; ++k) {
    g.Gamma_known[k] = c.Gamma_known;
    g.Gamma_unknown[k] = c.Gamma_unknown;
    if (!c.p_initial.empty()) g.p_0[k] = c.p_initial[static_cast<std::size_t>(k)];
  }
  g.sliding = {c.sigma0_gain, c.sigma1_gain, c.phi, g.K_d / 10.0};
  g.sigma0_max = c.sigma0_max;
  g.sigma1_max = c.sigma1_max;
  g.dead_zone = c.dead_zone_radps;
  g.leak_p = c.leak_p;
  g.leak_sigma = c.leak_sigma;
  g.K_o = c.observer_gain;
  internal::Friction(description, c, arm, g);
  g.subtract_observer = c.observer;
  const GainSet gains = LawBank<N, P>::Get(law).gains;
  if (gains != GainSet::kScenario) internal::PaperFeedback(g);
  if (gains == GainSet::kPaper) internal::PaperAdaptation(arm, g);
  return g;
}

}  // namespace reed::strategy
