// The paper's stability bookkeeping (42)-(46), corrected: V of both laws and what its derivative must be.
// Used where the truth is known: tests and offline. No part of the loop.
//
//   known     V  = ½ sᵀM s + ½ p̃ᵀΓ⁻¹p̃ + e_f²/(2 k_e) + ½ k_i (∫e_f)²                                  (42)
//             V̇  = −sᵀ(K_d + F_v)s − k_p e_f² + e_f ḟ_d / k_e                                          (44)
//   unknown   V  = ½ sᵀM s + ½ Σ(η−η̂)²/Γ + ½ (σ₀−σ̂₀)²/c₀ + ½ (σ₁−σ̂₁)²/c₁ + ½ ρ eᵀe                    (45)
//             V̇ ≤ −[‖s‖ ‖e‖] Q [‖s‖ ‖e‖]ᵀ − (σ₁ − d₀) ‖s‖                                              (46)
//             Q  = [σ₀ − d₂, −(ρ + d₁ + λ_M d₂)/2;  ·, ρ λ_m]
//
// M contains the rotor inertia. d₀, d₁, d₂ bound JᵀF_in (35); λ_m, λ_M: least and largest of Λ.
#pragma once

#include "reed/core/law/surface.h"

namespace reed::control {

struct ForceEnergy {
  double k_e = 1.0;           // N/m
  double e_f = 0.0;           // N
  double e_f_integral = 0.0;  // N·s
};

// clang-format off
template <int N, int P>
double KnownForceV(const Mat<N, N>& M, const Vec<N>& s, const Vec<P>& Gamma, const Vec<P>& p_tilde,
                   const ForceEnergy& force, double k_i) {
  return 0.5 * s.dot(M * s) + 0.5 * p_tilde.cwiseQuotient(Gamma).dot(p_tilde) +
         force.e_f * force.e_f / (2.0 * force.k_e) +
         0.5 * k_i * force.e_f_integral * force.e_f_integral;                              // (42)
}

template <int N>
double KnownForceVdot(const Vec<N>& K_d, const Vec<N>& F_v, const Vec<N>& s, const ForceEnergy& force,
                      double k_p, double f_d_dot) {
  return -s.dot((K_d + F_v).cwiseProduct(s)) - k_p * force.e_f * force.e_f +
         force.e_f * f_d_dot / force.k_e;                                                  // (44)
}

/// What (45) compares with: true bounds η, σ, the gains, and the weight ρ of e.
template <int P>
struct UnknownForceBounds {
  Vec<P> eta, Gamma;
  double sigma_0 = 0.0, sigma_1 = 0.0, c_0 = 1.0, c_1 = 1.0, rho = 1.0;
  double d_0 = 0.0, d_1 = 0.0, d_2 = 0.0;
};

template <int N, int P>
double UnknownForceV(const Mat<N, N>& M, const Vec<N>& s, const Vec<N>& e, const UnknownForceBounds<P>& b,
                     const Vec<P>& eta_hat, double sigma_0_hat, double sigma_1_hat) {
  const Vec<P> eta_tilde = b.eta - eta_hat;
  const double s0 = b.sigma_0 - sigma_0_hat, s1 = b.sigma_1 - sigma_1_hat;
  return 0.5 * s.dot(M * s) + 0.5 * eta_tilde.cwiseQuotient(b.Gamma).dot(eta_tilde) +
         0.5 * s0 * s0 / b.c_0 + 0.5 * s1 * s1 / b.c_1 + 0.5 * b.rho * e.squaredNorm();    // (45)
}

template <int N, int P>
double UnknownForceVdotBound(const UnknownForceBounds<P>& b, const Vec<N>& Lambda, const Vec<N>& s,
                             const Vec<N>& e) {
  const double lambda_m = Lambda.minCoeff(), lambda_M = Lambda.maxCoeff();
  const double q_12 = -0.5 * (b.rho + b.d_1 + lambda_M * b.d_2);
  const Eigen::Vector2d x(s.norm(), e.norm());
  Eigen::Matrix2d Q;
  Q << b.sigma_0 - b.d_2, q_12, q_12, b.rho * lambda_m;
  return -x.dot(Q * x) - (b.sigma_1 - b.d_0) * s.norm();                                   // (46)
}
// clang-format on

}  // namespace reed::control
