// The mixed-velocity Newton-Euler recursion of (27), (28) (Slotine-Li): accelerations that are bilinear in the two
// velocities qd and v. The torques contain the Christoffel C(q, qd) v exactly, and C itself is never built.
//
// The Newton-Euler torque at zero acceleration and gravity is a quadratic form, C(q, qd) qd = Γ(qd, qd), and
// the Christoffel C(q, qd) v is its symmetric bilinear form Γ(qd, v). Every product of two velocities below
// is therefore replaced by its symmetric part: ω×(ω×r) by ½[ω₁×(ω₂×r) + ω₂×(ω₁×r)] with ω₁ from qd and ω₂
// from v.  RT: safe.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "reed/core/model/arm_model.h"
#include "reed/core/model/kinematics.h"

namespace reed::model {

/// Acceleration field of a link in its own axes: the point r of the link accelerates with a + S r.
struct LinkField {
  Eigen::Vector3d a;
  Eigen::Matrix3d S;
};

/// Force and moment about the link origin that a body needs to follow the field:
/// F = ∫ (a + S r) dm,  n = ∫ r × (a + S r) dm.
inline Wrench InertialWrench(const MassMoments& body, const LinkField& field) {
  return {body.m * field.a + field.S * body.h, body.h.cross(field.a) + Vee(field.S * body.J)};
}

/// Fields of all links for joint acceleration v_dot, velocities kin.qd and v; gravity enters as base
/// acceleration -g.
template <int N>
void PolarisedFields(const Kinematics<N>& kin, const Vec<N>& v, const Vec<N>& v_dot,
                     const Eigen::Vector3d& gravity, FixedArray<LinkField, N>& field) {
  using Eigen::Vector3d;
  Vector3d p = Vector3d::Zero(), a = -gravity;
  Vector3d w1 = Vector3d::Zero(), w2 = Vector3d::Zero(), alpha = Vector3d::Zero();  // of link i-1, world axes
  for (int i = 0; i < N; ++i) {
    const Vector3d z = kin.R[i].col(2);
    const Vector3d r = kin.p[i] - p;
    // clang-format off
    a     += alpha.cross(r) + 0.5 * (w1.dot(r) * w2 + w2.dot(r) * w1) - w1.dot(w2) * r;  // α×r + sym ω₁×(ω₂×r)
    alpha += v_dot(i) * z + 0.5 * (v(i) * w1 + kin.qd(i) * w2).cross(z);                 // z v̇ + sym ω×z θ̇
    w1     = kin.omega[i];
    w2    += v(i) * z;
    p      = kin.p[i];
    // clang-format on

    // The four vectors into link axes at once, one per row: [w1; w2; alpha; a] R.
    Mat<4, 3> base;
    for (int c = 0; c < 3; ++c) base.col(c) << w1(c), w2(c), alpha(c), a(c);
    const Mat<4, 3> L = base * kin.R[i];
    field[i].a = L.row(3);

    // S = [α]× + sym [ω₁]×[ω₂]×.
    const double xx = L(0, 0) * L(1, 0), yy = L(0, 1) * L(1, 1), zz = L(0, 2) * L(1, 2);
    const double xy = 0.5 * (L(0, 0) * L(1, 1) + L(0, 1) * L(1, 0));
    const double xz = 0.5 * (L(0, 0) * L(1, 2) + L(0, 2) * L(1, 0));
    const double yz = 0.5 * (L(0, 1) * L(1, 2) + L(0, 2) * L(1, 1));
    field[i].S << -yy - zz, xy - L(2, 2), xz + L(2, 1),  //
        xy + L(2, 2), -xx - zz, yz - L(2, 0),            //
        xz - L(2, 1), yz + L(2, 0), -xx - yy;
  }
}

}  // namespace reed::model
