// Computed torque: the model's inverse, linear error dynamics where the model is right.
//
//   a = θ̈_d + (κ + Λ) ė + κ Λ e             poles at −κ and −Λ                      rad/s²
//   U = (M̂ + J_m) a + Ĉ θ̇ + Ĝ + F̂ θ̇          = J_m a + Y(θ, θ̇, θ̇, a) p₀ + f_known    N·m
//
// κ = K_d / (M̂ + J_m)_ii: near the planned state the damping on s is that of the robust law.  RT: safe.
#pragma once

#include "reed/core/law/surface.h"

namespace reed::control {

template <int N>
Vec<N> ComputedAcceleration(const Reference<N>& ref, const Vec<N>& kappa, const Vec<N>& Lambda,
                            const Vec<N>& e, const Vec<N>& theta_dot) noexcept {
  return ref.theta_d_ddot + (kappa + Lambda).cwiseProduct(ref.theta_d_dot - theta_dot) +
         kappa.cwiseProduct(Lambda).cwiseProduct(e);
}

/// f_hat = Y(θ, θ̇, θ̇, a) p₀ + f_known.
template <int N>
Vec<N> ComputedTorque(const Vec<N>& J_m, const Vec<N>& a, const Vec<N>& f_hat) noexcept {
  return J_m.cwiseProduct(a) + f_hat;
}

}  // namespace reed::control
