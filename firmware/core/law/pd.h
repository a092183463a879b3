// PD without a model: the gains of (31) alone.
//
//   U = K_d s,  s = (θ̇_d − θ̇) + Λ (θ_d − θ)      (31) without f̂ and F_d       N·m
//
// "PD(10,5)" is this with the paper's K_d = 10 N·m·s/rad and Λ = 5 1/s on every joint: 10 ė + 50 e.
// RT: safe.
#pragma once

#include "reed/core/law/surface.h"

namespace reed::control {

template <int N>
Vec<N> PdTorque(const Vec<N>& K_d, const Vec<N>& s) noexcept {
  return K_d.cwiseProduct(s);
}

}  // namespace reed::control
