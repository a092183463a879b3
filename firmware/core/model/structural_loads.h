// What pulls on the elastic structure: a wrench at the tool point and the weight of the links, spread over
// the members. The direct stiffness method and the serial form take the same loads. World axes, SI. RT: safe.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "reed/core/model/dynamics.h"

namespace reed::model {

/// Load on one member: a force on its start node, a force spread evenly over its length, a wrench on its end
/// node.
struct MemberLoad {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d spread = Eigen::Vector3d::Zero();
  Wrench end;
};

template <int N>
struct StructuralLoads {
  Wrench tip;                            // of the environment on the tool point, moment about it
  FixedArray<MemberLoad, 2 * N> member;  // by member index
  FixedArray<Wrench, N> rigid_link;      // on the origin of links that have no member
};

/// How a body's mass m lies on its member: part on the start node, part evenly spread, part on the end node,
/// so that mass, first and second moment along the axis are the body's. What is off the axis becomes a couple
/// at the end.
///   m = m_s + m_u + m_e,   μ₁ = m_u L/2 + m_e L,   μ₂ = m_u L²/3 + m_e L²
/// A beam's end slope under weight depends on μ₂ alone, so it is exact; uniform rods and tip masses are exact
/// throughout.
struct MassOnMember {
  double start = 0.0, spread = 0.0, end = 0.0;
  Eigen::Vector3d off_axis = Eigen::Vector3d::Zero();  // first moment about the axis, link axes
};

inline MassOnMember LayOnMember(const MassMoments& body, const Member& beam) {
  const Eigen::Vector3d& t = beam.t;
  const Eigen::Matrix3d& J = body.J;
  const double s = beam.start_along, L = beam.length, h_t = t.dot(body.h);
  const double J_tt = beam.tt(0) * J(0, 0) + beam.tt(1) * J(1, 1) + beam.tt(2) * J(2, 2) +
                      beam.tt(3) * J(0, 1) + beam.tt(4) * J(0, 2) + beam.tt(5) * J(1, 2);
  const double mu1 = h_t - s * body.m;
  const double mu2 = J_tt - 2.0 * s * h_t + s * s * body.m;
  MassOnMember mass;
  mass.spread = 6.0 * (mu1 / L - mu2 / (L * L));
  mass.end = mu1 / L - 0.5 * mass.spread;
  mass.start = body.m - mass.spread - mass.end;
  mass.off_axis = body.h - body.m * beam.start - mu1 * t;
  return mass;
}

/// Adds the weight of the bodies.
template <int N, int P>
void AddBodyWeight(const ArmModel<N, P>& arm, const LinkPoses<N>& pose, const Bodies<N>& bodies,
                   StructuralLoads<N>& loads) {
  const Eigen::Vector3d& g = arm.gravity;
  for (int i = 0; i < N; ++i) {
    const MassMoments& body = bodies.link[i];
    if (arm.carrier[i] < 0) {
      loads.rigid_link[i].F += body.m * g;
      loads.rigid_link[i].n += (pose.R[i] * body.h).cross(g);
      continue;
    }
    const MassOnMember mass = LayOnMember(body, arm.member[arm.carrier[i]]);
    MemberLoad& load = loads.member[arm.carrier[i]];
    load.start += mass.start * g;
    load.spread += mass.spread * g;
    load.end.F += mass.end * g;
    load.end.n += (pose.R[i] * mass.off_axis).cross(g);
  }
}

/// Adds the self-weight of the bare members, ρA g per length.
template <int N, int P>
void AddSelfWeight(const ArmModel<N, P>& arm, StructuralLoads<N>& loads) {
  for (int j = 0; j < arm.num_members; ++j) {
    loads.member[j].spread += arm.member[j].rhoA * arm.member[j].length * arm.gravity;
  }
}

}  // namespace reed::model
