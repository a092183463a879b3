// The paper's two laws as it prints them, kept for comparison. Their proofs do not hold: docs/control_law.md.
//
//   known     p̂ = −η̂ sgn(Yᵀs)   (33)     η̂ = Γ Yᵀs     (34)     so p̂ = −Γ |Yᵀs| ≤ 0: masses below zero
//             U = f̂ − Jᵀ F_d + K_d s                      (31)
//   unknown   p̂ = −η̂ sgn(Yᵀs)   (38)     η̂' = Γ |Yᵀs|   (39)
//             σ̂₀ = ς ‖s‖²        (40)     σ̂₁ = ς ‖s‖²     (41)     values, not rates
//             U = f̂ + σ̂₀ s + σ̂₁ sgn(s)                    (36)     no K_d s
//
// Two things cannot be run as printed: J F is read as Jᵀ F, and the "− F_in" of (36) is left out, because F_in is
// not known there. J_m v̇ belongs to f (27).  RT: safe.
#pragma once

#include "reed/core/law/surface.h"

namespace reed::control {

// clang-format off
/// (33), (38) as printed.
template <int P>
Vec<P> PrintedParameters(const Vec<P>& eta_hat, const Vec<P>& Yts) noexcept {
  return -eta_hat.cwiseProduct(Sign(Yts));                                                 // (33), (38)
}

/// (34) as printed: a value, not a rate.
template <int P>
Vec<P> PrintedEta(const Vec<P>& Gamma, const Vec<P>& Yts) noexcept {
  return Gamma.cwiseProduct(Yts);                                                          // (34)
}

/// (40), (41) as printed: the same value twice.
template <int N>
double PrintedSigma(double varsigma, const Vec<N>& s) noexcept {
  return varsigma * s.squaredNorm();                                                       // (40), (41)
}

/// (36) as printed, F_in left out.
template <int N>
Vec<N> PrintedUnknownForceTorque(const Vec<N>& J_m, const Vec<N>& v_dot, const Vec<N>& f_hat, double sigma_0,
                                 double sigma_1, const Vec<N>& s) noexcept {
  return J_m.cwiseProduct(v_dot) + f_hat + sigma_0 * s + sigma_1 * Sign(s);                // (36)
}
// clang-format on

}  // namespace reed::control
