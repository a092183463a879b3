// Unknown interaction force (36)-(41): adaptive sliding mode.
//
//   p̂   = p₀ + η̂ ∘ sat(Yᵀs / φ_y)                                          (38)
//   U   = J_m v̇ + Y p̂ + f_known + K_d s + σ̂₀ s + σ̂₁ sat(s / φ)            (36)     N·m
//   η̂'  = Γ |Yᵀ s|                                                          (39)
//   σ̂₀' = c₀ ‖s‖²                                                           (40)
//   σ̂₁' = c₁ ‖s‖₁                                                           (41)
//
// φ → 0 gives the paper's sgn. F_in is bounded by d₀ + d₁‖e‖ + d₂‖ė‖ (35); V of (45) falls where Q of (46) is
// positive. Differences from the paper's print: docs/control_law.md.  RT: safe.
#pragma once

#include "reed/core/law/surface.h"

namespace reed::control {

template <int N>
struct SlidingGains {
  double c_0 = 0.0;               // (40)
  double c_1 = 0.0;               // (41)
  double phi = 0.0;               // rad/s
  Vec<N> scale = Vec<N>::Ones();  // per joint: large joints take more of sigma
};

// clang-format off
/// (38) with the sign function handed in: sgn or sat.
template <int P>
Vec<P> WorstCaseParameters(const Vec<P>& p_0, const Vec<P>& eta_hat, const Vec<P>& sign_Yts) noexcept {
  return p_0 + eta_hat.cwiseProduct(sign_Yts);                                             // (38)
}

/// (36) without its sliding term.
template <int N>
Vec<N> UnknownForceTorque(const Vec<N>& J_m, const Vec<N>& v_dot, const Vec<N>& f_hat, const Vec<N>& K_d,
                          const Vec<N>& s, const Vec<N>& sliding) noexcept {
  return J_m.cwiseProduct(v_dot) + f_hat + K_d.cwiseProduct(s) + sliding;                  // (36)
}

/// σ̂₀ s + σ̂₁ sgn(s) of (36), scaled per joint, with the sign function handed in.
template <int N>
Vec<N> SlidingTerm(double sigma_0, double sigma_1, const Vec<N>& scale, const Vec<N>& s, const Vec<N>& sign_s) noexcept {
  return scale.cwiseProduct(sigma_0 * s + sigma_1 * sign_s);                               // (36)
}

/// (39).
template <int P>
Vec<P> EtaRate(const Vec<P>& Gamma, const Vec<P>& Yts) noexcept {
  return Gamma.cwiseProduct(Yts.cwiseAbs());                                               // (39)
}

/// (40).
template <int N>
double Sigma0Rate(double c_0, const Vec<N>& s) noexcept {
  return c_0 * s.squaredNorm();                                                            // (40)
}

/// (41).
template <int N>
double Sigma1Rate(double c_1, const Vec<N>& s) noexcept {
  return c_1 * s.template lpNorm<1>();                                                     // (41)
}
// clang-format on

}  // namespace reed::control
