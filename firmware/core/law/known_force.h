// Known interaction force (31)-(34): adaptive, force-tracking.
//
//   U  = J_m v̇ + Y p̂ + f_known − Jᵀ F_d + K_d s      (31)     N·m
//   ṗ̂  = Γ Yᵀ s                                       (34)     gradient; the sign for which (44) holds
//
// Closed loop with the force loop (30):  M ṡ = −C s − (K_d + F_v) s + Y p̃ + Jᵀ (F_d − F_in)   (32), and with
// V of (42):  V̇ = −sᵀ (K_d + F_v) s − k_p e_f² + e_f ḟ_d / k_e  for any unknown wall stiffness k_e > 0.
// The feed-forward is −Jᵀ F_d and not the measured force: only then the cross terms of V̇ cancel.
// Differences from the paper's print: docs/control_law.md.  RT: safe.
#pragma once

#include "reed/core/law/surface.h"

namespace reed::control {

// clang-format off
/// (31). f_hat = Y p̂ + f_known (28); normal_force_row = J_nᵀ f_d.
template <int N>
Vec<N> KnownForceTorque(const Vec<N>& J_m, const Vec<N>& v_dot, const Vec<N>& f_hat,
                        const Vec<N>& JtF_d, const Vec<N>& K_d, const Vec<N>& s) noexcept {
  return J_m.cwiseProduct(v_dot) + f_hat - JtF_d + K_d.cwiseProduct(s);                    // (31)
}

/// (34). Γ diagonal, one entry per parameter.
template <int N, int P>
Vec<P> KnownForceUpdate(const Vec<P>& Gamma, const Mat<N, P>& Y, const Vec<N>& s) noexcept {
  return Gamma.cwiseProduct(Y.transpose() * s);                                            // (34)
}
// clang-format on

}  // namespace reed::control
