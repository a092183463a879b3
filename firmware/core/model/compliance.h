// Static deflection of the arm as a serial chain: the result of (4)-(6) for a chain, in O(N) and without a matrix.
// World axes, SI. Small displacement u and small rotation phi. RT: safe.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "reed/core/model/structural_loads.h"

namespace reed::model {

struct Deflection {
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  Eigen::Vector3d phi = Eigen::Vector3d::Zero();

  /// Adds what `other` does to a point at r from where it happens.
  void AddRigidly(const Deflection& other, const Eigen::Vector3d& r) {
    u += other.u + other.phi.cross(r);
    phi += other.phi;
  }
  Vec6 AsVector() const {
    Vec6 both;
    both << u, phi;
    return both;
  }
};

template <int N>
struct SerialDeflections {
  Vec<N> torque;                         // of the loads about joint axis i (N·m)
  Vec<N> spring;                         // rotation that the linear spring of joint i yields to it (rad)
  FixedArray<Deflection, 2 * N> member;  // end of member j relative to its start
  Deflection tip_links;                  // tool point, from the members alone
};

/// What a cantilever yields more in the plane of its y because it bends there about z, with EI_z.
inline Deflection SofterPlane(const Member& beam, const Eigen::Vector3d& y, const Eigen::Vector3d& z,
                              const Wrench& W, const Eigen::Vector3d& Q) {
  const double L = beam.length, F_y = W.F.dot(y), Q_y = Q.dot(y), n_z = W.n.dot(z);
  const double more = L * beam.softer;
  return {more * (L * L * (F_y / 3.0 + Q_y / 8.0) + L / 2.0 * n_z) * y,
          more * (n_z + L * (F_y / 2.0 + Q_y / 6.0)) * z};
}

/// Cantilever of direction t with EI_y in both planes: end deflection under the wrench W at the end and the force Q spread
/// evenly.
[[gnu::always_inline]] inline Deflection Cantilever(const Member& beam, const Eigen::Vector3d& t,
                                                    const Wrench& W, const Eigen::Vector3d& Q) {
  const double L = beam.length, L_EI = L / beam.EI_y;
  const Eigen::Vector3d F_axial = W.F.dot(t) * t, Q_axial = Q.dot(t) * t, n_axial = W.n.dot(t) * t;
  // clang-format off
  return {(L / beam.EA) * (F_axial + Q_axial / 2.0)
            + L_EI * (L * L) * ((W.F - F_axial) / 3.0 + (Q - Q_axial) / 8.0)   // L³/3EI, L³/8EI
            + L_EI * (L / 2.0) * W.n.cross(t),                                 // L²/2EI
          (L / beam.GJ) * n_axial + L_EI * (W.n - n_axial)                     // L/GJ, L/EI
            + L_EI * L * t.cross(W.F / 2.0 + Q / 6.0)};                        // L²/2EI, L²/6EI
  // clang-format on
}

/// One pass from tip to base: the wrench that each member and each spring carries, what it yields, and what
/// that does to the tool point. Springs are linear here; hardening belongs to SpringAngle.
template <int N, int P>
SerialDeflections<N> DeflectSerially(const ArmModel<N, P>& arm, const LinkPoses<N>& pose,
                                     const StructuralLoads<N>& loads) {
  using Eigen::Vector3d;
  SerialDeflections<N> out;
  Wrench W = loads.tip;  // of everything further out, about the point c
  Vector3d c = pose.tip;
  const auto move_to = [&](const Vector3d& point) {
    W.n += (c - point).cross(W.F);
    c = point;
  };
  int j = arm.num_members - 1;
  for (int i = N - 1; i >= 0; --i) {
    if (arm.carrier[i] < 0) {
      move_to(pose.p[i]);
      W.F += loads.rigid_link[i].F;
      W.n += loads.rigid_link[i].n;
    }
    for (; j >= 0 && arm.member[j].link == i; --j) {
      const Member& beam = arm.member[j];
      const MemberLoad& load = loads.member[j];
      const Eigen::Matrix3d& R = pose.R[i];
      const auto [start, t, end] = LineOf(beam, R, pose.p[i]);
      move_to(end);
      W.F += load.end.F;
      W.n += load.end.n;
      out.member[j] = Cantilever(beam, t, W, load.spread);
      if (beam.softer != 0.0)
        out.member[j].AddRigidly(SofterPlane(beam, R * beam.y, R * beam.z, W, load.spread), Vector3d::Zero());
      out.tip_links.AddRigidly(out.member[j], pose.tip - c);
      move_to(start);
      W.n += (0.5 * beam.length) * t.cross(load.spread);
      W.F += load.spread + load.start;
    }
    const Vector3d z = pose.R[i].col(2);
    out.torque(i) = z.dot(W.n + (c - pose.p[i]).cross(W.F));
    out.spring(i) = out.torque(i) / arm.joint_stiffness(i);  // (6) W = k_q ξ
  }
  return out;
}

/// Tool point, from the springs alone.
template <int N>
Deflection TipBySprings(const LinkPoses<N>& pose, const SerialDeflections<N>& serial) {
  Deflection tip;
  for (int i = N - 1; i >= 0; --i)
    tip.AddRigidly({Eigen::Vector3d::Zero(), serial.spring(i) * pose.R[i].col(2)}, pose.tip - pose.p[i]);
  return tip;
}

enum class JointModel { kRigid, kElastic };

/// Deflection of the end node of every member, from base to tip.
template <int N, int P>
FixedArray<Deflection, 2 * N> NodeDeflections(const ArmModel<N, P>& arm, const LinkPoses<N>& pose,
                                              const SerialDeflections<N>& serial, JointModel joints) {
  using Eigen::Vector3d;
  FixedArray<Deflection, 2 * N> node;
  Deflection at;  // of the material point at c
  Vector3d c = Vector3d::Zero();
  const auto move_to = [&](const Vector3d& point) {
    at.u += at.phi.cross(point - c);
    c = point;
  };
  int j = 0;
  for (int i = 0; i < N; ++i) {
    move_to(pose.p[i]);
    if (joints == JointModel::kElastic) at.phi += serial.spring(i) * pose.R[i].col(2);
    for (; j < arm.num_members && arm.member[j].link == i; ++j) {
      move_to(LineOf(arm.member[j], pose.R[i], pose.p[i]).end);
      at.u += serial.member[j].u;
      at.phi += serial.member[j].phi;
      node[j] = at;
    }
  }
  return node;
}

/// 6x6 compliance of the tool point from the springs: J K_q⁻¹ Jᵀ. Its rank is at most N.
template <int N, int P>
Mat6 JointCompliance(const ArmModel<N, P>& arm, const LinkPoses<N>& pose) {
  return pose.J * arm.joint_stiffness.cwiseInverse().asDiagonal() * pose.J.transpose();
}

/// 6x6 compliance of the tool point from the members, rows and columns linear then angular.
template <int N, int P>
Mat6 LinkCompliance(const ArmModel<N, P>& arm, const LinkPoses<N>& pose) {
  Mat6 C;
  for (int column = 0; column < 6; ++column) {
    StructuralLoads<N> unit;
    (column < 3 ? unit.tip.F(column) : unit.tip.n(column - 3)) = 1.0;
    C.col(column) = DeflectSerially(arm, pose, unit).tip_links.AsVector();
  }
  return C;
}

}  // namespace reed::model
