// The classical quantities of (20), (21) for bodies whose parameters are given: M, G, C(q, q̇)q̇, C, energies,
// τ, and what the momentum observer needs. Rigid links, without rotor inertia and friction. RT: safe.
#pragma once

#include "reed/core/model/newton_euler.h"

namespace reed::model {

/// Mass moments of every link for one parameter vector.
template <int N>
struct Bodies {
  FixedArray<MassMoments, N> link;
};

template <int N, int P>
Bodies<N> BodiesFor(const ArmModel<N, P>& arm, const Vec<P>& p) {
  Bodies<N> bodies;
  for (int b = 0; b < N; ++b) {
    for (int j = arm.first_shape[b]; j < arm.first_shape[b + 1]; ++j) {
      const UnitShape& shape = arm.shape[j];
      bodies.link[b].Add(shape.k < P ? p(shape.k) : 1.0, shape.unit);
    }
  }
  return bodies;
}

/// Viscous coefficients per joint, the diagonal of F_v.
template <int N, int P>
Vec<N> ViscousFriction(const ArmModel<N, P>& arm, const Vec<P>& p) {
  return arm.viscous * p;
}

/// Moves a wrench from the origin and axes of link i to the tool point and world axes.
template <int N>
Wrench AtTip(const Kinematics<N>& kin, int i, const Wrench& link) {
  const Eigen::Vector3d F = kin.R[i] * link.F;
  return {F, kin.R[i] * link.n + (kin.p[i] - kin.tip).cross(F)};
}

template <int N>
double JointComponent(const Kinematics<N>& kin, int i, const Wrench& at_tip) {
  return kin.J.col(i).template head<3>().dot(at_tip.F) + kin.J.col(i).template tail<3>().dot(at_tip.n);
}

/// M v̇ + C(q, q̇) v + G for gravity g (pass zero for none); O(N).
template <int N>
Vec<N> PolarisedTorque(const Bodies<N>& bodies, const Kinematics<N>& kin, const Vec<N>& v,
                       const Vec<N>& v_dot, const Eigen::Vector3d& gravity) {
  FixedArray<LinkField, N> field;
  PolarisedFields(kin, v, v_dot, gravity, field);
  Vec<N> tau;
  Wrench W;
  for (int i = N - 1; i >= 0; --i) {
    const Wrench body = AtTip(kin, i, InertialWrench(bodies.link[i], field[i]));
    W.F += body.F;
    W.n += body.n;
    tau(i) = JointComponent(kin, i, W);
  }
  return tau;
}

/// (20) τ for joint acceleration qdd.
template <int N>
Vec<N> InverseDynamics(const Bodies<N>& bodies, const Kinematics<N>& kin, const Vec<N>& qdd,
                       const Eigen::Vector3d& gravity) {
  return PolarisedTorque(bodies, kin, kin.qd, qdd, gravity);
}

/// C(q, q̇) q̇.
template <int N>
Vec<N> CoriolisTorque(const Bodies<N>& bodies, const Kinematics<N>& kin) {
  return PolarisedTorque<N>(bodies, kin, kin.qd, Vec<N>::Zero(), Eigen::Vector3d::Zero());
}

/// The Christoffel matrix itself, column by column; for inspection, the loop never needs it.
template <int N>
Mat<N, N> CoriolisMatrix(const Bodies<N>& bodies, const Kinematics<N>& kin) {
  Mat<N, N> C;
  for (int j = 0; j < N; ++j) {
    C.col(j) = PolarisedTorque<N>(bodies, kin, Vec<N>::Unit(j), Vec<N>::Zero(), Eigen::Vector3d::Zero());
  }
  return C;
}

/// G(q): minus what gravity does on the joints.
template <int N>
Vec<N> GravityTorque(const Bodies<N>& bodies, const Kinematics<N>& kin, const Eigen::Vector3d& gravity) {
  Vec<N> G;
  Wrench W;
  for (int i = N - 1; i >= 0; --i) {
    const MassMoments& body = bodies.link[i];
    const Eigen::Vector3d h =
        body.m * (kin.p[i] - kin.tip) + kin.R[i] * body.h;  // first moment about the tool point
    W.F -= body.m * gravity;
    W.n -= h.cross(gravity);
    G(i) = JointComponent(kin, i, W);
  }
  return G;
}

/// M(q) from composite bodies: column i is the momentum of links i ... N-1 moving with joint i alone.
template <int N>
Mat<N, N> MassMatrix(const Bodies<N>& bodies, const Kinematics<N>& kin) {
  Mat<N, N> M;
  MassMoments composite;  // links i ... N-1 about the tool point, world axes
  for (int i = N - 1; i >= 0; --i) {
    const MassMoments& body = bodies.link[i];
    const Eigen::Vector3d r = kin.p[i] - kin.tip;
    const Eigen::Vector3d Rh = kin.R[i] * body.h;
    const Eigen::Matrix3d Rhr = Rh * r.transpose();
    composite.m += body.m;
    composite.h += Rh + body.m * r;
    composite.J +=
        kin.R[i] * body.J * kin.R[i].transpose() + Rhr + Rhr.transpose() + body.m * r * r.transpose();
    const Wrench momentum =
        Momentum(composite, kin.J.col(i).template head<3>(), kin.J.col(i).template tail<3>());
    for (int j = 0; j <= i; ++j) M(i, j) = M(j, i) = JointComponent(kin, j, momentum);
  }
  return M;
}

/// The generalised momentum and what the model says of its rate, for the observer; O(N).
template <int N>
struct MomentumModel {
  Vec<N> momentum;  // M q̇
  Vec<N> free_rate;  // Ṁ q̇ - C q̇ - G = Cᵀ q̇ - G = ∂T/∂q - ∂V/∂q: the rate without motor, friction and contact
};

/// Turning joint i alone carries links i ... N-1 along; seen from them only the motion V of link i changes,
/// by V × s_i. Hence ∂T/∂q_i = (V_i × s_i) · H_i with H_i their momentum (axes s_i and momenta about the tool
/// point).
template <int N>
MomentumModel<N> GeneralisedMomentum(const Bodies<N>& bodies, const Kinematics<N>& kin,
                                     const Eigen::Vector3d& gravity) {
  using Eigen::Vector3d;
  MomentumModel<N> out;
  Wrench H, weight;
  for (int i = N - 1; i >= 0; --i) {
    const MassMoments& body = bodies.link[i];
    const Eigen::Matrix3d& R = kin.R[i];
    const Vector3d r = kin.p[i] - kin.tip;
    const Wrench link = AtTip(kin, i, Momentum(body, R.transpose() * kin.v[i], R.transpose() * kin.omega[i]));
    H.F += link.F;
    H.n += link.n;
    weight.F += body.m * gravity;
    weight.n += (body.m * r + R * body.h).cross(gravity);
    const Vector3d s_lin = kin.J.col(i).template head<3>(), z = kin.J.col(i).template tail<3>();
    const Vector3d v_at_tip = kin.v[i] - kin.omega[i].cross(r);
    out.momentum(i) = JointComponent(kin, i, H);
    out.free_rate(i) = (kin.omega[i].cross(s_lin) + v_at_tip.cross(z)).dot(H.F) +
                       kin.omega[i].cross(z).dot(H.n) + JointComponent(kin, i, weight);
  }
  return out;
}

template <int N>
double KineticEnergy(const Bodies<N>& bodies, const Kinematics<N>& kin) {
  double twice = 0.0;
  for (int i = 0; i < N; ++i) {
    const Eigen::Vector3d v = kin.R[i].transpose() * kin.v[i], omega = kin.R[i].transpose() * kin.omega[i];
    const Wrench momentum = Momentum(bodies.link[i], v, omega);
    twice += momentum.F.dot(v) + momentum.n.dot(omega);
  }
  return 0.5 * twice;
}

/// Zero with every centre of mass at the base origin.
template <int N>
double PotentialEnergy(const Bodies<N>& bodies, const Kinematics<N>& kin, const Eigen::Vector3d& gravity) {
  double energy = 0.0;
  for (int i = 0; i < N; ++i) {
    energy -= gravity.dot(bodies.link[i].m * kin.p[i] + kin.R[i] * bodies.link[i].h);
  }
  return energy;
}

}  // namespace reed::model
