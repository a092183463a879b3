// Coulomb friction, adapted with the structural parameters: one more regressor, which is diagonal.
//
//   f_c = κ̂ ∘ sat(v / v_s)                        (48)     N·m, smooth around rest; v: auxiliary signal (24)
//   κ̂' = Γ_c sat(v / v_s) ∘ s                     (49)     gradient as (34); ½ κ̃ᵀΓ_c⁻¹κ̃ joins V (42)
//
// Then the friction terms cancel in (44).
//
// v is the reference speed and not the measured one: no noise, and no limit cycle at rest. The paper drops
// friction between (21) and (26). (48), (49) are Reed's.  RT: safe.
#pragma once

#include "reed/core/law/surface.h"

namespace reed::control {

// clang-format off
template <int N>
Vec<N> CoulombTorque(const Vec<N>& kappa_hat, const Vec<N>& v, double v_s) noexcept {
  return kappa_hat.cwiseProduct(Saturate(v, v_s));                                         // (48)
}

template <int N>
Vec<N> CoulombUpdate(const Vec<N>& Gamma_c, const Vec<N>& v, double v_s, const Vec<N>& s) noexcept {
  return Gamma_c.cwiseProduct(Saturate(v, v_s)).cwiseProduct(s);                           // (49)
}
// clang-format on

}  // namespace reed::control
