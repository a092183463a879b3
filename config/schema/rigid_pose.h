// The arm as rigid bodies in one pose: enough to check what a file asks of it. RT: set-up only.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "reed/config/description/arm_structure.h"

namespace reed {

/// World frame.
struct RigidPose {
  std::vector<Eigen::Matrix3d> R;  // of every link
  std::vector<Eigen::Vector3d> p;  // origin of every link
  Eigen::Vector3d tip;             // tool point
};

RigidPose PoseOf(const ArmStructure& arm, const std::vector<double>& q_rad);

/// What one rad/s of each joint does to the tool point, m/s.
Eigen::Matrix3Xd TipJacobian(const RigidPose& pose);

/// Torque of each motor that holds the bodies against gravity.
std::vector<double> HoldingTorque(const ArmStructure& arm, const std::vector<InertialBody>& bodies,
                                  const RigidPose& pose);

/// M_ii of the bodies, without rotors.
std::vector<double> InertiaAboutJoints(const std::vector<InertialBody>& bodies, const RigidPose& pose);

/// Joint angles that bring the tool point there, well inside the limits: near `q_rad`, or from the middle of the
/// joints' ranges if that is empty; empty: none found.
std::vector<double> StartAnglesFor(const ArmStructure& arm, const Eigen::Vector3d& tip,
                                   const std::vector<double>& q_rad, double margin_rad);

/// Joint angles near `q_rad` and within the limits that bring the tool point there; empty: none found.
std::vector<double> AnglesFor(const ArmStructure& arm, const Eigen::Vector3d& tip, std::vector<double> q_rad,
                              double margin_rad);

}  // namespace reed
