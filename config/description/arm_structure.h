// What is the same for the controller's arm and for the simulated one: geometry, drive train, limits, members.
// Plain data in SI units. RT: set-up only (it owns heap memory).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <vector>

#include "reed/config/description/flexible_member.h"
#include "reed/config/description/roll_pitch_yaw.h"
#include "reed/config/sizes/sizes.h"
#include "reed/math/plane.h"

namespace reed {

/// A frame in another one, as a URDF says it: shifted by xyz, then turned about the fixed x, y and z axes.
struct FixedFrame {
  Eigen::Vector3d xyz_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rpy_rad = Eigen::Vector3d::Zero();

  /// R = Rz(yaw) Ry(pitch) Rx(roll): columns are the axes of the frame.
  Eigen::Matrix3d rotation() const { return RollPitchYaw(rpy_rad); }
};

/// A revolute joint: fixed in the frame of the link before it (of the base for the first), it turns about its z axis.
/// T_{i-1,i} = T(xyz, rpy) Rz(theta_i + offset) Tz(d). The frame of the link that it moves lies d further along z.
struct Joint : FixedFrame {
  std::string name;         // empty: none was given
  std::string frame;        // of the link that it moves; empty: none was given
  double offset_rad = 0.0;  // of the angle
  double d_m = 0.0;

  /// Axes of the joint at theta = 0.
  Eigen::Matrix3d rotation() const {
    return FixedFrame::rotation() * RollPitchYaw(Eigen::Vector3d(0.0, 0.0, offset_rad));
  }
  /// Whether a row of Denavit-Hartenberg parameters says the same.
  bool IsDhRow() const {
    return name.empty() && frame.empty() && xyz_m.tail<2>().isZero(0.0) && rpy_rad.tail<2>().isZero(0.0);
  }
};

/// Between the arm and its tool: the frame of its axes in the last link's, and the tool that hangs on it, which is a part
/// of the last link.
struct ForceSensor : FixedFrame {
  double tool_mass_kg = 0.0;
  Eigen::Vector3d tool_com_m = Eigen::Vector3d::Zero();  // sensor's frame
};

/// One row of modified (Craig) Denavit-Hartenberg parameters:
/// T_{i-1,i} = Rx(alpha) Tx(a) Rz(theta_i + offset) Tz(d), alpha = alpha_{i-1}, a = a_{i-1}.
struct DhRow {
  double alpha_rad = 0.0;
  double a_m = 0.0;
  double d_m = 0.0;
  double offset_rad = 0.0;
};

inline Joint JointOf(const DhRow& row) {
  Joint joint;
  joint.xyz_m.x() = row.a_m;
  joint.rpy_rad.x() = row.alpha_rad;
  joint.offset_rad = row.offset_rad;
  joint.d_m = row.d_m;
  return joint;
}

inline std::vector<Joint> JointsOf(const std::vector<DhRow>& rows) {
  std::vector<Joint> joints;
  joints.reserve(rows.size());
  for (const DhRow& row : rows) joints.push_back(JointOf(row));
  return joints;
}

/// A rigid body in the frame of the link it belongs to.
struct InertialBody {
  double mass_kg = 0.0;
  Eigen::Vector3d com_m = Eigen::Vector3d::Zero();  // link frame
  Eigen::Matrix3d inertia_com_kgm2 =
      Eigen::Matrix3d::Zero();  // about the centre of mass, axes of the link frame
};

/// Cross-section of one straight member. Round tube: one EI for both bending planes.
struct BeamSection {
  double length_m = 0.0;
  double EA_N = 0.0;
  double EI_Nm2 = 0.0;
  double GJ_Nm2 = 0.0;
  double rhoA_kgpm = 0.0;
};

struct ArmStructure {
  std::string name;
  FixedFrame base;                                // in the world
  std::vector<Joint> joints;                      // from base to tip
  FixedFrame tool;                                // in the last link's frame; its origin is the tool point
  ForceSensor force_sensor;                       // where one is fitted
  Eigen::Vector3d gravity_mps2{0.0, 0.0, -9.81};  // world frame
  // Per joint; empty where the file does not say (a purely kinematic arm).
  std::vector<double> rotor_inertia_kgm2;       // reflected to the joint
  std::vector<double> joint_stiffness_Nmprad;   // k_q
  std::vector<double> joint_hardening_Nmprad3;  // cubic term k_3 of the spring: torque = k_q xi + k_3 xi^3
  std::vector<double> torque_limit_Nm;
  std::vector<double> position_min_rad;   // never empty after reading: -2.9 rad where absent
  std::vector<double> position_max_rad;   // 2.9 rad where absent
  std::vector<double> speed_limit_radps;  // 3 rad/s where absent
  // What bends, in order from base to tip; the rest is rigid. Either the members, or their sections where they follow the
  // rows: for each link the non-zero d (along z), then the non-zero a (along x) that follows it. FlexibleMembers() reads both.
  std::vector<FlexibleMember> members;
  std::vector<BeamSection> sections;

  bool bends() const { return !members.empty() || !sections.empty(); }

  /// Longest distance from base to tool point.
  double reach_m() const {
    double reach = tool.xyz_m.norm();
    for (const Joint& joint : joints) reach += math::Length(joint.xyz_m.norm(), joint.d_m);
    return reach;
  }
  int dof() const { return static_cast<int>(joints.size()); }
  bool IsOfDhRows() const {
    return std::all_of(joints.begin(), joints.end(), [](const Joint& joint) { return joint.IsDhRow(); });
  }
};

}  // namespace reed
