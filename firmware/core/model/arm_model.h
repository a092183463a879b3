// The constants of one arm as the controller assumes it, in the sizes and the form that the recursions use.
// N joints, P structural parameters. SI. Plain numbers, no heap, filled once (firmware/setup/arm_model.h).
// RT: reading is safe.
#pragma once

#include <Eigen/Core>

#include "reed/core/model/fixed_array.h"
#include "reed/core/model/mass_moments.h"

namespace reed::model {

template <int N>
using Vec = Eigen::Matrix<double, N, 1>;
template <int R, int C>
using Mat = Eigen::Matrix<double, R, C>;
using Vec6 = Vec<6>;
using Mat6 = Mat<6, 6>;

/// What one unit of parameter k adds to the body it is listed under. k = P: the part of the body that is
/// known.
struct UnitShape {
  int k = 0;
  MassMoments unit;
};

/// A straight elastic member of a link. Everything in the link's frame.
struct Member {
  int link = 0;                // 0-based
  Eigen::Vector3d start, end;  // start: on the side of the base
  Eigen::Vector3d t, y, z;     // unit vectors: along it, and the axes of its section
  double length = 0.0, EA = 0.0, EI_y = 0.0, EI_z = 0.0, GJ = 0.0, rhoA = 0.0;
  double softer = 0.0;  // 1/EI_z - 1/EI_y: by how much it bends more about z; 0 for a round section

  // What follows from its ends, by Span().
  bool start_at_origin = false, end_at_origin = false;  // of the link
  double start_along = 0.0;                             // t · start
  Vec<6> tt = Vec<6>::Zero();  // tᵀ J t = tt · (J_xx, J_yy, J_zz, J_xy, J_xz, J_yz)

  void Span(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    start = from;
    end = to;
    length = (to - from).norm();
    t = (to - from) / length;
    start_at_origin = from.isZero(0.0);
    end_at_origin = to.isZero(0.0);
    start_along = t.dot(from);
    tt << t.cwiseAbs2(), 2.0 * t.x() * t.y(), 2.0 * t.x() * t.z(), 2.0 * t.y() * t.z();
  }
};

/// A member in the world.
struct MemberLine {
  Eigen::Vector3d start, t, end;
};

/// On a link at p, turned by R. An end at the link's origin is at p to the bit.
inline MemberLine LineOf(const Member& beam, const Eigen::Matrix3d& R, const Eigen::Vector3d& p) {
  const Eigen::Vector3d t = R * beam.t, along = beam.length * t;
  if (beam.end_at_origin) return {p - along, t, p};
  const Eigen::Vector3d start = beam.start_at_origin ? p : Eigen::Vector3d(p + R * beam.start);
  return {start, t, start + along};
}

template <int N, int P>
struct ArmModel {
  static constexpr int kMaxMembers = 2 * N;

  // (1) for any fixed transform: T_{i-1,i} = T(mount_p, mount_R) Rz(theta) Tz(d); i = 1 includes the base in the world.
  FixedArray<Eigen::Matrix3d, N> mount_R;  // columns: axes of the joint at theta = 0, in link i-1
  FixedArray<Eigen::Vector3d, N> mount_p;  // a point of its axis, in link i-1
  Vec<N> d;                                // from there along z to the origin of link i
  Eigen::Vector3d gravity;                 // world frame
  Eigen::Vector3d tool_offset;             // last link frame
  Eigen::Matrix3d tool_rotation;           // columns: axes of the tool's frame, in the last link

  Eigen::Matrix3d sensor_rotation;  // columns: axes of the force sensor, in the last link
  Eigen::Vector3d sensor_to_tool;   // from its origin to the tool point, its axes
  double sensor_tool_mass;          // behind the sensor
  Eigen::Vector3d sensor_tool_com;  // of that mass, from its origin, its axes

  // Bodies: shapes of link b are shape[first_shape[b]] ... shape[first_shape[b + 1] - 1].
  FixedArray<UnitShape, N*(P + 1)> shape;
  FixedArray<int, N + 1> first_shape;
  Mat<N, P> viscous;  // F_v = diag(viscous p)
  Vec<P> p_nominal, p_lo, p_hi;
  int num_parameters;  // columns from here to P are zero

  // Drive train and limits; where the description does not say: no inertia, no hardening, everything else
  // infinite.
  Vec<N> rotor_inertia, joint_stiffness, joint_hardening, torque_limit, position_min, position_max,
      speed_limit;

  // Elastic members from base to tip; none for an arm that is described without.
  FixedArray<Member, kMaxMembers> member;
  int num_members;
  FixedArray<int, N>
      carrier;  // the longest member of each link, which carries its weight; -1: the link has none
};

}  // namespace reed::model
