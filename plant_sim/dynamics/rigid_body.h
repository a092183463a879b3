// Rigid bodies and the 6x6 inertia that one presents at a point, seen from its carrier.
// Axes: those of the frame that carries the body. Order of every 6-vector: linear, then angular. RT: safe.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace reed::plant {

/// [v]x, so that Cross(v) * w = v x w.
inline Eigen::Matrix3d Cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// Force and moment about the origin of the frame in whose axes they are written.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N·m
};

/// How a frame moves, in its own axes. `bias` is the acceleration that remains when every coordinate's second
/// derivative is zero, gravity included as an upward acceleration of the base: a = J x'' + bias.
struct Motion {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // of the origin
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();
  Eigen::Vector3d bias_linear =
      Eigen::Vector3d::Zero();  // of the origin, classical (not spatial) acceleration
  Eigen::Vector3d bias_angular = Eigen::Vector3d::Zero();
};

/// Linear and angular part of J x'' (an acceleration without its bias) or of J x' (a velocity).
struct Rate {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
};

/// Symmetric 6x6 inertia [A B; B' D]: force = A a + B alpha, moment = B' a + D alpha.
struct Inertia6 {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();  // kg
  Eigen::Matrix3d B = Eigen::Matrix3d::Zero();  // kg·m
  Eigen::Matrix3d D = Eigen::Matrix3d::Zero();  // kg·m²

  Inertia6& operator+=(const Inertia6& other) {
    A += other.A;
    B += other.B;
    D += other.D;
    return *this;
  }
};

/// A rigid body carried by a frame. E_k = 1/2 m c'ᵀc' + 1/2 ωᵀ I_c ω: (17) with all of the mass at one
/// cross-section.
struct RigidBody {
  double mass = 0.0;                                  // kg
  Eigen::Vector3d com = Eigen::Vector3d::Zero();      // m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // kg·m², about the centre of mass

  bool empty() const { return mass == 0.0 && inertia.isZero(0.0); }

  Inertia6 AtOrigin() const {
    const Eigen::Matrix3d c = Cross(com);
    return {mass * Eigen::Matrix3d::Identity(), -mass * c, inertia - mass * c * c};
  }

  /// Forces that the velocities and the bias accelerations call for, about the origin.
  Wrench Bias(const Motion& motion) const {
    const Eigen::Vector3d& w = motion.omega;
    const Eigen::Vector3d a_com = motion.bias_linear + motion.bias_angular.cross(com) + w.cross(w.cross(com));
    const Eigen::Vector3d force = mass * a_com;
    const Eigen::Vector3d moment = inertia * motion.bias_angular + w.cross(inertia * w);
    return {force, moment + com.cross(force)};
  }

  double KineticEnergy(const Motion& motion) const {
    const Eigen::Vector3d v_com = motion.velocity + motion.omega.cross(com);
    return 0.5 * mass * v_com.squaredNorm() + 0.5 * motion.omega.dot(inertia * motion.omega);
  }
};

/// Two bodies in the same frame, as one.
RigidBody Join(const RigidBody& a, const RigidBody& b);

/// What is left of `whole` without `part`.
RigidBody Without(const RigidBody& whole, const RigidBody& part);

/// A frame in its parent: coordinates change as x_parent = R x_child + p.
struct Placement {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  // m

  Placement operator*(const Placement& child) const { return {R * child.R, p + R * child.p}; }
  Eigen::Vector3d operator*(const Eigen::Vector3d& x) const { return R * x + p; }
  Placement Inverse() const;
};

/// The same body, written in the axes and about the origin of the parent.
RigidBody InParent(const Placement& placement, const RigidBody& body);

/// Inertia of the child at its parent through a rigid connection: XᵀIX; and its two halves.
Inertia6 Turned(const Eigen::Matrix3d& R, const Inertia6& child);
Inertia6 Shifted(const Eigen::Vector3d& p, const Inertia6& child);
Inertia6 InParent(const Placement& placement, const Inertia6& child);
Wrench InParent(const Placement& placement, const Wrench& child);

/// Motion of a frame fixed in a moving one.
Motion Carried(const Motion& parent, const Placement& placement);
Rate Carried(const Rate& parent, const Placement& placement);

}  // namespace reed::plant
