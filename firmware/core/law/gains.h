// The scenario's [control] section in fixed-size vectors, and the paper's own gains for its laws. Built at
// set-up.
#pragma once

#include "reed/config/controller/controller_config.h"
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

  Gains(const ControllerConfig& scenario, const model::ArmModel<N, P>& arm) {
    const ControlConfig& c = scenario.control;
    K_d = Eigen::Map<const model::Vec<N>>(c.K_d.data());
    Lambda = Eigen::Map<const model::Vec<N>>(c.Lambda.data());
    Gamma_known.setZero();
    Gamma_unknown.setZero();
    eta_0.setZero();
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
    Friction(scenario.arm, c, arm);
    subtract_observer = c.observer;
    const bool paper = c.law == "paper_printed" || c.law == "paper_corrected";
    if (paper || c.law == "pd") PaperFeedback();
    if (paper) PaperAdaptation(arm);
  }

 private:
  void Friction(const NominalArm& description, const ControlConfig& c, const model::ArmModel<N, P>& arm) {
    constexpr double kBox = 0.05;  // of the torque limit
    kappa_max = kBox * arm.torque_limit;
    kappa_0.setZero();
    if (!description.coulomb_Nm.empty())
      kappa_0 = Eigen::Map<const model::Vec<N>>(description.coulomb_Nm.data());
    Gamma_c_known = c.Gamma_friction * K_d;  // joints that are damped more learn larger torques
    Gamma_c_unknown =
        c.observer ? model::Vec<N>(model::Vec<N>::Zero()) : Gamma_c_known;  // two integrators would fight
    friction_speed = c.friction_speed_radps;
  }

  /// Section 4.1 of the paper: K_d = 10, Λ = 5.
  void PaperFeedback() {
    K_d.setConstant(10.0);
    Lambda.setConstant(5.0);
  }

  /// Section 4.1 of the paper: Γ = 0.05 and 0.015, ς = 0.015, η(0) = [.8 .2 .2 .8 .8 .8]. For another number
  /// of parameters η(0) is the largest distance of p₀ to its box.
  void PaperAdaptation(const model::ArmModel<N, P>& arm) {
    constexpr std::array<double, 6> kEta0{0.8, 0.2, 0.2, 0.8, 0.8, 0.8};
    for (int k = 0; k < arm.num_parameters; ++k) {
      Gamma_known[k] = 0.05;
      Gamma_unknown[k] = 0.015;
      eta_0[k] = arm.num_parameters == 6 ? kEta0[static_cast<std::size_t>(k)]
                                         : std::max(arm.p_hi[k] - p_0[k], p_0[k] - arm.p_lo[k]);
    }
    sliding.c_0 = sliding.c_1 = 0.015;
    sliding.scale.setOnes();
    subtract_observer = false;
  }
};

}  // namespace reed::strategy
