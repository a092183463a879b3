// What is the same for the controller's arm and for the simulated one: geometry, drive train, limits, members.
// Plain data in SI units. RT: set-up only (it owns heap memory).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reed/config/sizes/sizes.h"
#include "reed/math/plane.h"

namespace reed {

/// One row of modified (Craig) Denavit-Hartenberg parameters:
/// T_{i-1,i} = Rx(alpha) Tx(a) Rz(theta_i) Tz(d), alpha = alpha_{i-1}, a = a_{i-1}. All joints are revolute.
struct DhRow {
  double alpha_rad = 0.0;
  double a_m = 0.0;
  double d_m = 0.0;
};

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
  std::vector<DhRow> dh;
  Eigen::Vector3d gravity_mps2{0.0, 0.0, -9.81};  // base frame
  Eigen::Vector3d tool_offset_m{0.0, 0.0, 0.0};   // tool point in the last link frame
  // Per joint; empty where the file does not say (a purely kinematic arm).
  std::vector<double> rotor_inertia_kgm2;       // reflected to the joint
  std::vector<double> joint_stiffness_Nmprad;   // k_q
  std::vector<double> joint_hardening_Nmprad3;  // cubic term k_3 of the spring: torque = k_q xi + k_3 xi^3
  std::vector<double> torque_limit_Nm;
  std::vector<double> position_min_rad;   // never empty after reading: -2.9 rad where absent
  std::vector<double> position_max_rad;   // 2.9 rad where absent
  std::vector<double> speed_limit_radps;  // 3 rad/s where absent
  // Members in order from base to tip: for each link the non-zero d (along z), then the non-zero a (along x)
  // that follows it.
  std::vector<BeamSection> sections;

  /// Longest distance from base to tool point.
  double reach_m() const {
    double reach = tool_offset_m.norm();
    for (const DhRow& row : dh) reach += math::Length(row.a_m, row.d_m);
    return reach;
  }
  int dof() const { return static_cast<int>(dh.size()); }
};

}  // namespace reed
