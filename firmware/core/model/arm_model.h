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

/// A straight elastic member along one axis of its link; one EI for both bending planes (round tube).
struct Member {
  int link = 0;                         // 0-based
  int axis = 2;                         // 2: d of the link, along z_i; 0: a of the next row, along x_i
  double start_at = 0.0, end_at = 0.0;  // where on that axis, from the origin of the link
  double length = 0.0, EA = 0.0, EI = 0.0, GJ = 0.0, rhoA = 0.0;

  double sign() const { return end_at < start_at ? -1.0 : 1.0; }
};

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

  // Elastic members from base to tip; none for an arm that is described without sections.
  FixedArray<Member, kMaxMembers> member;
  int num_members;
  FixedArray<int, N>
      carrier;  // the longer member of each link, which carries its weight; -1: the link has none
};

}  // namespace reed::model
