// Generalised-momentum observer: the torque on the arm that the model does not explain.
//
//   p = M̂ θ̇ + J_m θ̇
//   r = K_o [ p − ∫ (U + Ĉᵀθ̇ − Ĝ − F̂ + r) dt − p(0) ]            (47)
//
// r follows Jᵀ F_in + model error with the lag 1/K_o: after a step 63.2 % at 1/K_o; discrete pole e^(−K_o T).
// Ṁ̂θ̇ − Ĉθ̇ = Ĉᵀθ̇ because Ṁ − 2C is skew. The model is frozen at p₀, apart from the adaptation.
// The paper's conclusion proposes an observer. (47) is Reed's.  RT: safe.
#pragma once

#include "reed/core/law/surface.h"
#include "reed/math/exponential.h"

namespace reed::control {

template <int N>
class MomentumObserver {
 public:
  /// K_o in 1/s, period in s.
  MomentumObserver(double K_o, double period) noexcept
      : period_(period), gain_((1.0 - math::Exp(-K_o * period)) / period) {}

  /// Starts from the state as it is: r = 0.
  void Reset(const Vec<N>& momentum) noexcept {
    predicted_ = momentum;
    r_.setZero();
  }

  /// momentum = (M̂ + J_m) θ̇ now; rate = U_{k-1} + Ĉᵀθ̇ − Ĝ − F̂ over the cycle that has just passed (known part
  /// of ṗ).
  const Vec<N>& Update(const Vec<N>& momentum, const Vec<N>& rate) noexcept {
    predicted_ += period_ * (rate + r_);
    r_ = r_ + gain_ * (momentum - predicted_);  // (47), exact pole e^(−K_o T)
    predicted_ = momentum;
    return r_;
  }

  /// Instead of Update() where more than one cycle has passed: the rate of all of them is unknown, so they change
  /// nothing.
  void Skip(const Vec<N>& momentum) noexcept { predicted_ = momentum; }

  const Vec<N>& r() const noexcept { return r_; }

 private:
  double period_;
  double gain_;
  Vec<N> predicted_ = Vec<N>::Zero();
  Vec<N> r_ = Vec<N>::Zero();
};

}  // namespace reed::control
