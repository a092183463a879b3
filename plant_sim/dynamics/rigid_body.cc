#include "reed/plant/dynamics/rigid_body.h"

#include <cmath>

#include "reed/plant/dynamics/processor_clones.h"
#include "reed/plant/dynamics/small_products.h"

namespace reed::plant {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kRoundOff = 1e-12;  // of a difference of masses, relative

/// Inertia about the origin from that about the centre of mass (sign +1), or back (-1).
Matrix3d Steiner(const Matrix3d& inertia, double mass, const Vector3d& com, double sign) {
  return inertia - sign * mass * Cross(com) * Cross(com);
}

RigidBody Sum(const RigidBody& a, const RigidBody& b, double sign) {
  RigidBody sum;
  sum.mass = a.mass + sign * b.mass;
  if (std::abs(sum.mass) < kRoundOff * (a.mass + b.mass)) sum.mass = 0.0;
  if (sum.mass != 0.0) sum.com = (a.mass * a.com + sign * b.mass * b.com) / sum.mass;
  const Matrix3d about_origin =
      Steiner(a.inertia, a.mass, a.com, 1.0) + sign * Steiner(b.inertia, b.mass, b.com, 1.0);
  sum.inertia = Steiner(about_origin, sum.mass, sum.com, -1.0);
  return sum;
}

}  // namespace

RigidBody Join(const RigidBody& a, const RigidBody& b) { return Sum(a, b, 1.0); }
RigidBody Without(const RigidBody& whole, const RigidBody& part) { return Sum(whole, part, -1.0); }

Placement Placement::Inverse() const { return {R.transpose(), -(R.transpose() * p)}; }

RigidBody InParent(const Placement& placement, const RigidBody& body) {
  return {body.mass, placement * body.com, placement.R * body.inertia * placement.R.transpose()};
}

REED_CLONES Inertia6 Turned(const Matrix3d& R, const Inertia6& child) {
  return {Turned(R, child.A), Turned(R, child.B), Turned(R, child.D)};
}

REED_CLONES Inertia6 Shifted(const Vector3d& p, const Inertia6& child) {
  const Matrix3d px = Cross(p);
  const Matrix3d B = child.B - child.A * px;
  return {child.A, B, child.D + px * B - child.B.transpose() * px};
}

Inertia6 InParent(const Placement& placement, const Inertia6& child) {
  return Shifted(placement.p, Turned(placement.R, child));
}

Wrench InParent(const Placement& placement, const Wrench& child) {
  const Vector3d force = placement.R * child.force;
  return {force, placement.R * child.moment + placement.p.cross(force)};
}

REED_CLONES Motion Carried(const Motion& parent, const Placement& placement) {
  const Vector3d& w = parent.omega;
  const Vector3d& p = placement.p;
  const auto Rt = placement.R.transpose();
  return {Rt * (parent.velocity + w.cross(p)), Rt * w,
          Rt * (parent.bias_linear + parent.bias_angular.cross(p) + w.cross(w.cross(p))),
          Rt * parent.bias_angular};
}

Rate Carried(const Rate& parent, const Placement& placement) {
  const auto Rt = placement.R.transpose();
  return {Rt * (parent.linear + parent.angular.cross(placement.p)), Rt * parent.angular};
}

}  // namespace reed::plant
