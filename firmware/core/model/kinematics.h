// (1)-(3): pose and velocity of every link and of the tool point, in one forward pass over the joints. World axes, SI.
// RT: safe.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <type_traits>

#include "reed/core/model/arm_model.h"
#include "reed/math/plane.h"
#include "reed/math/side_by_side.h"
#include "reed/math/sine.h"

namespace reed::model {

/// What follows from the angles alone.
template <int N>
struct LinkPoses {
  Vec<N> q;
  FixedArray<Eigen::Matrix3d, N> R;  // R_0i, columns x_i y_i z_i
  FixedArray<Eigen::Vector3d, N> p;  // origin of link i
  FixedArray<Eigen::Vector3d, N> r;  // to there from the origin of link i-1
  Eigen::Vector3d tip;               // tool point
  Mat<6, N> J;                       // tool point, rows linear then angular

  const Eigen::Matrix3d& R_last() const { return R[N - 1]; }
};

template <int N>
struct Kinematics : LinkPoses<N> {
  Vec<N> qd;                             // with q the state it was computed from
  FixedArray<Eigen::Vector3d, N> omega;  // angular velocity of link i
  FixedArray<Eigen::Vector3d, N> v;      // velocity of the origin of link i

  Vec6 tip_velocity() const { return this->J * qd; }
};

/// Fills one pose from its q, or two at once, each as if it were alone.
template <int N, int P, typename... One>
void ComputeLinkPoses(const ArmModel<N, P>& arm, One&... pose) {
  using T = std::conditional_t<sizeof...(pose) == 1, double, math::Pair>;
  using Vector = Eigen::Matrix<T, 3, 1>;
  FixedArray<Vector, N> axis, origin;
  Vector x = Vector::UnitX(), y = Vector::UnitY(), z = Vector::UnitZ();  // axes and origin of link i-1
  Vector p = Vector::Zero();
  for (int i = 0; i < N; ++i) {
    // clang-format off
    const auto [s, c] = math::SinCos(pose.q(i)...);
    const Eigen::Matrix<T, 3, 3> A = arm.mount_R[i].template cast<T>();
    const Vector m = arm.mount_p[i].template cast<T>();
    const Vector mount = m.x() * x + m.y() * y + m.z() * z;                      // (1) origin of link i-1 to the joint
    const Vector x_mount = A(0, 0) * x + A(1, 0) * y + A(2, 0) * z;              // (1) the joint's axes at theta = 0
    const Vector y_mount = A(0, 1) * x + A(1, 1) * y + A(2, 1) * z;
    z = A(0, 2) * x + A(1, 2) * y + A(2, 2) * z;
    const Vector r = mount + T(arm.d(i)) * z;                                    // (1) Tz(d): origin of i-1 to that of i
    y = c * y_mount - s * x_mount;                                               // (1) Rz(theta)
    x = c * x_mount + s * y_mount;
    p += r;
    // clang-format on
    axis[i] = z;
    origin[i] = p;
    math::Split(x, pose.R[i].col(0)...);
    math::Split(y, pose.R[i].col(1)...);
    math::Split(z, pose.R[i].col(2)...);
    math::Split(r, pose.r[i]...);
    math::Split(p, pose.p[i]...);
  }
  const Vector offset = arm.tool_offset.template cast<T>();
  Eigen::Matrix<T, 3, 3> R_last;
  R_last << x, y, z;
  const Vector tip = p + R_last * offset;
  math::Split(tip, pose.tip...);
  for (int i = 0; i < N; ++i) {
    const Vector lever = axis[i].cross(tip - origin[i]);
    math::Split(lever, pose.J.col(i).template head<3>()...);
    math::Split(axis[i], pose.J.col(i).template tail<3>()...);
  }
}

/// Velocities at the pose of `kin`, for its joint speeds qd.
template <int N>
void ComputeVelocities(Kinematics<N>& kin) {
  using Eigen::Vector3d;
  Vector3d v = Vector3d::Zero(), omega = Vector3d::Zero();
  for (int i = 0; i < N; ++i) {
    v += omega.cross(kin.r[i]);
    omega += kin.qd(i) * kin.R[i].col(2);
    kin.v[i] = v;
    kin.omega[i] = omega;
  }
}

/// Fills `kin` for joint angles q and speeds qd.
template <int N, int P>
void ForwardKinematics(const ArmModel<N, P>& arm, const Vec<N>& q, const Vec<N>& qd, Kinematics<N>& kin) {
  kin.q = q;
  kin.qd = qd;
  ComputeLinkPoses(arm, kin);
  ComputeVelocities(kin);
}

/// The same, and `other` for the joint angles q_other.
template <int N, int P>
void ForwardKinematics(const ArmModel<N, P>& arm, const Vec<N>& q, const Vec<N>& qd, Kinematics<N>& kin,
                       const Vec<N>& q_other, LinkPoses<N>& other) {
  kin.q = q;
  kin.qd = qd;
  other.q = q_other;
  if constexpr (math::Pair::kAtOnce) {
    ComputeLinkPoses<N, P, LinkPoses<N>, LinkPoses<N>>(arm, kin, other);
  } else {
    ComputeLinkPoses<N, P, LinkPoses<N>>(arm, kin);
    ComputeLinkPoses<N, P, LinkPoses<N>>(arm, other);
  }
  ComputeVelocities(kin);
}

/// Acceleration of the tool point at zero joint acceleration, J̇ q̇, linear then angular.
template <int N, int P>
Vec6 TipAcceleration(const ArmModel<N, P>& arm, const Kinematics<N>& kin) {
  using Eigen::Vector3d;
  Vector3d omega = Vector3d::Zero(), acc = Vector3d::Zero(), alpha = Vector3d::Zero();  // of link i-1
  for (int i = 0; i < N; ++i) {
    const Vector3d z = kin.R[i].col(2);
    acc += alpha.cross(kin.r[i]) + omega.cross(omega.cross(kin.r[i]));
    alpha += kin.qd(i) * omega.cross(z);
    omega += kin.qd(i) * z;
  }
  const Vector3d r_tool = kin.R_last() * arm.tool_offset;
  Vec6 both;
  both << acc + alpha.cross(r_tool) + omega.cross(omega.cross(r_tool)), alpha;
  return both;
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
