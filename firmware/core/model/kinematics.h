// (1)-(3): pose and velocity of every link and of the tool point, in one forward pass over the joints. World axes, SI.
// RT: safe.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "reed/core/model/arm_model.h"
#include "reed/math/plane.h"
#include "reed/math/sine.h"

namespace reed::model {

template <int N>
struct Kinematics {
  Vec<N> q, qd;                          // the state it was computed from
  FixedArray<Eigen::Matrix3d, N> R;      // R_0i, columns x_i y_i z_i
  FixedArray<Eigen::Vector3d, N> p;      // origin of link i
  FixedArray<Eigen::Vector3d, N> omega;  // angular velocity of link i
  FixedArray<Eigen::Vector3d, N> v;      // velocity of the origin of link i
  Eigen::Vector3d tip;                   // tool point
  Mat<6, N> J;                           // tool point, rows linear then angular
  Vec6 Jdot_qd;  // acceleration of the tool point at zero joint acceleration, linear then angular

  const Eigen::Matrix3d& R_last() const { return R[N - 1]; }
  Vec6 tip_velocity() const { return J * qd; }
};

/// Fills `kin` for joint angles q and speeds qd.
template <int N, int P>
void ForwardKinematics(const ArmModel<N, P>& arm, const Vec<N>& q, const Vec<N>& qd, Kinematics<N>& kin) {
  using Eigen::Vector3d;
  kin.q = q;
  kin.qd = qd;
  Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(),
           z = Vector3d::UnitZ();  // axes and origin of link i-1
  Vector3d p = Vector3d::Zero(), v = Vector3d::Zero(), omega = Vector3d::Zero();
  Vector3d acc = Vector3d::Zero(), alpha = Vector3d::Zero();  // at zero joint acceleration
  for (int i = 0; i < N; ++i) {
    // clang-format off
    const auto [s, c] = math::SinCos(q(i));
    const Eigen::Matrix3d& A = arm.mount_R[i];
    const Vector3d& m = arm.mount_p[i];
    const Vector3d mount = m.x() * x + m.y() * y + m.z() * z;                    // (1) origin of link i-1 to the joint
    const Vector3d x_mount = A(0, 0) * x + A(1, 0) * y + A(2, 0) * z;            // (1) the joint's axes at theta = 0
    const Vector3d y_mount = A(0, 1) * x + A(1, 1) * y + A(2, 1) * z;
    z = A(0, 2) * x + A(1, 2) * y + A(2, 2) * z;
    const Vector3d r = mount + arm.d(i) * z;                                     // (1) Tz(d): origin of i-1 to that of i
    y = c * y_mount - s * x_mount;                                               // (1) Rz(theta)
    x = c * x_mount + s * y_mount;
    const Vector3d omega_r = omega.cross(r);
    p += r;
    v += omega_r;
    acc += alpha.cross(r) + omega.cross(omega_r);
    alpha += qd(i) * omega.cross(z);
    omega += qd(i) * z;
    // clang-format on
    kin.R[i] << x, y, z;
    kin.p[i] = p;
    kin.v[i] = v;
    kin.omega[i] = omega;
  }
  const Vector3d r_tool = kin.R[N - 1] * arm.tool_offset;
  kin.tip = p + r_tool;
  kin.Jdot_qd << acc + alpha.cross(r_tool) + omega.cross(omega.cross(r_tool)), alpha;
  for (int i = 0; i < N; ++i) {
    const Vector3d z_i = kin.R[i].col(2);
    kin.J.col(i) << z_i.cross(kin.tip - kin.p[i]), z_i;
  }
}

/// (2) alpha, beta, gamma about x, y, z of the world: R = Rz(gamma) Ry(beta) Rx(alpha).
inline Eigen::Vector3d EulerAngles(const Eigen::Matrix3d& R) {
  return {math::Atan2(R(2, 1), R(2, 2)), math::Atan2(-R(2, 0), math::Length(R(2, 1), R(2, 2))),
          math::Atan2(R(1, 0), R(0, 0))};
}

/// Columns: axes of the tool's frame.
template <int N, int P>
Eigen::Matrix3d TipRotation(const ArmModel<N, P>& arm, const Kinematics<N>& kin) {
  return kin.R_last() * arm.tool_rotation;
}

/// (3) joint angles to x, y, z, alpha, beta, gamma. Rank of the map: at most N, so five joints do not reach
/// every pose.
template <int N, int P>
Vec6 Pose(const ArmModel<N, P>& arm, const Kinematics<N>& kin) {
  Vec6 pose;
  pose << kin.tip, EulerAngles(TipRotation(arm, kin));
  return pose;
}

}  // namespace reed::model
