// Zeroth, first and second moment of a body's mass: the ten numbers in which every rigid-body formula is
// linear. RT: safe.
#pragma once

#include <Eigen/Core>

#include "reed/config/description/arm_structure.h"

namespace reed::model {

/// Skew-symmetric part of a matrix as a vector: n with n_k = eps_kij B_ji, so that B = b rᵀ gives r × b.
inline Eigen::Vector3d Vee(const Eigen::Matrix3d& B) {
  return {B(2, 1) - B(1, 2), B(0, 2) - B(2, 0), B(1, 0) - B(0, 1)};
}

/// Moments of mass about the origin of the link, axes of the link (SI).
struct MassMoments {
  double m = 0.0;                               // ∫ dm
  Eigen::Vector3d h = Eigen::Vector3d::Zero();  // ∫ r dm
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();  // ∫ r rᵀ dm;  the inertia tensor is tr(J) 1 - J

  MassMoments() = default;

  /// From mass, centre and inertia about the centre (axes of the link).
  explicit MassMoments(const InertialBody& body)
      : m(body.mass_kg),
        h(body.mass_kg * body.com_m),
        J(0.5 * body.inertia_com_kgm2.trace() * Eigen::Matrix3d::Identity() - body.inertia_com_kgm2 +
          body.mass_kg * body.com_m * body.com_m.transpose()) {}

  void Add(double scale, const MassMoments& other) {
    m += scale * other.m;
    h += scale * other.h;
    J += scale * other.J;
  }

  bool IsZero() const { return m == 0.0 && h.isZero(0.0) && J.isZero(0.0); }
};

/// Force and moment, or linear and angular momentum; the moment is about the point named where it is used.
struct Wrench {
  Eigen::Vector3d F = Eigen::Vector3d::Zero();
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
};

/// Momentum of a body whose reference point moves with v while it turns with omega (one set of axes for all).
inline Wrench Momentum(const MassMoments& body, const Eigen::Vector3d& v, const Eigen::Vector3d& omega) {
  return {body.m * v + omega.cross(body.h), body.J.trace() * omega - body.J * omega + body.h.cross(v)};
}

}  // namespace reed::model
