// Force tracking through v (30): the force error sets the normal component of the reference.
//
//   e_f = f_d − f                                             N, > 0: press harder
//   v   = v₀ − D J_n v₀ − D z                        (30)     normal tip velocity −z, z > 0: into the wall
//   ż   = a (k_p e_f + k_i ∫e_f − z)                 (30f)    filter: v̇ needs no derivative of e_f
//
// On s = 0 against a wall of stiffness k_e the loop is stable iff k_i < a k_p.  RT: safe.
#pragma once

#include "reed/core/contact/normal_direction.h"

namespace reed::control {

struct ForceGains {
  double k_p = 0.0;  // m/(s·N)
  double k_i = 0.0;  // m/(s²·N)
  double a = 0.0;    // 1/s
};

struct ForceState {
  double z = 0.0;             // m/s
  double e_f_integral = 0.0;  // N·s
};

// clang-format off
/// Normal speed demanded by the force error, before the filter. m/s.
inline double NormalSpeed(const ForceGains& g, double e_f, double e_f_integral) noexcept {
  return g.k_p * e_f + g.k_i * e_f_integral;                                               // (30)
}

/// Derivative of the filter state. m/s².
inline double NormalAcceleration(const ForceGains& g, double normal_speed, double z) noexcept {
  return g.a * (normal_speed - z);                                                         // (30f)
}

/// v₀ with its normal component replaced by −z; D and J_n vary slowly and are taken as constant over a cycle.
template <int N>
void ReplaceNormal(const NormalDirection<N>& n, double z, double z_dot, Auxiliary<N>& aux) noexcept {
  aux.v     -= n.D * (n.J_n.dot(aux.v)     + z);                                           // (30)
  aux.v_dot -= n.D * (n.J_n.dot(aux.v_dot) + z_dot);                                       // (30), d/dt
}
// clang-format on

}  // namespace reed::control
