// Sliding surface (22)-(24): the tracking error as one signal per joint, with the unit of a velocity.
//
//   e   = θ_d − θ              (22)   rad      θ: motor side
//   v   = θ̇_d + Λ e            (24)   rad/s
//   s   = v − θ̇ = ė + Λ e      (23)   rad/s
//
// On s = 0 the error decays as ė = −Λ e.  Source: paper (22)-(25).  RT: safe.
#pragma once

#include <Eigen/Core>

namespace reed::control {

template <int N>
using Vec = Eigen::Matrix<double, N, 1>;
template <int R, int C>
using Mat = Eigen::Matrix<double, R, C>;

/// What the arm shall do at one instant. rad, rad/s, rad/s².
template <int N>
struct Reference {
  Vec<N> theta_d = Vec<N>::Zero(), theta_d_dot = Vec<N>::Zero(), theta_d_ddot = Vec<N>::Zero();
};

/// Auxiliary signal v and its derivative.
template <int N>
struct Auxiliary {
  Vec<N> e = Vec<N>::Zero(), v = Vec<N>::Zero(), v_dot = Vec<N>::Zero();
};

// clang-format off
template <int N>
Auxiliary<N> Surface(const Reference<N>& ref, const Vec<N>& Lambda, const Vec<N>& theta, const Vec<N>& theta_dot) noexcept {
  Auxiliary<N> out;
  out.e     = ref.theta_d - theta;                                                         // (22)
  out.v     = ref.theta_d_dot + Lambda.cwiseProduct(out.e);                                // (24)
  out.v_dot = ref.theta_d_ddot + Lambda.cwiseProduct(ref.theta_d_dot - theta_dot);         // (25)
  return out;
}

/// s = v − θ̇ (23), with whatever v the force loop has made of (24).
template <int N>
Vec<N> SlidingError(const Vec<N>& v, const Vec<N>& theta_dot) noexcept {
  return v - theta_dot;                                                                    // (23)
}
// clang-format on

/// sat(x/φ) componentwise: the sign function with a boundary layer; φ → 0 is the paper's sgn.
template <typename Derived>
auto Saturate(const Eigen::MatrixBase<Derived>& x, double phi) noexcept {
  return (x / phi).cwiseMax(-1.0).cwiseMin(1.0).eval();
}

/// The paper's sgn, componentwise.
template <typename Derived>
auto Sign(const Eigen::MatrixBase<Derived>& x) noexcept {
  return x.cwiseSign().eval();
}

}  // namespace reed::control
