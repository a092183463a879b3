// (27), (28): f = M v̇ + C(θ, θ̇) v + G + F_v v = Y(θ, θ̇, v, v̇) p + f_known, linear in the structural
// parameters p. C is the Christoffel matrix (Ṁ - 2C is skew). The reflected rotor inertia is not in f.
// O(N (N + P)), one forward and one backward pass. C is never built. RT: safe.
#pragma once

#include "reed/core/model/newton_euler.h"

namespace reed::model {

template <int N, int P>
struct Regressor {
  Mat<N, P> Y;     // column k: torques per unit of parameter k
  Vec<N> f_known;  // torques of everything that is not in p

  /// (28) with the estimate p_hat.
  Vec<N> f(const Vec<P>& p_hat) const { return Y * p_hat + f_known; }
};

/// Y and f_known at the state of `kin`, for reference velocity v and acceleration v_dot.
template <int N, int P>
void ComputeRegressor(const ArmModel<N, P>& arm, const Kinematics<N>& kin, const Vec<N>& v,
                      const Vec<N>& v_dot, Regressor<N, P>& out) {
  FixedArray<LinkField, N> field;
  PolarisedFields(kin, v, v_dot, arm.gravity, field);

  // Column k of W: wrench that one unit of parameter k on the links i ... N-1 needs, world axes, moment about
  // the tool point, so that the torque of joint i is J_iᵀ W. Column P: the known part.
  Eigen::Matrix<double, 6, P + 1, Eigen::RowMajor> W =
      Eigen::Matrix<double, 6, P + 1, Eigen::RowMajor>::Zero();
  for (int i = N - 1; i >= 0; --i) {
    for (int j = arm.first_shape[i]; j < arm.first_shape[i + 1]; ++j) {
      const Wrench link = InertialWrench(arm.shape[j].unit, field[i]);
      const Eigen::Vector3d F = kin.R[i] * link.F;
      W.col(arm.shape[j].k).template head<3>() += F;
      W.col(arm.shape[j].k).template tail<3>() += kin.R[i] * link.n + (kin.p[i] - kin.tip).cross(F);
    }
    const Eigen::Matrix<double, 1, P + 1> row = kin.J.col(i).transpose() * W;
    out.Y.row(i) = row.template head<P>() + v(i) * arm.viscous.row(i);  // (21) F_v v
    out.f_known(i) = row(P);
  }
}

}  // namespace reed::model
